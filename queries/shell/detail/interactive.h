#pragma once

#include <ostream>

#include "queries/shell/detail/statement_runner.h"

namespace queries {

/// The shell on a terminal: a prompt with line editing, history and completion, until `quit` or the end of the input.
/// Ctrl-C ends the running statement, or drops the command that is being typed; the shell goes on. SIGTERM ends it.
/// True unless it was ended by a signal.
bool run_interactive(Session& session, StatementRunner& runner, std::ostream& out);

}  // namespace queries
