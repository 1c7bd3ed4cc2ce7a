#include "queries/streams/detail/column_streams.h"

#include <algorithm>
#include <utility>

#include "base/propagate.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

class SelectedTuples final : public TupleStream {
 public:
  SelectedTuples(TupleStreamPtr tuples, std::shared_ptr<const Function> predicate, const Context& context)
      : tuples_(std::move(tuples)), predicate_(std::move(predicate)), context_(context) {
    if (tuples_->has_batches()) columns_ = predicate_->in_columns(0);
  }

  Result<TuplePtr> next() override {
    while (true) {
      A3D_ASSIGN(TuplePtr next, tuples_->next());
      if (next == nullptr) return next;
      const Datum argument{next};
      A3D_ASSIGN(const Value holds, predicate_->call_for_value({&argument, 1}));
      if (is_true(holds)) return next;
      if (++step_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
    }
  }

  bool has_batches() const override { return columns_ != nullptr; }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (true) {
      A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(const Batch* const batch, tuples_->next_batch(most));
      if (batch == nullptr) return nullptr;
      A3D_ASSIGN(const ValueColumn* const holds, columns_->evaluate(*batch, batch->rows));
      batch_ = *batch;
      select_true(batch->rows, *holds, positions_);
      batch_.rows = {positions_.data(), positions_.size()};
      if (batch_.rows.count > 0) return &batch_;
    }
  }

 private:
  TupleStreamPtr tuples_;
  std::shared_ptr<const Function> predicate_;
  ColumnFunctionPtr columns_;
  const Context& context_;
  std::uint32_t step_ = 0;
  std::vector<std::uint32_t> positions_;
  Batch batch_;
};

class MadeTuples final : public TupleStream {
 public:
  MadeTuples(TupleStreamPtr tuples, AttributeSources sources, const DatumList& functions)
      : tuples_(std::move(tuples)), sources_(std::move(sources)) {
    for (const Datum& function : functions) functions_.push_back(function.function_ptr());
    if (!tuples_->has_batches()) return;
    for (const auto& function : functions_) {
      auto columns = function->in_columns(0);
      if (columns == nullptr) return;
      columns_.push_back(std::move(columns));
    }
    has_batches_ = true;
  }

  Result<TuplePtr> next() override {
    A3D_ASSIGN(const TuplePtr tuple, tuples_->next());
    if (tuple == nullptr) return TuplePtr();
    std::vector<Value> made;
    made.reserve(functions_.size());
    const Datum argument{tuple};
    for (const auto& function : functions_) {
      A3D_ASSIGN(Value value, function->call_for_value({&argument, 1}));
      made.push_back(std::move(value));
    }
    auto result = std::make_shared<Tuple>();
    result->attributes.reserve(sources_.size());
    for (const AttributeSource& source : sources_)
      result->attributes.push_back(source.is_made ? made[source.index] : tuple->attributes[source.index]);
    return TuplePtr(std::move(result));
  }

  bool has_batches() const override { return has_batches_; }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_ASSIGN(const Batch* const batch, tuples_->next_batch(most));
    if (batch == nullptr) return nullptr;
    made_.clear();
    for (const ColumnFunctionPtr& function : columns_) {
      A3D_ASSIGN(const ValueColumn* const made, function->evaluate(*batch, batch->rows));
      made_.push_back(made);
    }
    batch_.size = batch->size;
    batch_.rows = batch->rows;
    batch_.columns.clear();
    for (const AttributeSource& source : sources_)
      batch_.columns.push_back(source.is_made ? made_[source.index] : batch->columns[source.index]);
    return &batch_;
  }

 private:
  TupleStreamPtr tuples_;
  AttributeSources sources_;
  std::vector<std::shared_ptr<const Function>> functions_;
  std::vector<ColumnFunctionPtr> columns_;
  bool has_batches_ = false;
  std::vector<const ValueColumn*> made_;
  Batch batch_;
};

class FirstTuples final : public TupleStream {
 public:
  FirstTuples(TupleStreamPtr tuples, std::size_t count) : tuples_(std::move(tuples)), left_(count) {}

  Result<TuplePtr> next() override {
    if (left_ == 0) return TuplePtr();
    --left_;
    return tuples_->next();
  }
  bool has_batches() const override { return tuples_->has_batches(); }
  Result<const Batch*> next_batch(std::size_t most) override {
    if (left_ == 0) return nullptr;
    A3D_ASSIGN(const Batch* const batch, tuples_->next_batch(std::min(most, left_)));
    left_ -= batch == nullptr ? left_ : batch->rows.count;
    return batch;
  }

 private:
  TupleStreamPtr tuples_;
  std::size_t left_;
};

}  // namespace

void select_true(const SelectedRows& rows, const ValueColumn& holds, std::vector<std::uint32_t>& selected) {
  selected.resize(rows.count);
  std::size_t count = 0;
  const auto* const values = holds.data<bool>();
  if (holds.has_undefined())
    rows.for_each([&](std::size_t row) {
      selected[count] = static_cast<std::uint32_t>(row);
      count += holds.is_defined(row) && values[row] != 0 ? 1 : 0;
    });
  else
    rows.for_each([&](std::size_t row) {
      selected[count] = static_cast<std::uint32_t>(row);
      count += values[row];
    });
  selected.resize(count);
}

TupleStreamPtr selected_tuples(TupleStreamPtr tuples, std::shared_ptr<const Function> predicate,
                               const Context& context) {
  return std::make_shared<SelectedTuples>(std::move(tuples), std::move(predicate), context);
}

TupleStreamPtr made_tuples(TupleStreamPtr tuples, AttributeSources sources, const DatumList& functions) {
  return std::make_shared<MadeTuples>(std::move(tuples), std::move(sources), functions);
}

TupleStreamPtr first_tuples(TupleStreamPtr tuples, std::size_t count) {
  return std::make_shared<FirstTuples>(std::move(tuples), count);
}

}  // namespace queries
