#include "queries/database/detail/engine.h"

#include <system_error>
#include <utility>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/utf8.h"
#include "base/diagnostics.h"
#include "base/file_error.h"
#include "base/propagate.h"
#include "base/signal_block.h"
#include "base/without_exceptions.h"
#include "queries/database/detail/result_rows.h"
#include "queries/database/detail/value_content.h"
#include "queries/language/command_reader.h"
#include "queries/language/scanner.h"
#include "queries/streams/all.h"

namespace algebra3d::database::detail {
namespace {

const Registry& operators() {
  static const Registry registry = [] {
    Registry made = make_registry();
    queries::register_stream_operators(made);
    return made;
  }();
  return registry;
}

// A string that is not text could be stored, but neither saved and restored nor shown.
Result<queries::SessionParameters> session_parameters(const Parameters& parameters) {
  queries::SessionParameters result;
  result.advice = "the statement was given none";
  for (const auto& [name, value] : parameters) {
    if (!queries::is_identifier(name))
      return Error{ErrorCode::invalid_value, "parameter '{}': expected a name of letters, digits and '_'", name};
    algebra3d::Value inner = ValueAccess::inner(value);
    if (inner.is_defined() && inner.type().storage() == Type::Storage::text) {
      const std::string& text = characters_of(inner);
      if (const std::size_t wrong = first_no_text(text); wrong != std::string::npos)
        return Error{ErrorCode::invalid_value, "parameter '{}', byte {}: {}", name, wrong + 1,
                     no_text_message(text[wrong])};
    }
    std::string reason = value.reason().empty() ? "" : fmt::format("parameter '${}': {}", name, value.reason());
    result.values.emplace(name, queries::HostValue(std::move(inner), std::move(reason)));
  }
  return result;
}

queries::SessionOptions session_options(const std::filesystem::path& file, const OpenOptions& options) {
  queries::SessionOptions result;
  const std::filesystem::path parent = file.parent_path();
  result.folder = parent.empty() ? "." : parent;
  result.read_only = options.read_only;
  if (!options.failure_folder.empty()) result.failure_folders = {options.failure_folder};
  if (options.memory_bytes) result.memory_bytes = *options.memory_bytes;
  return result;
}

}  // namespace

/// A text whose commands are to be run.
struct Engine::Task {
  std::vector<queries::CommandText> commands;
  queries::SessionParameters parameters;
  Results results;
  std::shared_ptr<Handover> handover;
};

Engine::Engine(std::filesystem::path file, std::filesystem::path folder, std::optional<TemporaryFolder> temporary)
    : file_(std::move(file)), folder_(std::move(folder)), temporary_(std::move(temporary)) {}

Engine::~Engine() {
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

Result<std::shared_ptr<Engine>> Engine::open(const std::filesystem::path& file, const OpenOptions& options,
                                             std::optional<TemporaryFolder> temporary) {
  for (const std::filesystem::path& folder : {options.folder, options.failure_folder})
    if (!folder.empty()) A3D_TRY(check_file_name(folder));
  A3D_TRY(check_file_name(file));
  if (options.read_only || !options.creates) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
      return Error{ErrorCode::database_missing, "there is no database '{}'", file.string()};
  }
  std::shared_ptr<Engine> engine(new Engine(file, options.folder, std::move(temporary)));
  A3D_TRY(engine->open_session(options));
  return engine;
}

Status Engine::open_session(const OpenOptions& options) {
  {
    const SignalBlock block;  // signals are for the threads of the host
    if (!thread_.start([this] { work_until_closed(); }))
      return Error{ErrorCode::out_of_memory, "not enough memory to start a thread"};
  }
  const auto handover = std::make_shared<Handover>();
  post([this, &options, handover] {
    Status status = without_exceptions([&]() -> Status {
      session_ = std::make_unique<queries::Session>(operators(), session_options(file_, options));
      A3D_TRY(session_->open_file(file_));
      opening_notice_ = session_->store()->opening_notice();
      return {};
    });
    handover->finish(std::move(status), {});
  });
  handover->wait_for_columns({});
  return std::move(handover->status());
}

void Engine::post(Work work) {
  const std::lock_guard lock(mutex_);
  work_ = std::move(work);
  changed_.notify_all();
}

void Engine::work_until_closed() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return work_ || is_closing_; });
    if (!work_) break;
    const Work work = *std::exchange(work_, std::nullopt);
    lock.unlock();
    work();
    lock.lock();
  }
  session_.reset();
}

Result<std::shared_ptr<Handover>> Engine::start(std::string_view text, const Parameters& parameters, Results results) {
  A3D_ASSIGN(queries::SessionParameters given, session_parameters(parameters));
  const auto task =
      std::make_shared<Task>(Task{queries::commands_of(text), std::move(given), results, std::make_shared<Handover>()});
  if (results != Results::dropped && task->commands.size() != 1)
    return Error{ErrorCode::wrong_usage, "expected one statement, found {}", task->commands.size()};
  Work work = [this, task] { run(*task); };
  if (is_busy_.exchange(true))
    return Error{ErrorCode::wrong_usage,
                 "another statement of this database runs; read its rows to the end, or close it"};
  is_cancelled_ = false;
  post(std::move(work));
  return task->handover;
}

void Engine::release(Report report) {
  report_ = std::move(report);
  is_busy_ = false;
}

void Engine::run(const Task& task) {
  Report report;
  Status status = without_exceptions([&] { return run_commands(task, report); });
  const queries::Store* const store = session_->store();
  is_in_transaction_ = store != nullptr && store->is_in_explicit_transaction();
  task.handover->finish(std::move(status), std::move(report));
}

Status Engine::run_commands(const Task& task, Report& report) {
  session_->set_parameters(task.parameters);
  Diagnostics diagnostics;
  const Monitor::Report tell = [&](const std::string& how_far) { task.handover->tell(how_far); };
  Context context{.diagnostics = diagnostics, .cancel = &is_cancelled_, .folder = folder_, .report = &tell};
  using Wanted = ResultRows::Wanted;
  ResultRows rows(*task.handover, task.results == Results::rows ? Wanted::rows : Wanted::single_value);
  DroppedResult dropped(*task.handover);
  queries::Presenter& presenter = task.results == Results::dropped ? static_cast<queries::Presenter&>(dropped) : rows;
  const auto counts = [this] {
    return session_->store() != nullptr ? session_->store()->change_counts() : queries::ChangeCounts();
  };
  const queries::ChangeCounts before = counts();
  Status status;
  for (const queries::CommandText& command : task.commands)
    if (status) status = run_command(command, presenter, context, task.results);
  report.notes = diagnostics.summary();
  if (!status) return status;
  const queries::ChangeCounts after = counts();
  report.inserted = after.inserted - before.inserted;
  report.deleted = after.deleted - before.deleted;
  report.updated = after.updated - before.updated;
  return {};
}

Status Engine::run_command(const queries::CommandText& command, queries::Presenter& presenter, Context& context,
                           Results results) {
  if (queries::is_shell_command(command.text))
    return Error(ErrorCode::wrong_usage, "a command of the interactive shell, which a program cannot give")
        .at(command.start);
  A3D_TRY(session_->execute(command.text, command.start, presenter, context));
  const std::string_view failed = session_->failed_result();
  if (results != Results::dropped || failed.empty()) return {};
  const std::vector<std::string> notes = context.diagnostics.summary();
  return Error(ErrorCode::io_error, "the statement has failed, its result is {}: {}", failed,
               notes.empty() ? "no reason is known" : notes.back())
      .at(command.start);
}

}  // namespace algebra3d::database::detail
