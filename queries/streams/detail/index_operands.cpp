#include "queries/streams/detail/index_operands.h"

#include <algorithm>

#include "base/propagate.h"

namespace queries {

Result<IndexSource> index_source(const MappingCheck& check) {
  IndexSource source;
  A3D_ASSIGN(source.given, check.stream_or_relation(0));
  source.indexed = source.given;
  const auto& attributes = source.given.attributes();
  const bool has_id = std::ranges::any_of(attributes, [](const auto& attribute) { return attribute.type.is("tid"); });
  if (check[0].type.is_relation() || !has_id) return source;
  A3D_ASSIGN(source.id_attribute, check.id_attribute(source.given));
  std::vector<std::size_t> kept;
  for (std::size_t index = 0; index < attributes.size(); ++index)
    if (index != *source.id_attribute) kept.push_back(index);
  source.indexed = projected(source.given, kept);
  return source;
}

std::string stored_name(const Datum& source) {
  const auto* relation = std::get_if<RelationPtr>(&source.content);
  return relation == nullptr ? std::string() : (*relation)->name();
}

TupleStreamPtr found_tuples(const RelationPtr& relation, const std::shared_ptr<const IndexObject>& index,
                            TupleList list, const Context& context) {
  list.found_wrong = [relation, index](TupleId id, bool has_tuple) -> Status {
    if (!index->is_definition() || !relation->keeps(id)) return {};
    return index_disagrees(relation->name(), index->attribute(), id, has_tuple);
  };
  return listed_tuples(relation, std::move(list), context);
}

}  // namespace queries
