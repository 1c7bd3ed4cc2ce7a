#pragma once

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/relation.h"

namespace queries {

/// The relation that a result is shown as: a relation, or a defined nested relation, which is loaded. Null for every
/// other result. Errors: those of the store.
Result<RelationPtr> table_of(const TypeExpr& type, const Datum& value);

/// The types for lists of types: those of a registry, and one that stands for all nested relations.
std::vector<const algebra3d::Type*> listed_types(const algebra3d::Registry& registry);

}  // namespace queries
