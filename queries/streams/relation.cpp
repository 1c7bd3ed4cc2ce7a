#include "queries/streams/relation.h"

#include <utility>

#include "queries/streams/mapping.h"

namespace queries {
namespace {

Error not_stored() {
  return {ErrorCode::wrong_usage, "only a relation that is stored as an object can be changed"};
}

}  // namespace

Result<TupleStreamPtr> Relation::select(std::vector<TupleId> ids) {
  return make_stream([this, ids = std::move(ids), position = std::size_t{0}]() mutable -> Result<TuplePtr> {
    while (position < ids.size()) {
      ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr tuple, fetch(ids[position++]));
      if (tuple != nullptr) return tuple;
    }
    return TuplePtr();
  });
}

Result<TupleId> Relation::insert(const Tuple&) {
  return not_stored();
}
Status Relation::erase(TupleId) {
  return not_stored();
}
Status Relation::update(TupleId, const Tuple&) {
  return not_stored();
}

}  // namespace queries
