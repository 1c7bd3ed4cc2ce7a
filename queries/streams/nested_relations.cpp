#include "queries/streams/nested_relations.h"

#include "algebra3d/values/types/nested_relation.h"
#include "base/propagate.h"

namespace queries {

Result<RelationPtr> table_of(const TypeExpr& type, const Datum& value) {
  if (type.is_relation()) return value.relation();
  if (!type.is_nested_relation()) return RelationPtr();
  A3D_ASSIGN(const Value loaded, value.value().loaded());
  if (!loaded.is_defined()) return RelationPtr();
  const auto& relation = loaded.get<algebra3d::NestedRelation>();
  std::vector<TuplePtr> tuples;
  tuples.reserve(relation.size());
  for (std::size_t i = 0; i < relation.size(); ++i) {
    const auto values = relation.tuple(i);
    tuples.push_back(std::make_shared<const Tuple>(Tuple{{values.begin(), values.end()}}));
  }
  return RelationPtr(std::make_shared<MemoryRelation>(type.element(), TupleBuffer(std::move(tuples))));
}

std::vector<const algebra3d::Type*> listed_types(const algebra3d::Registry& registry) {
  std::vector<const algebra3d::Type*> types = registry.types();
  types.push_back(*algebra3d::NestedRelationType::of(TypeExpr::tuple({{"Name", "string"}})));
  return types;
}

}  // namespace queries
