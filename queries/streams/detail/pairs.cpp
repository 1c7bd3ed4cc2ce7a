#include "queries/streams/detail/pairs.h"

#include <array>

#include "base/propagate.h"

namespace queries {

Result<std::pair<TuplePtr, TuplePtr>> NestedLoop::next() {
  while (true) {
    if (++steps_ % 4096 == 0) A3D_TRY(context_.check_cancelled());
    if (partners_ != nullptr) {
      A3D_ASSIGN(TuplePtr partner, partners_->next());
      if (partner != nullptr) return std::pair(current_, std::move(partner));
    }
    A3D_ASSIGN(current_, left_->next());
    if (current_ == nullptr || right_.is_empty()) return std::pair<TuplePtr, TuplePtr>();
    partners_ = right_.scan();
  }
}

TupleStreamPtr joined_pairs(TupleStreamPtr left, TupleBuffer right, std::shared_ptr<const Function> predicate,
                            const Context& context) {
  return make_stream([loop = NestedLoop(std::move(left), std::move(right), context),
                      predicate = std::move(predicate)]() mutable -> Result<TuplePtr> {
    while (true) {
      A3D_ASSIGN(const auto pair, loop.next());
      if (pair.first == nullptr) return TuplePtr();
      if (predicate != nullptr) {
        const std::array<Datum, 2> both = {Datum{pair.first}, Datum{pair.second}};
        A3D_ASSIGN(const Value holds, predicate->call_for_value(both));
        if (!is_true(holds)) continue;
      }
      return concatenated(*pair.first, *pair.second);
    }
  });
}

Result<TupleStreamPtr> equal_pairs(TupleStreamPtr left, TupleStream& right, JoinOutput output, const Context& context) {
  JoinTable table(output.keys.right, context);
  TupleBuffer beyond_memory(context);
  bool is_empty = true, has_room = true;
  const auto add = [&](const Batch& batch) -> Status {
    is_empty = false;
    if (has_room) {
      A3D_ASSIGN(has_room, table.add(batch));
      if (has_room) return {};
      for (std::uint32_t place = 0; place < table.size(); ++place) A3D_TRY(beyond_memory.add(table.tuple(place)));
      table.clear();
      return {};
    }
    for (std::size_t i = 0; i < batch.rows.count; ++i) A3D_TRY(beyond_memory.add(tuple_of(batch, batch.rows[i])));
    return {};
  };
  A3D_TRY(for_each_batch(right, context, add));
  if (is_empty || !has_room)
    return joined_pairs(std::move(left), std::move(beyond_memory), std::move(output.predicate), context);
  table.finish();
  return hashed_pairs(std::move(left), std::move(table), std::move(output), context);
}

Result<JoinTypes> join_types(const MappingCheck& check) {
  JoinTypes types;
  A3D_ASSIGN(types.left, check.stream(0));
  A3D_ASSIGN(types.right, check.stream(1));
  A3D_ASSIGN(types.joined, check.concatenated(types.left, types.right));
  return types;
}

Result<JoinKeys> join_keys(const MappingCheck& check, const JoinTypes& types) {
  JoinKeys keys;
  A3D_ASSIGN(keys.left, check.attribute(2, types.left));
  A3D_ASSIGN(keys.right, check.attribute(3, types.right));
  const TypeExpr& left = types.left.attributes()[keys.left].type;
  const TypeExpr& right = types.right.attributes()[keys.right].type;
  if (are_comparable(left, right)) return keys;
  return check.error("expected attributes of one type, got " + left.text() + " and " + right.text());
}

TuplePtr undefined_tuple(const TypeExpr& type) {
  Tuple tuple;
  for (const auto& attribute : type.attributes()) tuple.attributes.push_back(undefined_of(attribute.type));
  return std::make_shared<const Tuple>(std::move(tuple));
}

}  // namespace queries
