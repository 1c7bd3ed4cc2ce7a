#include "queries/shell/program.h"

#include <unistd.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/version.h"
#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/polled_input.h"
#include "base/propagate.h"
#include "base/signal_block.h"
#include "base/stack_thread.h"
#include "base/work_memory.h"
#include "mesh_formats/mesh_formats.h"
#include "queries/importer/import_command.h"
#include "queries/importer/import_options.h"
#include "queries/importer/importer.h"
#include "queries/language/documentation.h"
#include "queries/server/serve_command.h"
#include "queries/shell/detail/command_line.h"
#include "queries/shell/detail/command_table.h"
#include "queries/shell/detail/completion_script.h"
#include "queries/shell/detail/file_arguments.h"
#include "queries/shell/detail/interactive.h"
#include "queries/shell/detail/interruption.h"
#include "queries/shell/detail/man_page.h"
#include "queries/shell/detail/mesh_commands.h"
#include "queries/shell/detail/result_format.h"
#include "queries/shell/detail/screen.h"
#include "queries/streams/all.h"
#include "queries/test_runner/test_runner.h"
#include "queries/transfer/transfer.h"
#include "queries/transfer/transfer_command.h"

namespace queries {
namespace {

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kInterrupted = 130;

struct Options {
  std::string database;
  std::string folder;
  std::string failure_folder;
  std::vector<std::string> commands;
  std::vector<std::string> parameters;
  ResultFormat format;
  std::vector<std::string> scripts;
  std::vector<std::string> test_files;
  std::string test_filter;
  std::size_t test_jobs = 1;
  bool tests_keep_scratch = false;
  bool tests_vary = false;
  std::vector<std::string> help_words;
  bool help_as_markdown = false;
  bool help_as_man_page = false;
  std::string completed_shell;
  bool is_read_only = false;
  std::size_t memory_megabytes = 0;  // 0: the default
  FailureRules failure_rules;
};

int exit_status(RunResult result) {
  if (result == RunResult::failed) return kFailed;
  return result == RunResult::interrupted ? kInterrupted : kOk;
}

// A pager and a line that comes and goes are for people.
TerminalOutput::Settings terminal_settings() {
  TerminalOutput::Settings settings;
  if (isatty(STDIN_FILENO) != 0) settings.pager = usual_pager();
  if (isatty(STDERR_FILENO) != 0) settings.progress = &std::cerr;
  return settings;
}

std::filesystem::path database_folder(const Options& options) {
  if (!options.folder.empty()) return options.folder;
  const auto parent = std::filesystem::path(options.database).parent_path();
  return parent.empty() ? "." : parent;
}

// Where the user looks first; a folder that takes no files must not lose the report.
std::vector<std::filesystem::path> failure_folders(const Options& options) {
  if (!options.failure_folder.empty()) return {options.failure_folder};
  return {".", algebra3d::WorkMemory::default_folder()};
}

RunResult run_standard_input(StatementRunner& runner) {
  // Known by its content only if it is a regular file, of which nothing is read by that.
  if (const std::string why = why_no_script("/dev/stdin"); !why.empty()) {
    std::cerr << "error: cannot read standard input as a script: " << why << "\n";
    return RunResult::failed;
  }
  algebra3d::PolledInput input(STDIN_FILENO, &Interruption::flag());
  std::istream commands(&input);
  return runner.run_script(commands, "stdin");
}

int run_scripts(const Options& options, StatementRunner& runner) {
  int worst = kOk;
  for (const std::string& name : options.scripts) {
    const RunResult result = name == "-" ? run_standard_input(runner) : runner.run_file(name);
    if (result == RunResult::interrupted) return kInterrupted;
    if (result == RunResult::failed) worst = kFailed;
    if (result == RunResult::failed && options.failure_rules.stops_on_error) return worst;
  }
  return worst;
}

/// Each `-c` in its order. An error in one does not keep the next from running, as in a script.
int run_commands(const Options& options, StatementRunner& runner) {
  int worst = kOk;
  for (const std::string& text : options.commands) {
    std::istringstream commands(text);
    const RunResult result = runner.run_script(commands, "-c");
    if (result == RunResult::interrupted) return kInterrupted;
    if (result == RunResult::failed) worst = kFailed;
    if (result == RunResult::quit || (result == RunResult::failed && options.failure_rules.stops_on_error))
      return worst;
  }
  return worst;
}

int run_statements(const Options& options, Session& session, StatementRunner& runner, std::ostream& out) {
  if (!options.commands.empty()) {
    const int status = run_commands(options, runner);
    if (status != kOk || options.scripts.empty()) return status;
  }
  if (!options.scripts.empty()) return run_scripts(options, runner);
  if (isatty(STDIN_FILENO) == 0) return exit_status(run_standard_input(runner));
  return run_interactive(session, runner, out) ? kOk : kInterrupted;
}

/// True, with a message, if the session ends in the middle of a transaction.
bool is_transaction_lost(Session& session) {
  if (session.store() == nullptr || !session.store()->is_in_explicit_transaction()) return false;
  std::cerr << "error: the transaction was not committed; its changes are undone\n";
  return true;
}

Result<SessionParameters> session_parameters(const std::vector<std::string>& given,
                                             const algebra3d::Registry& registry) {
  SessionParameters parameters;
  for (const std::string& text : given) {
    A3D_ASSIGN(auto parameter, parse_session_parameter(text, registry));
    if (!parameters.values.insert(parameter).second)
      return Error{ErrorCode::wrong_usage, "-p {}: the parameter is given twice", parameter.first};
  }
  return parameters;
}

std::optional<std::string> subcommand_help(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_name() == name) return command->help();
  return std::nullopt;
}

// A name that was mistyped makes an empty database, in which a script then finds nothing; one that runs knows what it
// does.
void tell_of_new_database(const Options& options, const Session& session) {
  if (!session.has_made_database()) return;
  std::cerr << "note: there was no database '" << printable(options.database) << "'; a new, empty one was made\n";
}

int run_session(const CLI::App& app, const Options& options, const algebra3d::Registry& registry) {
  auto parameters = session_parameters(options.parameters, registry);
  if (!parameters) {
    std::cerr << "error: " << parameters.error().text() << "\n";
    return kWrongUsage;
  }
  if (!options.failure_folder.empty())
    if (const Status prepared = prepare_failure_folder(options.failure_folder); !prepared) {
      std::cerr << "error: --failure-folder: " << prepared.error().text() << "\n";
      return kWrongUsage;
    }
  Session session(registry, {.folder = database_folder(options),
                             .read_only = options.is_read_only,
                             .memory_bytes = algebra3d::MemoryUser::current()->limit(),
                             .failure_folders = failure_folders(options),
                             .parameters = *std::move(parameters)});
  bool is_damaged = false;
  if (!options.database.empty()) {
    const Status opened = session.open_file(options.database);
    is_damaged = !opened && opened.error().code == ErrorCode::database_corrupt;
    if (!opened) std::cerr << "error: " << opened.error().text() << "\n";
    if (!opened && !is_damaged) return kFailed;
    if (const std::string notice = is_damaged ? "" : session.store()->opening_notice(); !notice.empty())
      std::cerr << "note: " << notice << "\n";
  }
  TerminalOutput terminal(std::cout, terminal_settings());
  std::ostream terminal_stream(&terminal);
  const bool is_terminal = isatty(STDOUT_FILENO) != 0;
  std::ostream& out = is_terminal ? terminal_stream : std::cout;
  FormattedResults results(options.format, out);
  // The shell has a `help` of its own.
  const auto program_help = [&app](const std::string& name) {
    return name == "help" ? std::nullopt : subcommand_help(app, name);
  };
  StatementRunner runner(session, results.presenter(),
                         {out, std::cerr, is_terminal ? &terminal : nullptr, program_help}, options.failure_rules);
  const bool is_prompt = options.commands.empty() && options.scripts.empty() && isatty(STDIN_FILENO) != 0;
  if (is_prompt) tell_of_new_database(options, session);
  const int status = run_statements(options, session, runner, out);
  if (!is_prompt && status != kOk) tell_of_new_database(options, session);
  return (is_damaged || is_transaction_lost(session)) && status == kOk ? kFailed : status;
}

int run_tests(const Options& options, const algebra3d::Registry& registry) {
  for (const std::string& file : options.test_files)
    if (const std::string why = why_no_script(file); !why.empty()) {
      std::cerr << "error: '" << printable(file) << "' holds no tests: " << why << "\n";
      return kWrongUsage;
    }
  const TestOptions test_options{[](const std::string& line) { std::cout << line << "\n"; }, &Interruption::flag(),
                                 options.test_filter, options.tests_keep_scratch, options.tests_vary};
  // One limit for the sessions of all files that run at once.
  algebra3d::ProcessMemory::set_limit(algebra3d::MemoryUser::current()->limit());
  const TestSummary summary = run_test_files(options.test_files, options.test_jobs, registry, test_options);
  if (summary.is_interrupted) return kInterrupted;
  return summary.failed == 0 ? kOk : kFailed;
}

int run_help(const CLI::App& app, const Options& options, const algebra3d::Registry& registry) {
  if (options.help_as_markdown) {
    std::cout << reference_page(registry);
    return kOk;
  }
  if (options.help_as_man_page) {
    std::cout << man_page(command_line_of(app), registry);
    return kOk;
  }
  if (!options.completed_shell.empty()) {
    const CommandLine program = command_line_of(app);
    std::cout << (options.completed_shell == "bash" ? bash_completion(program, registry)
                                                    : zsh_completion(program, registry));
    return kOk;
  }
  if (options.help_words.empty()) {
    std::cout << shell_help(registry);
    return kOk;
  }
  const std::string name = fmt::format("{}", fmt::join(options.help_words, " "));
  if (const auto text = subcommand_help(app, name)) {
    std::cout << *text;
    if (const std::string own = exact_help(name, registry); !own.empty()) std::cout << "\n" << own;
    return kOk;
  }
  const auto text = shell_help(name, registry);
  if (text) {
    std::cout << *text;
    return kOk;
  }
  std::cerr << "error: " << text.error().text() << "\n";
  return kWrongUsage;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--db", options.database, "Database file to open at the start; created if it does not exist")
      ->type_name("FILE");
  app.add_option("--dir", options.folder,
                 "Folder of the databases of `create`, `open` and `delete database` (default: that of --db, else here)")
      ->type_name("DIR");
  app.add_flag("--read-only", options.is_read_only, "Change nothing");
  app.add_option("--memory", options.memory_megabytes,
                 "Memory limit in megabytes (default: three quarters of what the machine or its control group has)")
      ->check(CLI::Range(1, 1 << 30))
      ->type_name("MB");
  app.add_option("-c", options.commands, "Commands to run, separated by ';'; may be given several times")
      ->type_name("'COMMAND; ...'")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  app.add_option("-p,--param", options.parameters,
                 "Value of $NAME in commands and scripts: a number, TRUE or FALSE, else a string; of a stated "
                 "type with NAME:TYPE=VALUE. May be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  add_format_options(app, options.format);
  app.add_flag("--stop-on-error", options.failure_rules.stops_on_error,
               "End a script at its first error, or failed import or export");
  app.add_flag("--fail-on-undefined", options.failure_rules.fails_on_undefined,
               "A statement fails if any value becomes undefined, also inside streams");
  app.add_option("--failure-folder", options.failure_folder,
                 "Folder for reports of internal errors, made if it is missing (default: the current folder, else that "
                 "of temporary files)")
      ->type_name("DIR");
  app.add_option("FILE", options.scripts,
                 "Scripts to run (- is standard input), a database to open, or " +
                     mesh_formats::known_mesh_formats().names("and") +
                     " files to look at;\n"
                     "without any, and on a terminal: the interactive shell")
      ->type_name("");
}

/// Finds out by their contents what the named files are; mesh files are shown. The exit status if that was all.
std::optional<int> take_files(Options& options, const MeshConsole& console) {
  auto files = sort_named_files(options.scripts);
  const auto refuse = [&](const std::string& why) {
    console.errors << "error: " << why << "\n";
    return kWrongUsage;
  };
  if (!files) return refuse(files.error().text());
  if (!files->meshes.empty()) {
    if (!options.database.empty() || !options.commands.empty())
      return refuse("'" + files->meshes.front() + "' is a mesh file, which is shown without --db and -c");
    return show_mesh_files(files->meshes, console);
  }
  options.scripts = std::move(files->scripts);
  if (files->database.empty()) return std::nullopt;
  if (!options.database.empty())
    return refuse("'" + options.database + "' and '" + files->database + "' are databases; one can be open");
  options.database = std::move(files->database);
  return std::nullopt;
}

/// The exit status of a command on files, if there is one, also when it hears a signal where nothing is polled by hand.
std::optional<int> until_interrupted(const MeshConsole& console, const std::function<std::optional<int>()>& command) {
  const algebra3d::InterruptionScope scope(console.cancel);
  try {
    return command();
  } catch (const algebra3d::Interrupted&) {
    console.errors << "error: interrupted\n";
    return kInterrupted;
  }
}

const CLI::App* add_test_command(CLI::App& app, Options& options) {
  CLI::App* test = app.add_subcommand("test", "Run files of regression tests; the last line is 'N passed, N failed'");
  test->add_option("FILES", options.test_files, "Files that end in .test or .examples")->required();
  test->add_option("--filter", options.test_filter,
                   "Judge only the test cases whose name contains this; * and ? stand for any characters")
      ->type_name("PATTERN");
  test->add_flag("--keep", options.tests_keep_scratch, "Keep the folder of each run, and say where it is");
  test->add_option("--jobs", options.test_jobs, "Files to run at once")->check(CLI::Range(1, 256))->type_name("N");
  test->add_flag("--vary", options.tests_vary,
                 "Repeat every case far from the origin, with permuted axes, and with swapped operands");
  return test;
}

// Output that could not be written is a failure: a full disk, a closed device.
int status_after_output(int status) {
  std::cout.flush();
  if (std::cout) return status;
  std::cerr << "error: the output could not be written (is the disk full?)\n";
  return status == kOk ? kFailed : status;
}

int run_in_memory(const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc& failure) {
    std::cerr << "error: " << algebra3d::memory_error(failure).message << "\n";
    return kFailed;
  }
}

// How deep expressions and calls may be nested is fixed, and must not depend on the user's `ulimit -s`: the work is
// done on a thread with a stack of its own, and so is that of all further threads.
int on_own_stack(const std::function<int()>& work) {
  algebra3d::StackThread::make_default();
  // Signals are for that thread: they end its waiting for a key.
  const algebra3d::SignalBlock block;
  int status = kFailed;
  const auto work_with_signals = [&] {
    pthread_sigmask(SIG_SETMASK, &block.before(), nullptr);
    status = run_in_memory(work);
  };
  algebra3d::StackThread thread;
  if (!thread.start(work_with_signals)) work_with_signals();  // no room for the stack
  thread.join();
  return status;
}

// All operators. Made before the thread of the work, whose heap grows by a page at a time, and kept: to make and free
// them is a large part of a short run.
const algebra3d::Registry& all_operators() {
  static const algebra3d::Registry* const kept = [] {
    auto* registry = new algebra3d::Registry(algebra3d::make_registry());  // NOLINT(*-owning-memory)
    register_stream_operators(*registry);
    return registry;
  }();
  return *kept;
}

int run_arguments(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  Options options;
  ImportOptions import_options;
  TransferOptions transfer_options;
  CLI::App app{"algebra3d: solids and surfaces as values in a database, with exact geometry"};
  app.footer(
      "New here? The tutorial leads to answers on your own files in a quarter of an hour: docs/tutorial.md in the\n"
      "sources, /usr/share/doc/algebra3d/docs/tutorial.md in the package.\n\n"
      "The interactive shell completes with Tab, keeps its history in ~/.local/state/algebra3d (or $XDG_STATE_HOME),\n"
      "sends long results through $PAGER, and ends a statement with Ctrl-C; `help` there lists the rest.\n"
      "Exit status: 0 all went well, 1 a command failed, 2 wrong usage, 130 interrupted.");
  app.set_version_flag("--version", std::string("algebra3d ") + algebra3d::kVersion);
  app.require_subcommand(0, 1);  // so that `help test` asks for help
  add_options(app, options);
  const CLI::App* import = add_import_command(app, import_options);
  const CLI::App* push = add_push_command(app, transfer_options);
  const CLI::App* pull = add_pull_command(app, transfer_options);
  const CLI::App* test = add_test_command(app, options);
  ServerOptions server_options;
  const CLI::App* serve = add_serve_command(app, server_options);
  MeshCommands meshes;
  meshes.add_to(app);
  CLI::App* help = app.add_subcommand("help", "Explain an operator or a command, or list all of them");
  help->add_option("OPERATOR", options.help_words,
                   "Name of an operator, a family or a command, such as volume, set operations, let or import");
  help->add_flag("--markdown", options.help_as_markdown, "The whole reference page");
  help->add_flag("--man", options.help_as_man_page, "The manual page, for the program man");
  help->add_option("--completion", options.completed_shell, "The script by which a shell completes the command line")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->type_name("SHELL");
  try {
    app.parse(argc, argv);
    check_format_options(options.format);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? kOk : kWrongUsage;
  }
  if (serve->parsed()) {
    if (options.memory_megabytes > 0 && server_options.memory_megabytes == 0)
      server_options.memory_megabytes = options.memory_megabytes;
    const std::size_t limit = memory_limit_of(server_options);
    algebra3d::ProcessMemory::set_limit(limit, limit / 8);
    const algebra3d::Registry& registry = all_operators();
    return on_own_stack([&] { return run_serve(server_options, registry, Interruption::flag()); });
  }
  if (app.get_subcommands().empty()) (void)all_operators();
  return on_own_stack([&] {
    const std::size_t given = options.memory_megabytes << 20U;
    algebra3d::MemoryUser user(given > 0 ? given : algebra3d::ProcessMemory::default_limit());
    const algebra3d::MemoryUserScope scope(&user);
    const MeshConsole console{std::cout, std::cerr, &Interruption::flag()};
    if (const auto status = until_interrupted(console, [&] { return meshes.run(console); })) return *status;
    const algebra3d::Registry& registry = all_operators();
    if (import->parsed()) return run_import(import_options, registry, &Interruption::flag());
    if (push->parsed()) return run_push(transfer_options, registry, &Interruption::flag());
    if (pull->parsed()) return run_pull(transfer_options, registry, &Interruption::flag());
    if (test->parsed()) return run_tests(options, registry);
    if (help->parsed()) return run_help(app, options, registry);
    if (const auto status = until_interrupted(console, [&] { return take_files(options, console); })) return *status;
    return run_session(app, options, registry);
  });
}

}  // namespace

int run_program(int argc, char** argv) {
  const Interruption interruption;
  return status_after_output(run_in_memory([&] { return run_arguments(argc, argv); }));
}

}  // namespace queries
