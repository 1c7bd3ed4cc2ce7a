#pragma once

#include <string>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"

namespace queries {

/// The examples of an operator as queries with results. Those of relational operators are written as queries; those of
/// others are made from examples in value notation.
std::vector<algebra3d::QueryExample> example_queries(const algebra3d::Registry& registry,
                                                     const algebra3d::Operator& op);
/// The error examples of an operator as queries with messages.
std::vector<algebra3d::QueryError> failing_queries(const algebra3d::Registry& registry, const algebra3d::Operator& op);

}  // namespace queries
