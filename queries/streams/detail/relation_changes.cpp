#include "queries/streams/detail/relation_changes.h"

#include <functional>

#include "algebra3d/values/types/tuple_number.h"
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

Error not_from_a_relation(std::string_view op) {
  return {ErrorCode::wrong_usage,
          "{}: a tuple does not come straight from a stored relation; only filter, head, sortby and the like may come "
          "between",
          op};
}

Error not_of(std::string_view op, const Relation& relation) {
  return {ErrorCode::wrong_usage, "{}: a tuple of the stream is not one of the relation '{}'", op, relation.name()};
}

}  // namespace

Result<TupleBuffer> own_tuples(const Operand& operand, const Context& context) {
  Relation& relation = *operand.relation;
  TupleBuffer result(context);
  std::unordered_set<TupleId> seen;
  A3D_TRY(for_each_tuple(*operand.tuples, context, [&](const TuplePtr& tuple) -> Status {
    if (tuple->id == 0) return not_from_a_relation(operand.op);
    if (!seen.insert(tuple->id).second) return {};
    A3D_ASSIGN(const TuplePtr stored, relation.fetch(tuple->id));
    if (stored == nullptr || (!operand.are_own && quick_hash(*stored) != quick_hash(*tuple)))
      return not_of(operand.op, relation);
    A3D_ASSIGN(TuplePtr lasting, lasting_tuple(relation, operand.are_own ? stored : tuple, stored));
    return result.add(std::move(lasting));
  }));
  return result;
}

Result<bool> OwnTuples::is_new(TupleId id) {
  if (id == 0) return not_from_a_relation(operand_.op);
  if (are_ascending_ && (ids_.empty() || id > ids_.back())) return true;
  if (are_ascending_) seen_.insert(ids_.begin(), ids_.end());
  are_ascending_ = false;
  return seen_.insert(id).second;
}

Result<TuplePtr> OwnTuples::next() {
  while (true) {
    A3D_ASSIGN(const TuplePtr tuple, operand_.tuples->next());
    if (tuple == nullptr) return tuple;
    A3D_ASSIGN(const bool is_wanted, is_new(tuple->id));
    if (!is_wanted) continue;
    ids_.push_back(tuple->id);
    if (operand_.are_own) return tuple;
    A3D_ASSIGN(const TuplePtr stored, operand_.relation->fetch(tuple->id));
    if (stored == nullptr || quick_hash(*stored) != quick_hash(*tuple)) return not_of(operand_.op, *operand_.relation);
    return tuple;
  }
}

Result<const Batch*> OwnTuples::next_batch(std::size_t most) {
  while (true) {
    A3D_ASSIGN(const Batch* const batch, operand_.tuples->next_batch(most));
    if (batch == nullptr) return nullptr;
    if (batch->ids == nullptr) return not_from_a_relation(operand_.op);
    rows_.clear();
    for (std::size_t i = 0; i < batch->rows.count; ++i) {
      const std::size_t row = batch->rows[i];
      A3D_ASSIGN(const bool is_wanted, is_new(batch->ids[row]));
      if (!is_wanted) continue;
      ids_.push_back(batch->ids[row]);
      rows_.push_back(static_cast<std::uint32_t>(row));
    }
    if (rows_.empty()) continue;
    batch_ = *batch;
    batch_.rows = {rows_.data(), rows_.size()};
    if (!operand_.are_own) A3D_TRY(compare_with_stored(batch_));
    return &batch_;
  }
}

Status OwnTuples::compare_with_stored(const Batch& batch) {
  if (stored_ == nullptr) {
    A3D_ASSIGN(stored_, operand_.relation->by_id(std::vector<bool>(batch.columns.size(), true)));
  }
  A3D_ASSIGN(const Batch* const stored, stored_->read(std::span(ids_).last(batch.rows.count)));
  if (stored->rows.count != batch.rows.count) return not_of(operand_.op, *operand_.relation);
  for (std::size_t attribute = 0; attribute < batch.columns.size(); ++attribute)
    for (std::size_t i = 0; i < batch.rows.count; ++i) {
      const Value given = batch.columns[attribute]->value(batch.rows[i]);
      const Value own = stored->columns[attribute]->value(stored->rows[i]);
      if (given.is_defined() != own.is_defined()) return not_of(operand_.op, *operand_.relation);
      A3D_ASSIGN(const Value loaded, given.loaded());
      A3D_ASSIGN(const Value loaded_own, own.loaded());
      if (compare(loaded, loaded_own) != 0) return not_of(operand_.op, *operand_.relation);
    }
  return {};
}

namespace {

class AttributesWithIds final : public TupleStream {
 public:
  AttributesWithIds(TupleStreamPtr tuples, std::vector<std::size_t> attributes, std::vector<TupleId> ids)
      : tuples_(std::move(tuples)),
        attributes_(std::move(attributes)),
        ids_(std::move(ids)),
        id_column_(algebra3d::TypeOf<algebra3d::TupleNumber>::type()) {}

  Result<TuplePtr> next() override {
    A3D_ASSIGN(const Batch* const batch, next_batch(1));
    return batch == nullptr ? TuplePtr() : tuple_of(*batch, batch->rows[0]);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_ASSIGN(const Batch* const batch, tuples_->next_batch(most));
    if (batch == nullptr) return nullptr;
    id_column_.restart(batch->size);
    batch->rows.for_each([&](std::size_t row) { id_column_.set(row, id_value(ids_[position_++])); });
    batch_.size = batch->size;
    batch_.rows = batch->rows;
    batch_.columns.clear();
    for (const std::size_t attribute : attributes_) batch_.columns.push_back(batch->columns[attribute]);
    batch_.columns.push_back(&id_column_);
    return &batch_;
  }

 private:
  TupleStreamPtr tuples_;
  std::vector<std::size_t> attributes_;
  std::vector<TupleId> ids_;
  std::size_t position_ = 0;
  ValueColumn id_column_;
  Batch batch_;
};

}  // namespace

TupleStreamPtr attributes_with_ids(TupleStreamPtr tuples, std::vector<std::size_t> attributes,
                                   std::vector<TupleId> ids) {
  return std::make_shared<AttributesWithIds>(std::move(tuples), std::move(attributes), std::move(ids));
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
