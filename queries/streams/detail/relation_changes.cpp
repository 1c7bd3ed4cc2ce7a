#include "queries/streams/detail/relation_changes.h"

#include <functional>

#include "base/propagate.h"

namespace queries {

TuplePtr tuple_with_id(const Tuple& tuple, TupleId id) {
  Tuple result{tuple.attributes};
  result.attributes.push_back(id_value(id));
  return std::make_shared<const Tuple>(std::move(result));
}

TupleStreamPtr tuples_with_ids(const TupleBuffer& tuples) {
  return make_stream([scan = tuples.scan()]() -> Result<TuplePtr> {
    A3D_ASSIGN(const TuplePtr next, scan->next());
    return next == nullptr ? next : tuple_with_id(*next, next->id);
  });
}

Result<TuplePtr> loaded_tuple(const Tuple& tuple) {
  Tuple result;
  result.id = tuple.id;
  for (const Value& value : tuple.attributes) {
    A3D_ASSIGN(Value loaded, value.loaded());
    result.attributes.push_back(std::move(loaded));
  }
  return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
}

std::size_t quick_hash(const Tuple& tuple) {
  std::size_t result = 0;
  for (const Value& value : tuple.attributes) {
    std::size_t own = 0;
    if (value.is_defined() && value.type().has_header()) {
      const auto header = value.header();
      own = std::hash<double>()(header.box.min.x) ^ (std::hash<double>()(header.box.max.y) << 1) ^ header.size;
    } else {
      own = hash(value);
    }
    result = result * 1'000'003 + own;
  }
  return result;
}

Result<bool> are_equal(const Tuple& a, const Tuple& b) {
  for (std::size_t i = 0; i < a.attributes.size(); ++i) {
    if (a.attributes[i].is_defined() != b.attributes[i].is_defined()) return false;
    A3D_ASSIGN(const Value left, a.attributes[i].loaded());
    A3D_ASSIGN(const Value right, b.attributes[i].loaded());
    if (compare(left, right) != 0) return false;
  }
  return true;
}

namespace {

/// A tuple of the relation that can be read when it has been changed; `stored` is the same, fetched now.
Result<TuplePtr> lasting_tuple(const Relation& relation, const TuplePtr& tuple, const TuplePtr& stored) {
  if (relation.keeps(tuple->id)) return stored;
  return loaded_tuple(*tuple);
}

}  // namespace

Result<TupleBuffer> own_tuples(TupleStream& tuples, Relation& relation, std::string_view op, const Context& context) {
  TupleBuffer result(context);
  std::unordered_set<TupleId> seen;
  A3D_TRY(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
    if (tuple->id == 0)
      return Error{ErrorCode::wrong_usage,
                   "{}: a tuple does not come straight from a stored relation; only filter, head, sortby and the like "
                   "may come between",
                   op};
    if (!seen.insert(tuple->id).second) return {};
    A3D_ASSIGN(const TuplePtr stored, relation.fetch(tuple->id));
    if (stored == nullptr || quick_hash(*stored) != quick_hash(*tuple))
      return Error{ErrorCode::wrong_usage, "{}: a tuple of the stream is not one of the relation '{}'", op,
                   relation.name()};
    A3D_ASSIGN(TuplePtr lasting, lasting_tuple(relation, tuple, stored));
    return result.add(std::move(lasting));
  }));
  return result;
}

Result<TupleBuffer> tuple_by_id(const Value& id, Relation& relation) {
  std::vector<TuplePtr> found;
  if (!id.is_defined()) return TupleBuffer(found);
  A3D_ASSIGN(const TuplePtr stored, relation.fetch(id_of(id)));
  if (stored == nullptr) return TupleBuffer(found);
  A3D_ASSIGN(TuplePtr lasting, lasting_tuple(relation, stored, stored));
  found.push_back(std::move(lasting));
  return TupleBuffer(std::move(found));
}

}  // namespace queries
