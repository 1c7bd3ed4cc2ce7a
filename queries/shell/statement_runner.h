#pragma once

#include <istream>
#include <ostream>
#include <string>

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
  RunResult run_script(std::istream& script, const std::string& name);

 private:
  bool run_help(const std::string& text);

  Session& session_;
  Presenter& presenter_;
  std::ostream& errors_;
  bool stops_on_error_;
};

}  // namespace queries
