#include "queries/streams/listed_tuples.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "base/propagate.h"

namespace queries {
namespace {

class ListedTuples final : public TupleStream {
 public:
  ListedTuples(std::shared_ptr<Relation> relation, TupleList list, const algebra3d::Context& context)
      : relation_(std::move(relation)), list_(std::move(list)), context_(context) {}

  Result<TuplePtr> next() override {
    A3D_ASSIGN(const bool has_tuple, find_more(kSlowGrowth));
    if (!has_tuple) return TuplePtr();
    return tuple_of(*batch_, batch_->rows[position_++]);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    // A caller that asks for fewer may be content with them.
    A3D_ASSIGN(const bool has_tuple, find_more(most < kBatchTuples ? kSlowGrowth : kFastGrowth));
    if (!has_tuple) return nullptr;
    const std::size_t count = std::min(most, batch_->rows.count - position_);
    part_ = *batch_;
    if (count < batch_->rows.count) {
      rows_.clear();
      for (std::size_t i = 0; i < count; ++i) rows_.push_back(static_cast<std::uint32_t>(batch_->rows[position_ + i]));
      part_.rows = {rows_.data(), count};
    }
    position_ += count;
    return &part_;
  }

 private:
  /// Reads on when all tuples that were read have been given; false at the end.
  Result<bool> find_more(std::size_t growth) {
    while (batch_ == nullptr || position_ == batch_->rows.count) {
      if (first_ == list_.ids.size()) return false;
      A3D_TRY(context_.check_cancelled());
      A3D_TRY(read_on(growth));
    }
    return true;
  }

  Status read_on(std::size_t growth) {
    if (tuples_ == nullptr) {
      A3D_ASSIGN(tuples_, relation_->by_id(list_.read));
    }
    const auto ids = std::span(list_.ids).subspan(first_, std::min(ahead_, list_.ids.size() - first_));
    A3D_ASSIGN(batch_, tuples_->read(ids));
    first_ += ids.size();
    position_ = 0;
    ahead_ = next_ahead(ids.size(), growth);
    return check(ids);
  }

  Status check(std::span<const TupleId> ids) const {
    std::size_t found = 0;
    for (const TupleId id : ids) {
      const bool is_there = found < batch_->rows.count && batch_->ids[batch_->rows[found]] == id;
      if (!is_there || (list_.fits && !list_.fits(*batch_, batch_->rows[found])))
        A3D_TRY(list_.found_wrong(id, is_there));
      found += is_there ? 1 : 0;
    }
    return {};
  }

  /// How many tuples to read next: more and more, as long as they are small.
  std::size_t next_ahead(std::size_t last, std::size_t growth) const {
    constexpr std::size_t kMost = 16384, kMostBytes = std::size_t{4} << 20U;
    std::size_t bytes = 0;
    for (const ValueColumn* const column : batch_->columns) {
      if (column->size() == 0) continue;
      column->visit([&]<typename Element>(const Element* values) {
        if constexpr (std::is_same_v<Element, std::string>)
          batch_->rows.for_each([&](std::size_t row) { bytes += values[row].size(); });
        else if constexpr (std::is_same_v<Element, Value>)
          batch_->rows.for_each([&](std::size_t row) { bytes += algebra3d::heap_bytes(values[row]); });
      });
    }
    const std::size_t each = bytes / std::max<std::size_t>(batch_->rows.count, 1) + 1;
    return std::clamp<std::size_t>(kMostBytes / each, 1, std::min(growth * last, kMost));
  }

  static constexpr std::size_t kFirst = 64, kSlowGrowth = 4, kFastGrowth = 256;

  std::shared_ptr<Relation> relation_;
  TupleList list_;
  const algebra3d::Context& context_;
  std::unique_ptr<TuplesById> tuples_;  // from the first tuple on
  std::size_t first_ = 0;               // of the ids, that was not read yet
  std::size_t ahead_ = kFirst;
  const Batch* batch_ = nullptr;  // what was read last
  std::size_t position_ = 0;      // in it
  Batch part_;
  std::vector<std::uint32_t> rows_;
};

class TuplesByIdsOf final : public TupleStream {
 public:
  TuplesByIdsOf(TupleStreamPtr tuples, std::shared_ptr<Relation> relation, std::unique_ptr<TuplesById> by_id)
      : tuples_(std::move(tuples)), relation_(std::move(relation)), by_id_(std::move(by_id)), batches_(*tuples_) {}

  // An operator below that keeps few tuples has found all of them when it gives the first, so a batch costs no more.
  Result<TuplePtr> next() override {
    if (batch_ == nullptr || position_ == batch_->rows.count) {
      A3D_ASSIGN(batch_, next_batch(kBatchTuples));
      position_ = 0;
      if (batch_ == nullptr) return TuplePtr();
    }
    return tuple_of(*batch_, batch_->rows[position_++]);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    A3D_ASSIGN(const Batch* const found, batches_.next(most));
    if (found == nullptr) return nullptr;
    ids_.clear();
    found->rows.for_each([&](std::size_t row) { ids_.push_back(found->ids[row]); });
    A3D_ASSIGN(const Batch* const batch, by_id_->read(ids_));
    if (batch->rows.count == ids_.size()) return batch;
    return Error{ErrorCode::internal, "{}: a tuple that was read cannot be found by its id", relation_->name()};
  }

 private:
  TupleStreamPtr tuples_;
  std::shared_ptr<Relation> relation_;
  std::unique_ptr<TuplesById> by_id_;
  BatchReader batches_;
  std::vector<TupleId> ids_;
  const Batch* batch_ = nullptr;
  std::size_t position_ = 0;
};

}  // namespace

TupleStreamPtr tuples_by_ids_of(TupleStreamPtr tuples, std::shared_ptr<Relation> relation,
                                std::unique_ptr<TuplesById> by_id) {
  return std::make_shared<TuplesByIdsOf>(std::move(tuples), std::move(relation), std::move(by_id));
}

TupleStreamPtr listed_tuples(std::shared_ptr<Relation> relation, TupleList list, const algebra3d::Context& context) {
  return std::make_shared<ListedTuples>(std::move(relation), std::move(list), context);
}

}  // namespace queries
