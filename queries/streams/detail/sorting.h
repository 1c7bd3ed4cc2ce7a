#pragma once

#include <compare>
#include <vector>

#include "queries/streams/mapping.h"

namespace queries {

class ColumnBuffer;

std::vector<SortKey> ascending(const std::vector<std::size_t>& attributes);
/// The indices of all attributes of a tuple type.
std::vector<std::size_t> all_attributes(const TypeExpr& tuple);

/// The values of these attributes, loaded.
Result<std::vector<Value>> loaded_keys(const Tuple& tuple, const std::vector<std::size_t>& attributes);
/// Compares lexicographically; undefined comes first. Both lists have the same length.
std::strong_ordering compare_keys(const std::vector<Value>& a, const std::vector<Value>& b);

/// The places of tuples in an order by loaded values; equal ones keep theirs. Interruptible.
Result<std::vector<std::uint32_t>> sorted_places(const ColumnBuffer& tuples, const std::vector<SortKey>& order,
                                                 const Context& context);

/// Sorts the tuples; the sort is stable. Reads the stream to its end. Beyond the work memory, runs are sorted in a
/// temporary file and merged while the result is read. Errors: those of the stream and of the file, interrupted. Cost:
/// n log n. Source: [knuth1998], section 5.4.
Result<TupleStreamPtr> sorted(TupleStream& tuples, const std::vector<SortKey>& order, const Context& context);

/// The first `count` tuples of `sorted`, and perhaps some that follow. Reads the stream to its end. Errors: as of
/// `sorted`. Cost: n log count. Memory: twice that of the result, or 1,024 tuples; if it is exhausted, runs go to a
/// file.
Result<TupleStreamPtr> first_sorted(TupleStream& tuples, const std::vector<SortKey>& order, std::size_t count,
                                    const Context& context);

}  // namespace queries
