#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "algebra3d/database/database.h"
#include "base/stack_thread.h"
#include "base/temporary_folder.h"
#include "queries/database/detail/handover.h"
#include "queries/language/command_reader.h"
#include "queries/session/session.h"

namespace algebra3d::database::detail {

/// An open database and the thread that runs its statements. Owned by the Database and by Rows that are being read.
class Engine {
 public:
  /// Opens a database. `temporary`: a folder that is removed with the engine, or none.
  static Result<std::shared_ptr<Engine>> open(const std::filesystem::path& file, const OpenOptions& options,
                                              std::optional<TemporaryFolder> temporary);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  enum class Results : std::uint8_t { rows, single_value, dropped };
  /// Starts the commands of a text and returns the Handover of their results. Unless they are `dropped` there must be
  /// one command, with `single_value` a query.
  /// Errors: wrong_usage if a statement is running, invalid_value for unusable parameters.
  Result<std::shared_ptr<Handover>> start(std::string_view text, const Parameters& parameters, Results results);
  /// To be called when the statement has ended and all its rows were taken.
  void release(Report report);
  void cancel() noexcept { is_cancelled_ = true; }

  void set_progress(Tell progress) { progress_ = std::move(progress); }
  const Tell& progress() const { return progress_; }
  bool is_in_transaction() const { return is_in_transaction_; }
  const std::filesystem::path& file() const { return file_; }
  const std::string& opening_notice() const { return opening_notice_; }
  const Report& report() const { return report_; }

 private:
  struct Task;
  using Work = std::function<void()>;

  Engine(std::filesystem::path file, std::filesystem::path folder, std::optional<TemporaryFolder> temporary);
  Status open_session(const OpenOptions& options);
  void post(Work work);
  void work_until_closed();
  void run(const Task& task);
  Status run_commands(const Task& task, Report& report);
  Status run_command(const queries::CommandText& command, queries::Presenter& presenter, Context& context,
                     Results results);

  std::filesystem::path file_;
  std::filesystem::path folder_;
  std::optional<TemporaryFolder> temporary_;  // removed when the thread has ended
  std::string opening_notice_;
  Tell progress_;
  Report report_;  // of the last statement
  std::atomic<bool> is_busy_ = false;
  std::atomic<bool> is_cancelled_ = false;
  std::atomic<bool> is_in_transaction_ = false;

  std::unique_ptr<queries::Session> session_;  // used by the thread only

  std::mutex mutex_;  // guards the two members below
  std::condition_variable changed_;
  std::optional<Work> work_;
  bool is_closing_ = false;
  StackThread thread_;
};

}  // namespace algebra3d::database::detail
