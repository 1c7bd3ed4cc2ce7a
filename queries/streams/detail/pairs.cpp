#include "queries/streams/detail/pairs.h"

namespace queries {

Result<std::pair<TuplePtr, TuplePtr>> NestedLoop::next() {
  while (true) {
    if (++steps_ % 4096 == 0) ALGEBRA3D_RETURN_IF_ERROR(context_.check_cancelled());
    if (partners_ != nullptr) {
      ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr partner, partners_->next());
      if (partner != nullptr) return std::pair(current_, std::move(partner));
    }
    ALGEBRA3D_ASSIGN_OR_RETURN(current_, left_->next());
    if (current_ == nullptr || right_.is_empty()) return std::pair<TuplePtr, TuplePtr>();
    partners_ = right_.scan();
  }
}

TupleStreamPtr all_pairs(TupleStreamPtr left, TupleBuffer right, const Context& context) {
  return make_stream([loop = NestedLoop(std::move(left), std::move(right), context)]() mutable -> Result<TuplePtr> {
    ALGEBRA3D_ASSIGN_OR_RETURN(const auto pair, loop.next());
    return pair.first == nullptr ? TuplePtr() : concatenated(*pair.first, *pair.second);
  });
}

Result<JoinTypes> join_types(const MappingCheck& check) {
  JoinTypes types;
  ALGEBRA3D_ASSIGN_OR_RETURN(types.left, check.stream(0));
  ALGEBRA3D_ASSIGN_OR_RETURN(types.right, check.stream(1));
  ALGEBRA3D_ASSIGN_OR_RETURN(types.joined, check.concatenated(types.left, types.right));
  return types;
}

Result<JoinKeys> join_keys(const MappingCheck& check, const JoinTypes& types) {
  JoinKeys keys;
  ALGEBRA3D_ASSIGN_OR_RETURN(keys.left, check.attribute(2, types.left));
  ALGEBRA3D_ASSIGN_OR_RETURN(keys.right, check.attribute(3, types.right));
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
