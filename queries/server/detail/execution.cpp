#include "queries/server/detail/execution.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "base/propagate.h"
#include "queries/server/detail/result_json.h"

namespace queries {
namespace {

constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();
// Limits of the copy that a result makes when it leaves the database: its size, and its part in memory.
constexpr std::size_t kLargestCopy = std::size_t{16} << 20U;
constexpr std::size_t kCopyMemory = std::size_t{768} << 10U;

}  // namespace

Execution::Execution(StatementRequest request, algebra3d::WorkingFolder folder)
    : request_(std::move(request)),
      folder_(std::move(folder)),
      copy_memory_(kCopyMemory, algebra3d::WorkMemory::default_folder()) {}

/// Makes the answer of a statement from its result.
class Execution::ResultPresenter final : public Presenter {
 public:
  ResultPresenter(Execution& execution, Session& session) : execution_(execution), session_(session) {}

  void begin(const Command& command) override { is_query_ = std::holds_alternative<Query>(command.content); }
  Status present(const TypeExpr& type, const Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& result) override;
  bool takes_streams() const override { return true; }

  StatementAnswer& answer() { return answer_; }
  std::optional<ResultTable>& table() { return table_; }

 private:
  Status serve(ResultTable& table, const Context& context);
  Result<std::optional<ResultTable>> table_of(const TypeExpr& type, const Datum& value, Context& context) const;

  Execution& execution_;
  Session& session_;
  bool is_query_ = false;
  StatementAnswer answer_;
  std::optional<ResultTable> table_;  // of a result that outlives its statement
};

// Streams are read to their end, so that their rows can be counted and read again; sorting operators' temporary files
// take what is too large for the memory.
Result<std::optional<ResultTable>> Execution::ResultPresenter::table_of(const TypeExpr& type, const Datum& value,
                                                                        Context& context) const {
  if (type.is_relation()) {
    A3D_ASSIGN(ResultTable table, ResultTable::of(value.relation()));
    return std::optional(std::move(table));
  }
  if (const auto* tuples = std::get_if<TupleStreamPtr>(&value.content)) {
    A3D_ASSIGN(TupleBuffer rows, buffered(**tuples, context));
    const std::size_t count = rows.size();
    return std::optional(ResultTable(std::make_shared<MemoryRelation>(type.element(), std::move(rows)), count));
  }
  if (const auto* single = std::get_if<Value>(&value.content)) return std::optional(ResultTable::of_value(*single));
  return std::optional<ResultTable>();
}

Status Execution::ResultPresenter::present(const TypeExpr& type, const Datum& value, Context& context) {
  execution_.memory_ = context.memory;
  answer_.type = json_string(type.text());
  A3D_ASSIGN(std::optional<ResultTable> table, table_of(type, value, context));
  if (!table) {
    A3D_ASSIGN(answer_.value, json_of_other(type, value, context));
    return {};
  }
  const bool is_table = type.is_relation() || type.is_stream();
  const std::size_t shown = std::min(execution_.request_.row_count, table->count());
  A3D_ASSIGN(answer_.value, is_table ? json_of_rows(*table, 0, shown, context) : json_of_single(*table, context));
  if (shown == table->count() && !has_geometry(table->tuple_type(), session_.registry())) return {};
  answer_.columns = json_of_columns(table->tuple_type(), session_.registry());
  answer_.count = table->count();
  const bool has_written = session_.store() != nullptr && session_.store()->has_written();
  if (is_query_ && !has_written) {
    answer_.diagnostics = execution_.summary_of(context.diagnostics);
    answer_.seconds = execution_.seconds();
    execution_.answer(answer_);
    return serve(*table, context);
  }
  A3D_ASSIGN(table_, table->loaded_copy(context, *context.memory, kAnySize));
  return {};
}

// A copy that cannot be made, for want of space on the disk, say, does not harm the result.
Status Execution::ResultPresenter::serve(ResultTable& table, const Context& context) {
  while (execution_.serve(table)) {
    Result<ResultTable> copy = table.loaded_copy(context, execution_.copy_memory_, kLargestCopy);
    if (copy) {
      table_ = *std::move(copy);
      break;
    }
    execution_.end_leaving();
  }
  return {};
}

Status Execution::ResultPresenter::present_inquiry(const NestedList& result) {
  answer_.type = json_string("inquiry");
  answer_.value = json_of_inquiry(result);
  return {};
}

void Execution::run(Session& session) {
  const Status status = algebra3d::without_exceptions([&]() -> Status {
    run_statement(session);
    return {};
  });
  if (!status) answer(status.error());
  const std::lock_guard lock(mutex_);
  is_over_ = true;
  is_to_leave_ = false;
  questions_.clear();
  changed_.notify_all();
}

void Execution::run_statement(Session& session) {
  algebra3d::MemoryUser user;
  const algebra3d::MemoryUserScope scope(&user);
  session.set_parameters(request_.parameters);
  ResultPresenter presenter(*this, session);
  algebra3d::Diagnostics diagnostics;
  const algebra3d::Monitor::Report report = [this](const std::string& how_far) { note_progress(how_far); };
  Context context{.diagnostics = diagnostics, .cancel = &is_cancelled_, .folder = folder_, .report = &report};
  Status status = session.execute(request_.text, {"", 1, 1}, presenter, context);
  session.set_parameters({});
  StatementAnswer& given = presenter.answer();
  given.diagnostics = summary_of(diagnostics);
  if (!status) status = folder_.with_names(std::move(status).error());
  given.seconds = seconds();
  const bool is_interrupted = !status && status.error().code == ErrorCode::interrupted;
  answer(status ? Result<StatementAnswer>(given) : is_interrupted ? interruption() : status.error());
  end_leaving();
  while (status && presenter.table() && serve(*presenter.table())) end_leaving();
}

std::vector<std::string> Execution::summary_of(const algebra3d::Diagnostics& diagnostics) const {
  std::vector<std::string> lines = diagnostics.summary();
  for (std::string& line : lines) line = folder_.with_names(std::move(line));
  return lines;
}

// The first answer counts: a result that could not be committed after its last question was answered long ago.
void Execution::answer(Result<StatementAnswer> given) {
  const std::lock_guard lock(mutex_);
  if (!answer_) answer_ = std::move(given);
  progress_.clear();
  changed_.notify_all();
}

const Result<StatementAnswer>* Execution::wait_until(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] { return answer_.has_value(); });
  return answer_ ? &*answer_ : nullptr;
}

