#include "queries/streams/relation.h"

namespace queries {
namespace {

Error not_stored() {
  return {ErrorCode::wrong_usage, "only a relation that is stored as an object can be changed"};
}

}  // namespace

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
