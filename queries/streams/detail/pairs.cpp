#include "queries/streams/detail/pairs.h"

#include "base/propagate.h"

namespace queries {

Status NestedLoop::fill_table() {
  const JoinKeys keys = *std::exchange(keys_, std::nullopt);
  table_.emplace(keys.right, keys.left, context_);
  const TupleStreamPtr tuples = right_.scan();
  for (std::uint32_t step = 1;; ++step) {
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return {};
    if (step % 1024 == 0) A3D_TRY(context_.check_cancelled());
    A3D_ASSIGN(const bool has_room, table_->add(tuple));
    if (has_room) continue;
    table_.reset();
    return {};
  }
}

Result<TupleStreamPtr> NestedLoop::partners_of(const Tuple& left) const {
  if (!table_) return right_.scan();
  std::vector<TuplePtr> found;
  A3D_TRY(table_->find(left, found));
  return make_stream([found = std::move(found), index = std::size_t{0}]() mutable -> Result<TuplePtr> {
    return index == found.size() ? TuplePtr() : found[index++];
  });
}

Result<std::pair<TuplePtr, TuplePtr>> NestedLoop::next() {
  while (true) {
    if (++steps_ % 4096 == 0) A3D_TRY(context_.check_cancelled());
    if (partners_ != nullptr) {
      A3D_ASSIGN(TuplePtr partner, partners_->next());
      if (partner != nullptr) return std::pair(current_, std::move(partner));
    }
    A3D_ASSIGN(current_, left_->next());
    if (current_ == nullptr || right_.is_empty()) return std::pair<TuplePtr, TuplePtr>();
    if (keys_) A3D_TRY(fill_table());
    A3D_ASSIGN(partners_, partners_of(*current_));
  }
}

TupleStreamPtr joined_pairs(TupleStreamPtr left, TupleBuffer right, std::optional<JoinKeys> keys,
                            const Context& context) {
  return make_stream(
      [loop = NestedLoop(std::move(left), std::move(right), keys, context)]() mutable -> Result<TuplePtr> {
        A3D_ASSIGN(const auto pair, loop.next());
        return pair.first == nullptr ? TuplePtr() : concatenated(*pair.first, *pair.second);
      });
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
