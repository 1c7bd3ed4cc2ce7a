#include "queries/language/late_reading.h"

#include <utility>

#include "base/propagate.h"
#include "queries/streams/listed_tuples.h"

namespace queries {

LateReadingNode::LateReadingNode(TypedPtr tuples, TypedPtr relation, std::vector<bool> read)
    : TypedNode(tuples->type(), tuples->place()),
      tuples_(std::move(tuples)),
      relation_(std::move(relation)),
      read_(std::move(read)) {}

// The tuples are read as they are when the stream begins.
Result<Datum> LateReadingNode::evaluate(const Frame* frame, Context& context) const {
  A3D_ASSIGN(const Datum relation, relation_->evaluate(frame, context));
  A3D_ASSIGN(std::unique_ptr<TuplesById> by_id, relation.relation()->by_id(read_));
  A3D_TRY(by_id->read({}));
  A3D_ASSIGN(const Datum tuples, tuples_->evaluate(frame, context));
  return Datum{tuples_by_ids_of(tuples.tuples(), relation.relation(), std::move(by_id))};
}

TypedPtr LateReadingNode::reading(std::vector<bool> read) const {
  return std::make_shared<LateReadingNode>(tuples_, relation_, std::move(read));
}

}  // namespace queries
