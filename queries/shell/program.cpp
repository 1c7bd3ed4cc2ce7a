#include "queries/shell/program.h"

#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <system_error>
#include <thread>

#include "algebra3d/operators/all.h"
#include "algebra3d/registry/documentation.h"
#include "queries/importer/import_command.h"
#include "queries/shell/command_table.h"
#include "queries/shell/file_arguments.h"
#include "queries/shell/interactive.h"
#include "queries/shell/interruption.h"
#include "queries/shell/mesh_commands.h"
#include "queries/shell/result_format.h"
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
  std::vector<std::string> commands;
  std::vector<std::string> parameters;
  ResultFormat format;
  std::vector<std::string> scripts;
  std::vector<std::string> test_files;
  std::string test_filter;
  std::size_t test_jobs = 1;
  bool tests_keep_scratch = false;
  bool tests_vary = false;
  std::string help_operator;
  bool help_as_markdown = false;
  bool is_read_only = false;
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

int run_scripts(const Options& options, StatementRunner& runner) {
  int worst = kOk;
  for (const std::string& name : options.scripts) {
    const RunResult result = name == "-" ? runner.run_script(std::cin, "stdin") : runner.run_file(name);
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
  if (isatty(STDIN_FILENO) == 0) return exit_status(runner.run_script(std::cin, "stdin"));
  return run_interactive(session, runner, out) ? kOk : kInterrupted;
}

/// True, and told, if the session ends in the middle of a transaction.
bool is_transaction_lost(Session& session) {
  if (session.store() == nullptr || !session.store()->is_in_explicit_transaction()) return false;
  std::cerr << "error: the transaction was not committed; what it changed is undone\n";
  return true;
}

Result<SessionParameters> session_parameters(const std::vector<std::string>& given,
                                             const algebra3d::Registry& registry) {
  SessionParameters parameters;
  for (const std::string& text : given) {
    ASSIGN_OR_RETURN(auto parameter, parse_session_parameter(text, registry));
    if (!parameters.insert(parameter).second)
      return Error{ErrorCode::wrong_usage, "-p {}: the parameter is given twice", parameter.first};
  }
  return parameters;
}

std::optional<std::string> subcommand_help(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_name() == name) return command->help();
  return std::nullopt;
}

int run_session(const CLI::App& app, const Options& options, const algebra3d::Registry& registry) {
  auto parameters = session_parameters(options.parameters, registry);
  if (!parameters) {
    std::cerr << "error: " << parameters.error().message << "\n";
    return kWrongUsage;
  }
  Session session(
      registry,
      {.folder = database_folder(options), .read_only = options.is_read_only, .parameters = *std::move(parameters)});
  bool is_damaged = false;
  if (!options.database.empty()) {
    const Status opened = session.open_file(options.database);
    is_damaged = !opened && opened.error().code == ErrorCode::database_corrupt;
    if (!opened) std::cerr << "error: " << opened.error().message << "\n";
    if (!opened && !is_damaged) return kFailed;
    if (const std::string notice = is_damaged ? "" : session.store()->opening_notice(); !notice.empty())
      std::cerr << "note: " << notice << "\n";
  }
  TerminalOutput terminal(std::cout, terminal_settings());
  std::ostream terminal_stream(&terminal);
  const bool is_terminal = isatty(STDOUT_FILENO) != 0;
  std::ostream& out = is_terminal ? terminal_stream : std::cout;
  FormattedResults results(options.format, registry, out);
  // The shell has a `help` of its own.
  const auto program_help = [&app](const std::string& name) {
    return name == "help" ? std::nullopt : subcommand_help(app, name);
  };
  StatementRunner runner(session, results.presenter(),
                         {out, std::cerr, is_terminal ? &terminal : nullptr, program_help}, options.failure_rules);
  const int status = run_statements(options, session, runner, out);
  return (is_damaged || is_transaction_lost(session)) && status == kOk ? kFailed : status;
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
  if (const auto text = subcommand_help(app, options.help_operator)) {
    std::cout << *text;
    if (const std::string own = exact_help(options.help_operator, registry); !own.empty()) std::cout << "\n" << own;
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
  app.add_option("-c", options.commands, "Commands to run, separated by ';'; may be given several times")
      ->type_name("'COMMAND; ...'")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  app.add_option("-p,--param", options.parameters,
                 "What $NAME stands for in commands and scripts: a number, TRUE or FALSE, else a string; of a stated "
                 "type with NAME:TYPE=VALUE. May be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  add_format_options(app, options.format);
  app.add_flag("--stop-on-error", options.failure_rules.stops_on_error,
               "End a script at its first error, or failed import or export");
  app.add_flag("--fail-on-undefined", options.failure_rules.fails_on_undefined,
               "A statement fails wherever a value turns undefined with a reason, also inside streams");
  app.add_option("FILE", options.scripts,
                 "Scripts to run (- is standard input), a database to open, or STL, OBJ and OFF files to look at;\n"
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
  if (!files) return refuse(files.error().message);
  if (!files->meshes.empty()) {
    if (!options.database.empty() || !options.commands.empty())
      return refuse("'" + files->meshes.front() + "' is a mesh file, and is looked at without --db and -c");
    return show_mesh_files(files->meshes, console);
  }
  options.scripts = std::move(files->scripts);
  if (files->database.empty()) return std::nullopt;
  if (!options.database.empty())
    return refuse("'" + options.database + "' and '" + files->database + "' are databases; one can be open");
  options.database = std::move(files->database);
  return std::nullopt;
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
      "New here? docs/tutorial.md leads to answers on your own files in a quarter of an hour.\n\n"
      "The interactive shell completes with Tab, keeps its history in ~/.local/state/algebra3d (or $XDG_STATE_HOME),\n"
      "sends long results through $PAGER, and ends a statement with Ctrl-C; `help` there tells the rest.\n"
      "Exit status: 0 all went well, 1 a command failed, 2 wrong usage, 130 interrupted.");
  app.set_version_flag("--version", "algebra3d 0.1.0");
  app.require_subcommand(0, 1);  // so that `help test` asks for help
  add_options(app, options);
  const CLI::App* import = add_import_command(app, import_options);
  const CLI::App* test = add_test_command(app, options);
  MeshCommands meshes;
  meshes.add_to(app);
  CLI::App* help = app.add_subcommand("help", "Explain an operator or a command, or list all of them");
  help->add_option("OPERATOR", options.help_operator,
                   "Name of an operator or a command, such as volume, let or import");
  help->add_flag("--markdown", options.help_as_markdown, "The whole reference page");
  try {
    app.parse(argc, argv);
    check_format_options(options.format);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? kOk : kWrongUsage;
  }
  const MeshConsole console{std::cout, std::cerr, &Interruption::flag()};
  if (const auto status = meshes.run(console)) return *status;
  algebra3d::Registry registry = algebra3d::make_registry();
  register_stream_operators(registry);
  if (import->parsed()) return run_import(import_options, registry, &Interruption::flag());
  if (test->parsed()) return run_tests(options, registry);
  if (help->parsed()) return run_help(app, options, registry);
  if (const auto status = take_files(options, console)) return *status;
  return run_session(app, options, registry);
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
