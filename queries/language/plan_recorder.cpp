#include "queries/language/plan_recorder.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "queries/streams/mapping.h"

namespace queries {
namespace {

using Clock = std::chrono::steady_clock;

/// Adds the time of its life to a step.
class Stopwatch {
 public:
  explicit Stopwatch(PlanStep& step) : step_(step), begin_(Clock::now()) {}
  ~Stopwatch() { step_.seconds += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  PlanStep& step_;
  Clock::time_point begin_;
};

/// Adds the stages of a stream to those of a step, by their names.
void add_stages(PlanStep& step, const std::vector<StageCount>& stages) {
  for (const StageCount& stage : stages) {
    const auto known = std::ranges::find(step.stages, stage.what, &StageCount::what);
    if (known == step.stages.end())
      step.stages.push_back(stage);
    else
      known->count += stage.count;
  }
}

class MeasuredTuples final : public TupleStream {
 public:
  MeasuredTuples(TupleStreamPtr stream, PlanStep& step) : stream_(std::move(stream)), step_(step) {}
  ~MeasuredTuples() override { add_stages(step_, stream_->stages()); }
  MeasuredTuples(const MeasuredTuples&) = delete;
  MeasuredTuples& operator=(const MeasuredTuples&) = delete;

  Result<TuplePtr> next() override {
    const Stopwatch watch(step_);
    auto next = stream_->next();
    if (next && *next != nullptr) ++step_.tuples;
    return next;
  }
  bool has_batches() const override { return stream_->has_batches(); }
  Result<const Batch*> next_batch(std::size_t most) override {
    const Stopwatch watch(step_);
    auto next = stream_->next_batch(most);
    if (next && *next != nullptr) step_.tuples += (*next)->rows.count;
    return next;
  }

 private:
  TupleStreamPtr stream_;
  PlanStep& step_;
};

class MeasuredColumns final : public ColumnFunction {
 public:
  MeasuredColumns(ColumnFunctionPtr function, PlanStep& step) : function_(std::move(function)), step_(step) {}
  Result<const ValueColumn*> evaluate(const Batch& batch, SelectedRows rows) override {
    step_.calls += rows.count;
    const Stopwatch watch(step_);
    return function_->evaluate(batch, rows);
  }

 private:
  ColumnFunctionPtr function_;
  PlanStep& step_;
};

// The streams keep the node, and with it the steps, alive only through the caller: the recorder outlives both.
Datum measured_result(Datum result, PlanStep& step) {
  if (const auto* tuples = std::get_if<TupleStreamPtr>(&result.content))
    return Datum{TupleStreamPtr(std::make_shared<MeasuredTuples>(*tuples, step))};
  if (const auto* values = std::get_if<ValueStreamPtr>(&result.content))
    return Datum{make_value_stream([stream = *values, &step]() -> Result<std::optional<Value>> {
      const Stopwatch watch(step);
      auto next = stream->next();
      if (next && *next) ++step.tuples;
      return next;
    })};
  return result;
}

class MeasuredNode final : public TypedNode {
 public:
  MeasuredNode(TypedPtr node, PlanStep& step)
      : TypedNode(node->type(), node->place()), node_(std::move(node)), step_(step) {}
  Result<Datum> evaluate(const Frame* frame, Context& context) const override {
    ++step_.calls;
    const Stopwatch watch(step_);
    auto result = node_->evaluate(frame, context);
    if (!result) return result;
    return measured_result(std::move(result).value(), step_);
  }
  bool is_always_defined() const override { return node_->is_always_defined(); }
  bool never_fails() const override { return node_->never_fails(); }
  bool gives_one_tuple() const override { return node_->gives_one_tuple(); }
  NodeView view() const override { return node_->view(); }
  std::string how() const override { return node_->how(); }
  TypedPtr replaced_by(TypedPtr other, std::optional<std::uint64_t> estimate) const override {
    step_.estimate = estimate;
    return renewed(std::move(other));
  }
  TypedPtr renewed(TypedPtr other) const override {
    step_.remark = other->how();
    return std::make_shared<MeasuredNode>(std::move(other), step_);
  }
  ColumnFunctionPtr measured(ColumnFunctionPtr columns) const override {
    return std::make_shared<MeasuredColumns>(std::move(columns), step_);
  }
  TypedPtr unmeasured() const override { return node_; }

 private:
  TypedPtr node_;
  PlanStep& step_;
};

}  // namespace

std::size_t PlanRecorder::begin(const std::string& name) {
  PlanStep step;
  step.name = name;
  step.depth = depth_++;
  steps_.push_back(std::move(step));
  return steps_.size() - 1;
}

void PlanRecorder::describe(std::size_t step, std::string remark, std::optional<std::uint64_t> estimate) {
  steps_[step].remark = std::move(remark);
  steps_[step].estimate = estimate;
}

TypedPtr PlanRecorder::finish(std::size_t step, std::string signature, TypedPtr node) {
  --depth_;
  steps_[step].signature = std::move(signature);
  return std::make_shared<MeasuredNode>(std::move(node), steps_[step]);
}

}  // namespace queries
