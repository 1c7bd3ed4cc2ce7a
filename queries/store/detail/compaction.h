#pragma once

#include "queries/store/detail/database.h"

namespace queries {

/// Makes row groups of the tuples that stand beside them, where there are many, and writes groups anew of which many
/// tuples are dead: of the relations that the statement has changed, at its end. Errors: those of reading and writing,
/// interrupted.
Status compact_relations(Database& database);

}  // namespace queries
