#include "queries/server/detail/execution.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "base/propagate.h"
#include "base/signal_block.h"
#include "queries/server/detail/result_json.h"

namespace queries {
namespace {

// Limits of the copy that a result makes when it leaves the database, most of it in a file, and its part in memory.
// Values with levels of detail in the database do not leave it without need, since these would have to be made anew.
constexpr CopyLimits kLargestCopy = {.bytes = std::size_t{1} << 30U};
constexpr std::size_t kKeptValue = 20'000;
constexpr std::size_t kCopyMemory = std::size_t{768} << 10U;

/// The time without a question after which a result leaves its session, if its copy is not larger.
struct Stay {
  std::chrono::milliseconds time;
  CopyLimits limits;
};
// Many are dropped within the first time. A large copy takes seconds, so it is made only of what is kept for longer.
constexpr std::array<Stay, 2> kStays = {{
    {std::chrono::milliseconds(250), {.bytes = std::size_t{16} << 20U, .value_elements = kKeptValue}},
    {std::chrono::seconds(5), {.bytes = kLargestCopy.bytes, .value_elements = kKeptValue}},
}};

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
  A3D_ASSIGN(table_, table->loaded_copy(context, execution_.copy_memory_, CopyLimits(), {}));
  return {};
}

// A copy that cannot be made, for want of memory or of space on the disk, say, does not harm the result. Questions that
// come while it is made are answered between its rows.
Status Execution::ResultPresenter::serve(ResultTable& table, const Context& context) {
  for (std::size_t stage = 0;; ++stage) {
    const bool is_last = stage >= kStays.size();
    if (!execution_.serve(table, is_last ? std::nullopt : std::optional(kStays[stage].time))) return {};
    const bool was_asked = execution_.is_to_leave();
    const CopyLimits& limits = was_asked ? kLargestCopy : kStays[stage].limits;
    Result<ResultTable> copy = algebra3d::without_exceptions([&] {
      return table.loaded_copy(context, execution_.copy_memory_, limits,
                               [&] { return execution_.answer_waiting(table); });
    });
    if (copy) {
      table_ = *std::move(copy);
      return {};
    }
    if (!was_asked) continue;
    execution_.stay();
    stage = kStays.size();
  }
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
  is_to_leave_ = false;
  is_over_ = !is_alone_;
  if (is_over_) questions_.clear();
  changed_.notify_all();
}

void Execution::run_statement(Session& session) {
  const algebra3d::MemoryUserScope scope(&user_);
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
  if (status && presenter.table()) serve_copy(*std::move(presenter.table()));
}

// Questions that came while the copy was made are answered here; for later ones it stands alone.
void Execution::serve_copy(ResultTable table) {
  while (true) {
    Question question;
    {
      const std::lock_guard lock(mutex_);
      if (is_dropped_) return;
      if (questions_.empty()) {
        memory_ = &copy_memory_;
        copied_bytes_ = table.copied_bytes();
        alone_ = std::move(table);
        is_alone_ = true;
        asked_ = nullptr;
        return;
      }
      question = std::move(questions_.front());
      questions_.pop_front();
      asked_ = question.cancel;
    }
    question.work(table);
  }
}

void Execution::answer_alone(const Question& question) {
  const std::lock_guard serving(alone_mutex_);
  {
    const std::lock_guard lock(mutex_);
    if (is_dropped_) return;
    asked_ = question.cancel;
  }
  question.work(*alone_);
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

// Answers questions until the result is dropped (false), or is to leave the database (true): because it was asked to,
// or because nobody has asked it for the time `stay`.
bool Execution::serve(ResultTable& table, std::optional<std::chrono::milliseconds> stay) {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      const auto is_wanted = [this] { return is_dropped_ || is_to_leave_ || !questions_.empty(); };
      if (!stay)
        changed_.wait(lock, is_wanted);
      else if (!changed_.wait_for(lock, *stay, is_wanted))
        return true;
      if (is_dropped_ || is_to_leave_) return !is_dropped_;
    }
    if (!answer_waiting(table)) return false;
  }
}

// Answers the questions that are there. Errors: interrupted if the result was dropped.
Status Execution::answer_waiting(ResultTable& table) {
  while (true) {
    Question question;
    {
      const std::lock_guard lock(mutex_);
      if (is_dropped_) return Error{ErrorCode::interrupted, "the result was dropped"};
      if (questions_.empty()) return {};
      question = std::move(questions_.front());
      questions_.pop_front();
      asked_ = question.cancel;
    }
    question.work(table);
  }
}

void Execution::leave_database() {
  const std::lock_guard lock(mutex_);
  is_to_leave_ = !is_over_ && !is_alone_ && !is_dropped_ && !is_large_;
  changed_.notify_all();
}

bool Execution::is_to_leave() const {
  const std::lock_guard lock(mutex_);
  return is_to_leave_;
}

void Execution::stay() {
  const std::lock_guard lock(mutex_);
  is_to_leave_ = false;
  is_large_ = true;
  changed_.notify_all();
}

bool Execution::is_large() const {
  const std::lock_guard lock(mutex_);
  return is_large_;
}

bool Execution::holds_session() const {
  const std::lock_guard lock(mutex_);
  return !is_over_ && !is_alone_;
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

// Gives a question to the session, or to the thread `own`, which ends before this object.
Status Execution::post(Question question, algebra3d::StackThread& own) {
  const std::lock_guard lock(mutex_);
  if (is_dropped_ || is_over_) return Error{ErrorCode::interrupted, "the result was dropped"};
  if (!is_alone_) {
    questions_.push_back(std::move(question));
    changed_.notify_all();
    return {};
  }
  const algebra3d::SignalBlock block;  // signals are for the main thread
  // The thread alone has the question, and with it the promise of an answer, until it has answered.
  const bool is_started = own.start([this, question = std::move(question)]() mutable {
    const Question own_question = std::move(question);
    answer_alone(own_question);
  });
  return is_started ? Status() : Error{ErrorCode::out_of_memory, "not enough memory to start a thread"};
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
