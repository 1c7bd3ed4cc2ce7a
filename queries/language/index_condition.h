#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/streams/index_candidates.h"

namespace queries {

/// A part of the condition of a filter that an index may answer: whatever tuple fulfils the condition, its attribute is
/// as `use` says.
struct IndexCondition {
  IndexUse use;
  std::string attribute;
  ExpressionPtr operand;          ///< the same for all tuples
  ExpressionPtr limit = nullptr;  ///< of `is_near`
  std::string text;               ///< "S intersects", for people
};

/// True if the value of an expression does not depend on the tuple that is filtered: it has no attributes and no
/// implicit parameters, and only pure operators on values.
bool is_same_for_all_tuples(const Expression& expression, const algebra3d::Registry& registry);

/// The conditions of which the predicate of a filter is the conjunction, as far as an index may answer them, in their
/// order. `is_function(name)`: whether the database has a function that a call would mean instead of the operator.
std::vector<IndexCondition> index_conditions(const Expression& predicate, const algebra3d::Registry& registry,
                                             const std::function<bool(const std::string& name)>& is_function);

}  // namespace queries
