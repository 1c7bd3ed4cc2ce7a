#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/stack_thread.h"
#include "base/without_exceptions.h"
#include "base/working_folder.h"
#include "queries/language/session_parameters.h"
#include "queries/server/detail/http.h"
#include "queries/server/detail/result_table.h"
#include "queries/session/session.h"

namespace queries {

/// A statement to be run.
struct StatementRequest {
  std::string id;
  std::string client = {};  ///< whose result it will be; empty: of all that give no name
  std::string text;
  std::size_t row_count = 100;  ///< rows in the answer at most
  SessionParameters parameters = {};
};

/// The answer of a statement: members of the object that docs/http-api.md describes, as JSON.
struct StatementAnswer {
  std::string type = "null";
  std::string value = "null";
  std::string columns = {};  ///< of a result that was kept; else empty
  std::size_t count = 0;     ///< its rows
  std::vector<std::string> diagnostics = {};
  double seconds = 0;
};

/// A statement, from the request to the end of its result. A session runs it on its own thread (`run`). When its answer
/// is there, the session stays within the statement, so that the rows and the geometry of the result can still be read
/// from the database as it was: for a moment, in which most results are dropped, and then until a copy of the result
/// stands alone, without session, thread and transaction; that of a very large result until it is dropped. A statement
/// that has changed something is committed first, and a copy of its result is served. All functions but `run` may be
/// called by any thread.
class Execution {
 public:
  using Clock = std::chrono::steady_clock;

  Execution(StatementRequest request, algebra3d::WorkingFolder folder);
  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;

  /// Runs the statement and then serves its result until it is dropped.
  void run(Session& session);

  /// Waits for the answer until `deadline`; null if it is not there yet.
  const Result<StatementAnswer>* wait_until(Clock::time_point deadline);
  /// Whether the answer came with a result to be asked.
  bool has_result() const;

  /// The answer of `work` to a question about the result. It runs on the session's thread, or on a thread of its own
  /// once the session has ended; questions wait for each other. Errors: those of `work`; interrupted if the result is
  /// dropped meanwhile, or the client of `connection` (null: none) has gone.
  template <typename T>
  Result<T> ask(const Connection* connection, std::function<Result<T>(ResultTable&, Context&)> work);

  /// Asks a result to leave the database at once, which then may forget what the result has read: a copy takes its
  /// place, unless that would be large.
  void leave_database();
  /// Whether it holds a session: it runs, or its result has not left the database.
  bool holds_session() const;
  /// Whether it was asked to leave the database and cannot, since a copy would be large. This does not change.
  bool is_large() const;
  /// Bytes of memory that the statement and its result hold, about.
  std::size_t held_bytes() const { return user_.used(); }
  /// The size of a result that has left the database, about; else 0.
  std::size_t copied_bytes() const { return copied_bytes_; }
  /// Waits until the result has left the database, stays there or is dropped.
  void wait_until_left(Clock::time_point deadline);

  /// Ends the statement, also while it serves its result.
  void drop();
  /// Ends the statement if it has not answered yet. `why` becomes the message of the error.
  void cancel(std::string why);

  const StatementRequest& request() const { return request_; }
  Clock::time_point start() const { return start_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// The progress of the statement, or of a request for its result; for people.
  std::string progress() const;

 private:
  class ResultPresenter;

  void run_statement(Session& session);
  using Cancel = std::shared_ptr<std::atomic<bool>>;
  struct Question {
    std::function<void(ResultTable&)> work;
    Cancel cancel;
  };

  std::vector<std::string> summary_of(const algebra3d::Diagnostics& diagnostics) const;
  void answer(Result<StatementAnswer> given);
  bool serve(ResultTable& table, std::optional<std::chrono::milliseconds> stay);
  Status answer_waiting(ResultTable& table);
  void serve_copy(ResultTable table);
  bool is_to_leave() const;
  void end_leaving();
  void stay();
  Status post(Question question, algebra3d::StackThread& own);
  void answer_alone(const Question& question);
  void note_progress(const std::string& how_far);
  Error interruption() const;

  const StatementRequest request_;
  const algebra3d::WorkingFolder folder_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<bool> is_cancelled_ = false;
  algebra3d::MemoryUser user_;
  std::atomic<std::size_t> copied_bytes_ = 0;
  algebra3d::WorkMemory* memory_ = nullptr;  // of the session, or copy_memory_
  algebra3d::WorkMemory copy_memory_;        // of a result that has left the database

  std::mutex alone_mutex_;            // held by who asks alone_
  std::optional<ResultTable> alone_;  // the copy of a result that has no session any more

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::optional<Result<StatementAnswer>> answer_;
  std::deque<Question> questions_;
  Cancel asked_;  // of the question that is being answered
  bool is_dropped_ = false;
  bool is_to_leave_ = false;  // whether the result is asked to leave the database
  bool is_large_ = false;
  bool is_alone_ = false;  // whether alone_ is there
  bool is_over_ = false;   // nobody serves the result any more
  std::string progress_;
  std::string why_cancelled_;
};

template <typename T>
Result<T> Execution::ask(const Connection* connection, std::function<Result<T>(ResultTable&, Context&)> work) {
  constexpr std::chrono::milliseconds kLook(100);
  auto promise = std::make_shared<std::promise<Result<T>>>();
  std::future<Result<T>> reply = promise->get_future();
  const auto cancel = std::make_shared<std::atomic<bool>>(false);
  // The question alone has the promise: if it goes unanswered, the promise is broken.
  auto answer_it = [this, promise = std::move(promise), cancel, work = std::move(work)](ResultTable& table) {
    algebra3d::Diagnostics diagnostics;
    const algebra3d::Monitor::Report report = [this](const std::string& how_far) { note_progress(how_far); };
    Context context{
        .diagnostics = diagnostics, .cancel = cancel.get(), .folder = folder_, .memory = memory_, .report = &report};
    // Answers are freed elsewhere, so they do not count for the statement.
    algebra3d::MemoryUser user;
    const algebra3d::MemoryUserScope scope(&user);
    Result<T> result = algebra3d::without_exceptions([&] {
      const algebra3d::InterruptionScope interruption(cancel.get());
      return work(table, context);
    });
    if (!result) result = folder_.with_names(std::move(result).error());
    note_progress({});
    promise->set_value(std::move(result));
  };
  algebra3d::StackThread own;
  if (const Status posted = post({std::move(answer_it), cancel}, own); !posted) return posted.error();
  while (reply.wait_for(kLook) != std::future_status::ready)
    if (connection != nullptr && connection->is_gone()) *cancel = true;
  try {
    return reply.get();
  } catch (const std::future_error&) {
    return Error{ErrorCode::interrupted, "the result was dropped"};
  }
}

}  // namespace queries
