#pragma once

#include <string>
#include <vector>

#include "queries/language/typed_tree.h"
#include "queries/streams/index_candidates.h"

namespace queries {

/// A part of the condition of a filter that an index may answer: whatever tuple fulfils the condition, its attribute is
/// as `use` says.
struct IndexCondition {
  IndexUse use;
  std::string attribute;
  TypedPtr operand;          ///< the same for all tuples
  TypedPtr limit = nullptr;  ///< of `is_near` and `between`
};

/// Conditions of which whatever tuple fulfils a predicate fulfils at least one.
using IndexConditions = std::vector<IndexCondition>;

/// True if the value of an expression in the function of a filter does not depend on the tuple that is filtered: it has
/// no parameters of that function, and only pure operators on values.
bool is_same_for_all_tuples(const TypedNode& expression);

/// The conditions of which a predicate is the conjunction by `and`, in their order.
std::vector<TypedPtr> conjuncts(const TypedNode& predicate);

/// The conditions for indexes of a filter's predicate: those of its conjuncts, in their order, for which indexes may
/// help.
std::vector<IndexConditions> index_conditions(const TypedNode& predicate);

}  // namespace queries
