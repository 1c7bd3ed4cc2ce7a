#pragma once

#include <compare>
#include <vector>

#include "queries/streams/mapping.h"

namespace queries {

std::vector<SortKey> ascending(const std::vector<std::size_t>& attributes);
/// The indices of all attributes of a tuple type.
std::vector<std::size_t> all_attributes(const TypeExpr& tuple);

/// The values of these attributes, loaded.
Result<std::vector<Value>> loaded_keys(const Tuple& tuple, const std::vector<std::size_t>& attributes);
/// Compares lexicographically; undefined comes first. Both lists have the same length.
std::strong_ordering compare_keys(const std::vector<Value>& a, const std::vector<Value>& b);

/// Sorts the tuples; the sort is stable. Reads the stream to its end. Beyond the work memory, runs are sorted in a
/// temporary file and merged while the result is read. Errors: those of the stream and of the file, interrupted. Cost:
/// n log n. Source: [knuth1998], section 5.4.
Result<TupleStreamPtr> sorted(TupleStream& tuples, const std::vector<SortKey>& order, const Context& context);

/// The first `count` tuples of `sorted`, in a heap; if they exceed the work memory, all that are left are sorted. Reads
/// the stream to its end. Errors: as of `sorted`. Cost: n log count. Memory: the tuples of the result.
Result<TupleStreamPtr> first_sorted(TupleStream& tuples, const std::vector<SortKey>& order, std::size_t count,
                                    const Context& context);

}  // namespace queries
