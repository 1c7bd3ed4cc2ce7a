#include "queries/streams/relation.h"

namespace queries {
namespace {

Error not_stored() {
  return {ErrorCode::wrong_usage, "only a relation that is stored as an object can be changed"};
}

class MemoryScan final : public TupleStream {
 public:
  explicit MemoryScan(std::shared_ptr<const std::vector<TuplePtr>> tuples) : tuples_(std::move(tuples)) {}
  Result<TuplePtr> next() override {
    if (position_ == tuples_->size()) return TuplePtr();
    return (*tuples_)[position_++];
  }

 private:
  std::shared_ptr<const std::vector<TuplePtr>> tuples_;
  std::size_t position_ = 0;
};

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

MemoryRelation::MemoryRelation(TypeExpr tuple_type, std::vector<TuplePtr> tuples)
    : tuple_type_(std::move(tuple_type)), tuples_(std::make_shared<const std::vector<TuplePtr>>(std::move(tuples))) {}

Result<TupleStreamPtr> MemoryRelation::scan() {
  return TupleStreamPtr(std::make_shared<MemoryScan>(tuples_));
}

Result<TuplePtr> MemoryRelation::fetch(TupleId id) {
  if (position_of_.empty())
    for (std::size_t position = 0; position < tuples_->size(); ++position)
      position_of_.try_emplace((*tuples_)[position]->id, position);
  const auto found = position_of_.find(id);
  return found == position_of_.end() ? TuplePtr() : (*tuples_)[found->second];
}

Result<std::vector<TuplePtr>> materialise(TupleStream& stream, const algebra3d::Context& context) {
  std::vector<TuplePtr> tuples;
  while (true) {
    ASSIGN_OR_RETURN(TuplePtr tuple, stream.next());
    if (tuple == nullptr) return tuples;
    tuples.push_back(std::move(tuple));
    if (tuples.size() % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
  }
}

}  // namespace queries
