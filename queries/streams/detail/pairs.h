#pragma once

#include <optional>
#include <utility>

#include "queries/streams/detail/hash_table.h"
#include "queries/streams/mapping.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// The pairs of every left with every right tuple, the left one varying slowest. With keys, pairs whose keys differ or
/// are undefined are left out by a hash table of the right tuples, if it fits into the work memory. Interruptible.
class NestedLoop {
 public:
  NestedLoop(TupleStreamPtr left, TupleBuffer right, std::optional<JoinKeys> keys, const Context& context)
      : left_(std::move(left)), right_(std::move(right)), keys_(keys), context_(context) {}

  /// The next pair; null on both sides at the end.
  Result<std::pair<TuplePtr, TuplePtr>> next();

 private:
  Status fill_table();
  Result<TupleStreamPtr> partners_of(const Tuple& left) const;

  TupleStreamPtr left_;
  TupleBuffer right_;
  std::optional<JoinKeys> keys_;
  std::optional<HashTable> table_;  // none: each left tuple is paired with all right ones
  TupleStreamPtr partners_;
  TuplePtr current_;
  const Context& context_;
  std::uint32_t steps_ = 0;
};

/// The tuples of a NestedLoop, joined.
TupleStreamPtr joined_pairs(TupleStreamPtr left, TupleBuffer right, std::optional<JoinKeys> keys,
                            const Context& context);

/// Tuple types of the two operands of a join, and that of its result.
struct JoinTypes {
  TypeExpr left, right, joined;
};
Result<JoinTypes> join_types(const MappingCheck& check);

/// Indices of the two attributes that an equi-join compares, named at places 2 and 3. Their types are comparable.
Result<JoinKeys> join_keys(const MappingCheck& check, const JoinTypes& types);

/// A tuple of undefined values, in place of a missing partner.
TuplePtr undefined_tuple(const TypeExpr& type);

}  // namespace queries
