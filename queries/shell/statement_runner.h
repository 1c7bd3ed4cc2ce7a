#pragma once

#include <filesystem>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "queries/language/command_reader.h"
#include "queries/session/session.h"

namespace queries {

/// What happened to a list of commands.
enum class RunResult : std::uint8_t { ok, failed, interrupted, quit };

/// Runs commands one after the other: results to the presenter, errors and notes to `errors` with file, line, column.
class StatementRunner {
 public:
  StatementRunner(Session& session, Presenter& presenter, std::ostream& errors, bool stops_on_error)
      : session_(session), presenter_(presenter), errors_(errors), stops_on_error_(stops_on_error) {}

  /// One command, `help` and `quit` included.
  RunResult run(const CommandText& command);
  /// All commands of a script. After an error the next command follows, unless the runner stops on errors.
  RunResult run_script(std::istream& script, const std::string& name,
                       CommandReader::Skipping skipping = CommandReader::Skipping::comments);
  /// The same for a file. Errors: one that cannot be read, one that runs already, one that lies too deep.
  RunResult run_file(const std::string& file, CommandReader::Skipping skipping = CommandReader::Skipping::comments);

 private:
  // internal_commands.cpp
  RunResult run_shell_command(const std::string& text);
  RunResult help(const std::string& name);
  RunResult include(const std::string& text);
  RunResult repeat(const std::string& text);
  RunResult complain(const std::string& message);

  Session& session_;
  Presenter& presenter_;
  std::ostream& errors_;
  bool stops_on_error_;
  std::vector<std::filesystem::path> scripts_;  // that run at the moment, the innermost last
};

}  // namespace queries
