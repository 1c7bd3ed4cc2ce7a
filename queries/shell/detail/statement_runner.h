#pragma once

#include <filesystem>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "queries/language/command_reader.h"
#include "queries/session/session.h"
#include "queries/shell/detail/terminal_output.h"

namespace queries {

/// The result of running commands.
enum class RunResult : std::uint8_t { ok, failed, interrupted, quit };

/// The output streams of a runner.
struct Console {
  std::ostream& out;                   ///< for the presenter and `help`
  std::ostream& errors;                ///< errors, notes, times
  TerminalOutput* terminal = nullptr;  ///< the terminal behind `out`, if it is one
  /// The help of a subcommand of the program, such as import; nothing for any other word. May be empty.
  std::function<std::optional<std::string>(const std::string& name)> program_help = {};
};

/// Rules for the failure and the end of a script.
struct FailureRules {
  bool stops_on_error = false;
  bool fails_on_undefined = false;  ///< a statement fails if any value becomes undefined
};

/// Runs commands: results go to the presenter, errors and notes to `errors` with file, line and column.
class StatementRunner {
 public:
  StatementRunner(Session& session, Presenter& presenter, Console console, FailureRules rules)
      : session_(session), presenter_(presenter), console_(std::move(console)), rules_(rules) {}

  /// Runs one command, also `help` and `quit`.
  RunResult run(const CommandText& command);
  /// Runs all commands of a script. Continues after an error, unless the runner stops on errors.
  RunResult run_script(std::istream& script, const std::string& name,
                       CommandReader::Skipping skipping = CommandReader::Skipping::comments);
  /// Runs a script file. Errors: the file cannot be read, is running already, or is nested too deeply.
  RunResult run_file(const std::string& file, CommandReader::Skipping skipping = CommandReader::Skipping::comments,
                     const SourcePlace& place = {});

 private:
  Status execute(const CommandText& command, Context& context);
  RunResult conclude(const CommandText& command, const Status& status);
  RunResult judge_values(const CommandText& command, const algebra3d::Diagnostics& diagnostics);
  RunResult run_lines(std::istream& script, CommandReader& reader);
  RunResult run_all(const std::vector<CommandText>& commands, bool& has_failed);
  RunResult refuse(const CommandText& command);
  // internal_commands.cpp
  RunResult run_shell_command(const CommandText& command);
  RunResult help(const std::string& name);
  void show_help(const std::string& text);
  RunResult include(const CommandText& command);
  RunResult repeat(const CommandText& command, const std::string& text);
  RunResult complain(const std::string& message, const SourcePlace& place = {});

  Session& session_;
  Presenter& presenter_;
  Console console_;
  FailureRules rules_;
  std::vector<std::filesystem::path> scripts_;  // running scripts, the innermost last
  int script_depth_ = 0;                        // number of running scripts, also those that are not files
  std::optional<SourcePlace> failed_begin_;     // commands after it, up to the end of the transaction, are not run
};

}  // namespace queries
