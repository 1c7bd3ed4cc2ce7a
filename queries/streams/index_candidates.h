#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/datum.h"

namespace queries {

/// How a condition limits an attribute A, for an index on it.
enum class IndexUse : std::uint8_t {
  meets,      ///< the box of A meets that of the operand
  is_inside,  ///< the same, or A is empty
  contains,   ///< the same, or the operand is empty
  is_near,    ///< the box of A is at most a limit away from that of the operand
  equals,     ///< A is equal to the operand
  at_least,   ///< A is not less than the operand
  at_most,    ///< A is not greater than the operand
  between,    ///< A is from the operand to the limit, both included
};

/// True if an index of type `index` can serve a condition with operands of these types; `limit` is that of
/// IndexUse::is_near, else any.
bool can_serve(const TypeExpr& index, IndexUse use, const TypeExpr& operand, const TypeExpr& limit,
               const algebra3d::Registry& registry);

/// A condition with the values of its operands.
struct IndexQuestion {
  IndexUse use;
  Value operand;
  std::optional<Value> limit;  ///< of IndexUse::is_near and between
};

/// The ids of the tuples for which a condition may hold, ascending: all of those for which it does, and others.
struct IndexCandidates {
  std::vector<TupleId> ids;
  std::string attribute;                  ///< of the index
  std::optional<algebra3d::Box3> window;  ///< that the boxes of the tuples meet; none: of an ordered index
};
/// Whether the value of a tuple is one that the search in the index can have found; if not, the file is damaged.
bool fits(const IndexCandidates& candidates, const Value& value);

/// Asks an index object of type `index_type` on a relation of `tuple_count` tuples. Nothing if the index cannot decide.
/// Errors: those of loading the operand.
Result<std::optional<IndexCandidates>> index_candidates(const Datum& index, const TypeExpr& index_type,
                                                        const IndexQuestion& question, std::uint64_t tuple_count);

}  // namespace queries
