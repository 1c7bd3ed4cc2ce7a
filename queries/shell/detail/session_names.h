#pragma once

#include "queries/shell/detail/completion.h"

#include "queries/session/session.h"

namespace queries {

/// The names for completion in a session. Reads the catalogue of the open database, if any; without names if that
/// fails.
CompletionNames session_names(Session& session);

}  // namespace queries
