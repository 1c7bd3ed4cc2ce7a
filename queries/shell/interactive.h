#pragma once

#include "queries/shell/statement_runner.h"

namespace queries {

/// The shell on a terminal: a prompt with line editing and history, until `quit` or the end of the input.
/// Ctrl-C ends the running statement, or drops the command that is being typed; the shell goes on.
void run_interactive(Session& session, StatementRunner& runner);

}  // namespace queries
