#include "queries/shell/program.h"

#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <fstream>
#include <functional>
#include <iostream>
#include <system_error>
#include <thread>

#include "algebra3d/operators/all.h"
#include "algebra3d/registry/documentation.h"
#include "queries/importer/import_command.h"
#include "queries/shell/command_table.h"
#include "queries/shell/interactive.h"
#include "queries/shell/interruption.h"
#include "queries/shell/presenters.h"
#include "queries/shell/screen.h"
#include "queries/streams/all.h"
#include "queries/test_runner/test_runner.h"

namespace queries {
namespace {

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kInterrupted = 130;

struct Options {
  std::string database;
  std::string folder;
  std::string commands;
  std::string format = "auto";
  std::vector<std::string> scripts;
  std::vector<std::string> test_files;
  std::string test_filter;
  std::size_t test_jobs = 1;
  bool tests_keep_scratch = false;
  bool tests_vary = false;
  std::string help_operator;
  bool help_as_markdown = false;
  bool is_read_only = false;
  bool stops_on_error = false;
};

int exit_status(RunResult result) {
  if (result == RunResult::failed) return kFailed;
  return result == RunResult::interrupted ? kInterrupted : kOk;
}

std::unique_ptr<Presenter> make_presenter(const Options& options, std::ostream& out) {
  const bool as_table = options.format == "table" || (options.format == "auto" && isatty(STDOUT_FILENO) != 0);
  if (as_table) return std::make_unique<TablePresenter>(out, [] { return screen_size().columns; });
  return std::make_unique<ListPresenter>(out);
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

int run_scripts(const Options& options, StatementRunner& runner) {
  int worst = kOk;
  for (const std::string& name : options.scripts) {
    const RunResult result = runner.run_file(name);
    if (result == RunResult::interrupted) return kInterrupted;
    if (result == RunResult::failed) worst = kFailed;
    if (result == RunResult::failed && options.stops_on_error) return worst;
  }
  return worst;
}

int run_statements(const Options& options, Session& session, StatementRunner& runner, std::ostream& out) {
  if (!options.commands.empty()) {
    std::istringstream commands(options.commands);
    const int status = exit_status(runner.run_script(commands, "-c"));
    if (status != kOk || options.scripts.empty()) return status;
  }
  if (!options.scripts.empty()) return run_scripts(options, runner);
  if (isatty(STDIN_FILENO) == 0) return exit_status(runner.run_script(std::cin, "stdin"));
  return run_interactive(session, runner, out) ? kOk : kInterrupted;
}

/// True, and told, if the session ends in the middle of a transaction.
bool is_transaction_lost(Session& session) {
  if (session.store() == nullptr || !session.store()->is_in_explicit_transaction()) return false;
  std::cerr << "error: the transaction was not committed; what it changed is undone\n";
  return true;
}

int run_session(const Options& options, const algebra3d::Registry& registry) {
  Session session(registry, {.folder = database_folder(options), .read_only = options.is_read_only});
  if (!options.database.empty()) {
    const Status opened = session.open_file(options.database);
    if (!opened) {
      std::cerr << "error: " << opened.error().message << "\n";
      return kFailed;
    }
    if (const std::string& notice = session.store()->opening_notice(); !notice.empty())
      std::cerr << "note: " << notice << "\n";
  }
  TerminalOutput terminal(std::cout, terminal_settings());
  std::ostream terminal_stream(&terminal);
  const bool is_terminal = isatty(STDOUT_FILENO) != 0;
  std::ostream& out = is_terminal ? terminal_stream : std::cout;
  const auto presenter = make_presenter(options, out);
  StatementRunner runner(session, *presenter, {out, std::cerr, is_terminal ? &terminal : nullptr},
                         options.stops_on_error);
  const int status = run_statements(options, session, runner, out);
  return is_transaction_lost(session) && status == kOk ? kFailed : status;
}

int run_tests(const Options& options, const algebra3d::Registry& registry) {
  const TestOptions test_options{[](const std::string& line) { std::cout << line << "\n"; }, &Interruption::flag(),
                                 options.test_filter, options.tests_keep_scratch, options.tests_vary};
  const TestSummary summary = run_test_files(options.test_files, options.test_jobs, registry, test_options);
  if (summary.is_interrupted) return kInterrupted;
  return summary.failed == 0 ? kOk : kFailed;
}

int run_help(const CLI::App& app, const Options& options, const algebra3d::Registry& registry) {
  if (options.help_as_markdown) {
    std::cout << algebra3d::reference_page(registry);
    return kOk;
  }
  if (options.help_operator.empty()) {
    std::cout << shell_help(registry);
    return kOk;
  }
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_name() == options.help_operator) {
      std::cout << command->help();
      return kOk;
    }
  const auto text = shell_help(options.help_operator, registry);
  if (text) {
    std::cout << *text;
    return kOk;
  }
  std::cerr << "error: " << text.error().message << "\n";
  return kWrongUsage;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--db", options.database, "Database file to open from the start; made if it is not there")
      ->type_name("FILE");
  app.add_option("--dir", options.folder,
                 "Folder of the databases of `create`, `open` and `delete database` (default: that of --db, else here)")
      ->type_name("DIR");
  app.add_flag("--read-only", options.is_read_only, "Change nothing");
  app.add_option("-c", options.commands, "Commands to run, separated by ';'")->type_name("'COMMAND; ...'");
  app.add_option("--format", options.format, "Results as nested lists or as tables (default: tables on a terminal)")
      ->check(CLI::IsMember({"auto", "list", "table"}));
  app.add_flag("--stop-on-error", options.stops_on_error, "End a script at its first error");
  app.add_option("SCRIPT", options.scripts, "Scripts to run; without any, and on a terminal: the interactive shell");
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
                 "Repeat every case far from the origin, with the axes exchanged, and with operands swapped");
  return test;
}

// What was asked for and could not be written is a failure: a full disk, a closed device.
int status_after_output(int status) {
  std::cout.flush();
  if (std::cout) return status;
  std::cerr << "error: the output could not be written (is the disk full?)\n";
  return status == kOk ? kFailed : status;
}

int run_arguments(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  Options options;
  ImportOptions import_options;
  CLI::App app{"algebra3d: solids and surfaces as values in a database, with exact geometry"};
  app.footer(
      "The interactive shell completes with Tab, keeps its history in ~/.local/state/algebra3d (or $XDG_STATE_HOME),\n"
      "sends long results through $PAGER, and ends a statement with Ctrl-C; `help` there tells the rest.\n"
      "Exit status: 0 all went well, 1 a command failed, 2 wrong usage, 130 interrupted.");
  app.set_version_flag("--version", "algebra3d 0.1.0");
  app.require_subcommand(0, 1);  // so that `help test` asks for help
  add_options(app, options);
  const CLI::App* import = add_import_command(app, import_options);
  const CLI::App* test = add_test_command(app, options);
  CLI::App* help = app.add_subcommand("help", "Explain an operator or a command, or list all of them");
  help->add_option("OPERATOR", options.help_operator,
                   "Name of an operator or a command, such as volume, let or import");
  help->add_flag("--markdown", options.help_as_markdown, "The whole reference page");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? kOk : kWrongUsage;
  }
  algebra3d::Registry registry = algebra3d::make_registry();
  register_stream_operators(registry);
  if (import->parsed()) return run_import(import_options, registry, &Interruption::flag());
  if (test->parsed()) return run_tests(options, registry);
  if (help->parsed()) return run_help(app, options, registry);
  return run_session(options, registry);
}

// How deep expressions and calls may be nested is fixed, and must not depend on the user's `ulimit -s`: the work is
// done on a thread with a stack of its own, and so is that of all further threads.
int on_own_stack(const std::function<int()>& work) {
  constexpr std::size_t kStackBytes = std::size_t{64} << 20U;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  // Signals are for that thread: they end its waiting for a key.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  int status = kFailed;
  const auto work_with_signals = [&] {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    status = work();
  };
  try {
    std::thread(work_with_signals).join();
  } catch (const std::system_error&) {
    work_with_signals();  // no room for the stack
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return status;
}

}  // namespace

int run_program(int argc, char** argv) {
  const Interruption interruption;
  return status_after_output(on_own_stack([&] { return run_arguments(argc, argv); }));
}

}  // namespace queries
