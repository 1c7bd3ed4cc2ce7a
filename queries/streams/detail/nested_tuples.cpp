#include "queries/streams/detail/nested_tuples.h"

#include <utility>

#include "base/propagate.h"
#include "base/work_memory.h"
#include "queries/streams/mapping.h"

namespace queries {

using algebra3d::NestedRelation;
using algebra3d::NestedRelationType;

Result<TupleStreamPtr> tuples_of_nested(const Value& relation, const Context& context) {
  A3D_ASSIGN(const Value loaded, relation.loaded());
  return make_stream([loaded, &context, position = std::size_t{0}]() mutable -> Result<TuplePtr> {
    if (!loaded.is_defined()) return TuplePtr();
    const auto& tuples = loaded.get<NestedRelation>();
    if (position == tuples.size()) return TuplePtr();
    if (position % 256 == 255) A3D_TRY(context.check_cancelled());
    const auto values = tuples.tuple(position++);
    return TuplePtr(std::make_shared<const Tuple>(Tuple{{values.begin(), values.end()}}));
  });
}

// The relation stands in memory as long as the statement needs it; while it is made it is bounded.
Result<Value> collected_relation(TupleStream& tuples, const std::vector<std::size_t>& attributes,
                                 const NestedRelationType& type, const std::string& op, const Context& context) {
  algebra3d::MemoryAccount account(context.memory);
  std::vector<Value> values;
  A3D_TRY(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
    std::size_t bytes = attributes.size() * sizeof(Value);
    for (const std::size_t attribute : attributes) {
      A3D_ASSIGN(Value loaded, tuple->attributes[attribute].loaded());
      bytes += heap_bytes(loaded);
      values.push_back(std::move(loaded));
    }
    if (account.take(bytes)) return {};
    return Error{ErrorCode::limit_exceeded,
                 "{}: a nested relation of {} tuples and more does not fit into its part of the {} MB of work memory; "
                 "`set \"memory\"` allows more",
                 op, values.size() / attributes.size(), context.memory->limit() >> 20U};
  }));
  return type.value_of(std::move(values));
}

}  // namespace queries
