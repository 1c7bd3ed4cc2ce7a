#pragma once

#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/detail/refined_join.h"
#include "queries/streams/mapping.h"

namespace queries {

/// The name of a spatial predicate in the argument at `place`: a constant, one of those that hold only of sets that
/// meet, so that meeting boxes find all pairs. Errors: type_error for any other.
Result<std::string> predicate_name(const MappingCheck& check, std::size_t place);
/// These names as text: "intersects, touches, inside, ...".
std::string predicate_names();

/// The test whether a predicate with such a name holds of a pair in its order; if `in_both_orders`, else in the other
/// one.
PairTest predicate_test(const std::string& name, bool in_both_orders);
/// The test whether sets are at most a limit, a real, apart; none are for an undefined limit.
PairTest distance_test(const Value& limit);
/// The window of the partners for `distance_test`; empty for an undefined or negative limit.
WindowOfBox distance_window(const Value& limit);

/// Checks that the registry has an operator for these types of arguments. Errors: those of the operator.
Status check_operands(const algebra3d::Registry& registry, std::string_view name, std::span<const TypeExpr> types);

}  // namespace queries
