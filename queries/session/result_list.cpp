// Results as nested lists.
#include "base/propagate.h"
#include "queries/session/session.h"
#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

Result<NestedList> tuple_list(const Tuple& tuple) {
  NestedList::List values;
  values.reserve(tuple.attributes.size());
  for (const Value& attribute : tuple.attributes) {
    A3D_ASSIGN(const Value loaded, attribute.loaded());
    values.push_back(loaded.to_nested());
  }
  return NestedList(std::move(values));
}

template <typename Index>
Result<NestedList> index_list(const Index& index) {
  A3D_ASSIGN(const std::size_t size, index.size());
  return NestedList::list(NestedList::symbol(index.is_definition() ? index.relation() : "frozen"),
                          NestedList::symbol(index.attribute()), NestedList(static_cast<std::int64_t>(size)));
}

Result<NestedList> relation_list(Relation& relation, Context& context) {
  A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
  NestedList::List rows;
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return NestedList(std::move(rows));
    A3D_ASSIGN(NestedList row, tuple_list(*tuple));
    rows.push_back(std::move(row));
  }
}

}  // namespace

Result<NestedList> value_list(const TypeExpr& type, const Datum& value, Context& context) {
  if (type.is_relation()) return relation_list(*value.relation(), context);
  if (type.is_function()) return value.function().to_nested();
  if (type.is("rtree3")) return index_list(*value.index());
  if (type.is("btree")) return index_list(*value.ordered_index());
  if (!std::holds_alternative<Value>(value.content))
    return Error{ErrorCode::not_evaluable, "a result of type {} cannot be shown", type.text()};
  A3D_ASSIGN(const Value loaded, value.value().loaded());
  return loaded.to_nested();
}

Result<NestedList> result_list(const TypeExpr& type, const Datum& value, Context& context) {
  A3D_ASSIGN(NestedList list, value_list(type, value, context));
  return NestedList::list(type.to_nested(), std::move(list));
}

}  // namespace queries
