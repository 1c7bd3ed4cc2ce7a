#pragma once

#include <optional>
#include <utility>

#include "queries/streams/detail/hashed_pairs.h"
#include "queries/streams/mapping.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// The pairs of every left with every right tuple, the left one varying slowest. Interruptible.
class NestedLoop {
 public:
  NestedLoop(TupleStreamPtr left, TupleBuffer right, const Context& context)
      : left_(std::move(left)), right_(std::move(right)), context_(context) {}

  /// The next pair; null on both sides at the end.
  Result<std::pair<TuplePtr, TuplePtr>> next();

 private:
  TupleStreamPtr left_;
  TupleBuffer right_;
  TupleStreamPtr partners_;
  TuplePtr current_;
  const Context& context_;
  std::uint32_t steps_ = 0;
};

/// The tuples of a NestedLoop, joined. `predicate`: a function of both tuples that selects pairs; null: all.
TupleStreamPtr joined_pairs(TupleStreamPtr left, TupleBuffer right, std::shared_ptr<const Function> predicate,
                            const Context& context);

/// These pairs in the same order without pairs whose keys differ or are undefined, found by a hash table of the right
/// tuples. If they exceed the work memory, all pairs come. Reads the right stream to its end.
Result<TupleStreamPtr> equal_pairs(TupleStreamPtr left, TupleStream& right, JoinOutput output, const Context& context);

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
