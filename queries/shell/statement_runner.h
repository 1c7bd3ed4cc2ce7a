#pragma once

#include <filesystem>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "queries/language/command_reader.h"
#include "queries/session/session.h"
#include "queries/shell/terminal_output.h"

namespace queries {

/// What happened to a list of commands.
enum class RunResult : std::uint8_t { ok, failed, interrupted, quit };

/// Where a runner says what it has to say.
struct Console {
  std::ostream& out;                   ///< what the presenter writes to, and `help`
  std::ostream& errors;                ///< errors, notes, times
  TerminalOutput* terminal = nullptr;  ///< what `out` writes to if it is a terminal
  /// The help of a subcommand of the program, such as import; nothing for any other word. May be empty.
  std::function<std::optional<std::string>(const std::string& name)> program_help = {};
};

/// When a script has failed, and when it ends.
struct FailureRules {
  bool stops_on_error = false;
  bool fails_on_undefined = false;  ///< a reason why any value is undefined makes a statement fail
};

/// Runs commands one after the other: results to the presenter, errors and notes to `errors` with file, line, column.
class StatementRunner {
 public:
  StatementRunner(Session& session, Presenter& presenter, Console console, FailureRules rules)
      : session_(session), presenter_(presenter), console_(std::move(console)), rules_(rules) {}

  /// One command, `help` and `quit` included.
  RunResult run(const CommandText& command);
  /// All commands of a script. After an error the next command follows, unless the runner stops on errors.
  RunResult run_script(std::istream& script, const std::string& name,
                       CommandReader::Skipping skipping = CommandReader::Skipping::comments);
  /// The same for a file. Errors: one that cannot be read, one that runs already, one that lies too deep.
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
  std::vector<std::filesystem::path> scripts_;  // that run at the moment, the innermost last
  int script_depth_ = 0;                        // the same with those that are no files
  std::optional<SourcePlace> failed_begin_;     // what follows in the script, up to its end, is not run on its own
};

}  // namespace queries
