#include "queries/streams/relation.h"

#include <utility>

#include "base/propagate.h"
#include "queries/streams/index_object.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Error not_stored() {
  return {ErrorCode::wrong_usage, "only a relation that is stored as an object can be changed"};
}

}  // namespace

Error index_disagrees(std::string_view relation, std::string_view attribute, std::int64_t tuple, bool has_row) {
  return {ErrorCode::database_corrupt,
          "{}: the index of '{}' has the tuple {}, {}; run check database to see what is damaged",
          relation,
          attribute,
          tuple,
          has_row ? "whose row has another value" : "whose row is not in the file"};
}

Result<TupleStreamPtr> Relation::select(std::vector<TupleId> ids) {
  return make_stream([this, ids = std::move(ids), position = std::size_t{0}]() mutable -> Result<TuplePtr> {
    if (position == ids.size()) return TuplePtr();
    const TupleId id = ids[position++];
    A3D_ASSIGN(TuplePtr tuple, fetch(id));
    if (tuple == nullptr) return Error{ErrorCode::internal, "{}: there is no tuple {}", name(), id};
    return tuple;
  });
}

Result<TupleId> Relation::insert(const Tuple&) {
  return not_stored();
}

Result<TupleStreamPtr> Relation::insert_all(TupleStream& tuples, const algebra3d::Context& context) {
  A3D_ASSIGN(const TupleBuffer input, buffered(tuples, context));
  std::vector<TupleId> ids;
  A3D_TRY(for_each_tuple(*input.scan(), context, [&](const TuplePtr& tuple) -> Status {
    A3D_ASSIGN(const TupleId id, insert(*tuple));
    ids.push_back(id);
    return {};
  }));
  return make_stream(
      [scan = input.scan(), ids = std::move(ids), position = std::size_t{0}]() mutable -> Result<TuplePtr> {
        A3D_ASSIGN(const TuplePtr next, scan->next());
        if (next == nullptr) return next;
        return TuplePtr(std::make_shared<const Tuple>(Tuple{next->attributes, ids[position++]}));
      });
}

Status Relation::erase(TupleId) {
  return not_stored();
}
Status Relation::update(TupleId, const Tuple&) {
  return not_stored();
}

}  // namespace queries
