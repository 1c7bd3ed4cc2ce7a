#pragma once

#include <cstdint>
#include <optional>

#include "queries/language/rewriting.h"

namespace queries {

/// The number of tuples that a stream operator is expected to return, for people; nothing if it is not known. It
/// follows from the numbers that relations keep and that indexes find; what part of a relation a filter leaves is that
/// of a sample of its tuples, outside of functions. Notes nothing.
std::optional<std::uint64_t> estimated_tuples(const TypedNode& node, ObjectSource& objects, Context& context,
                                              bool is_in_function);

/// A node of a plan that is explained, with its estimate.
TypedPtr with_estimate(const TypedPtr& node, const RewriteContext& rewriting);

}  // namespace queries
