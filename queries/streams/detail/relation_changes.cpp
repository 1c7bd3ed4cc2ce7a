#include "queries/streams/detail/relation_changes.h"

#include <algorithm>
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

ChangedTuples::ChangedTuples(RelationPtr relation, std::size_t now_count, std::vector<bool> read)
    : relation_(std::move(relation)),
      now_count_(now_count),
      read_(std::move(read)),
      id_column_(algebra3d::TypeOf<algebra3d::TupleNumber>::type()) {
  for (const auto& attribute : relation_->tuple_type().attributes())
    unread_.emplace_back(undefined_of(attribute.type).type());
}

std::vector<bool> ChangedTuples::read_of(std::size_t first, std::size_t count) const {
  const auto begin = read_.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

Result<std::shared_ptr<ChangedTuples>> ChangedTuples::make(RelationPtr relation, std::size_t now_count,
                                                           std::vector<bool> read) {
  std::shared_ptr<ChangedTuples> made(new ChangedTuples(std::move(relation), now_count, std::move(read)));
  const std::vector<bool> before = made->read_of(now_count, made->unread_.size());
  if (std::ranges::find(before, true) == before.end()) return made;
  A3D_ASSIGN(made->before_, made->relation_->by_id(before));
  A3D_TRY(made->before_->read({}));
  return made;
}

Status ChangedTuples::begin(std::vector<TupleId> ids) {
  ids_ = std::move(ids);
  const std::vector<bool> now = read_of(0, now_count_);
  if (std::ranges::find(now, true) == now.end()) return {};
  A3D_ASSIGN(now_, relation_->by_id(now));
  A3D_TRY(now_->read({}));
  return {};
}

/// Adds some attributes of these tuples to the batch.
Status ChangedTuples::add(TuplesById* tuples, std::span<const TupleId> ids, std::size_t count) {
  if (tuples == nullptr) {
    for (std::size_t attribute = 0; attribute < count; ++attribute) batch_.columns.push_back(&unread_[attribute]);
    return {};
  }
  A3D_ASSIGN(const Batch* const found, tuples->read(ids));
  if (found->rows.count != ids.size())
    return Error{ErrorCode::internal, "{}: a tuple that was changed cannot be read", relation_->name()};
  batch_.columns.insert(batch_.columns.end(), found->columns.begin(), found->columns.end());
  return {};
}

Result<const Batch*> ChangedTuples::next_batch(std::size_t most) {
  if (position_ == ids_.size()) return nullptr;
  const auto ids = std::span(ids_).subspan(position_, std::min(most, ids_.size() - position_));
  position_ += ids.size();
  batch_.columns.clear();
  A3D_TRY(add(now_.get(), ids, now_count_));
  A3D_TRY(add(before_.get(), ids, unread_.size()));
  id_column_.restart(read_.back() ? ids.size() : 0);
  for (std::size_t row = 0; row < id_column_.size(); ++row) id_column_.set(row, id_value(ids[row]));
  batch_.columns.push_back(&id_column_);
  batch_.size = ids.size();
  batch_.rows = {nullptr, ids.size()};
  return &batch_;
}

Result<TuplePtr> ChangedTuples::next() {
  if (row_ == batch_.size) {
    A3D_ASSIGN(const Batch* const batch, next_batch(kBatchTuples));
    row_ = 0;
    if (batch == nullptr) {
      batch_.size = 0;
      return TuplePtr();
    }
  }
  return tuple_of(batch_, row_++);
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