bool Execution::has_result() const {
  const std::lock_guard lock(mutex_);
  return answer_ && *answer_ && !(*answer_)->columns.empty() && !is_over_;
}

// Answers questions until the result is dropped (false), or is to leave the database (true).
bool Execution::serve(ResultTable& table) {
  while (true) {
    Question question;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_dropped_ || is_to_leave_ || !questions_.empty(); });
      if (is_dropped_ || is_to_leave_) return !is_dropped_;
      question = std::move(questions_.front());
      questions_.pop_front();
      asked_ = question.cancel;
    }
    question.work(table);
  }
}

void Execution::leave_database() {
  const std::lock_guard lock(mutex_);
  is_to_leave_ = !is_over_ && !is_dropped_;
  changed_.notify_all();
}

void Execution::end_leaving() {
  const std::lock_guard lock(mutex_);
  is_to_leave_ = false;
  changed_.notify_all();
}

void Execution::wait_until_left(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] { return !is_to_leave_ || is_dropped_; });
}

bool Execution::post(Question question) {
  const std::lock_guard lock(mutex_);
  if (is_dropped_ || is_over_) return false;
  questions_.push_back(std::move(question));
  changed_.notify_all();
  return true;
}

void Execution::drop() {
  const std::lock_guard lock(mutex_);
  is_dropped_ = true;
  is_cancelled_ = true;
  if (asked_ != nullptr) *asked_ = true;
  questions_.clear();
  changed_.notify_all();
}

void Execution::cancel(std::string why) {
  const std::lock_guard lock(mutex_);
  if (answer_) return;
  why_cancelled_ = std::move(why);
  is_cancelled_ = true;
}

Error Execution::interruption() const {
  const std::lock_guard lock(mutex_);
  return {ErrorCode::interrupted, why_cancelled_.empty() ? "interrupted" : why_cancelled_};
}

std::string Execution::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

void Execution::note_progress(const std::string& how_far) {
  const std::lock_guard lock(mutex_);
  progress_ = how_far;
}

}  // namespace queries
