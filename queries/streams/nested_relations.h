#pragma once

#include "queries/streams/relation.h"

namespace queries {

/// The relation that a result is shown as: a relation, or a defined nested relation, which is loaded. Null for every
/// other result. Errors: those of the store.
Result<RelationPtr> table_of(const TypeExpr& type, const Datum& value);

}  // namespace queries
