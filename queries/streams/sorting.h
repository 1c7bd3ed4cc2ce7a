#pragma once

#include <compare>
#include <vector>

#include "queries/streams/mapping.h"

namespace queries {

struct SortKey {
  std::size_t attribute = 0;
  bool is_descending = false;
};

std::vector<SortKey> ascending(const std::vector<std::size_t>& attributes);
/// Every attribute of a tuple type, in order.
std::vector<std::size_t> all_attributes(const TypeExpr& tuple);

/// The values of these attributes, loaded.
Result<std::vector<Value>> loaded_keys(const Tuple& tuple, const std::vector<std::size_t>& attributes);
/// Lexicographic order; undefined comes first. Both of one length.
std::strong_ordering compare_keys(const std::vector<Value>& a, const std::vector<Value>& b);

/// The tuples in that order; equal ones keep theirs, so that the same stream always comes out in the same order.
/// Reads the stream to its end. What does not fit into the work memory is sorted in runs in a temporary file, which are
/// merged while the result is read. Errors: those of the stream and of the file, interrupted. Cost: n log n.
/// Source: [knuth1998], section 5.4.
Result<TupleStreamPtr> sorted(TupleStream& tuples, const std::vector<SortKey>& order, const Context& context);

}  // namespace queries
