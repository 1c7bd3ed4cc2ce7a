#pragma once

#include "queries/shell/completion.h"

#include "queries/session/session.h"

namespace queries {

/// What can be completed in a session as it is now. Reads the catalogue of the open database, if there is one; a
/// catalogue that cannot be read gives no names.
CompletionNames session_names(Session& session);

}  // namespace queries
