#include "queries/streams/batch_buffer.h"

#include <utility>

#include "base/propagate.h"

namespace queries {
namespace {

std::size_t bytes_of(const ValueColumn& column) {
  return column.visit([&]<typename Element>(const Element* values) {
    std::size_t bytes = column.size() * (sizeof(Element) + 1);
    for (std::size_t row = 0; row < column.size(); ++row) {
      if constexpr (std::is_same_v<Element, std::string>) bytes += values[row].capacity();
      if constexpr (std::is_same_v<Element, Value>) bytes += algebra3d::heap_bytes(values[row]);
    }
    return bytes;
  });
}

/// Batches, then the tuples of a stream.
class BufferedBatches final : public TupleStream {
 public:
  BufferedBatches(std::deque<KeptBatch> batches, algebra3d::MemoryAccount account, TupleStreamPtr rest)
      : batches_(std::move(batches)), account_(std::move(account)), rest_(std::move(rest)), rest_batches_(*rest_) {}

  Result<TuplePtr> next() override {
    A3D_ASSIGN(const Batch* const batch, next_batch(1));
    return batch == nullptr ? TuplePtr() : tuple_of(*batch, batch->rows[0]);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (!batches_.empty() && position_ == batches_.front().batch().size) {
      position_ = 0;
      batches_.pop_front();
    }
    if (batches_.empty()) {
      account_.clear();
      return rest_batches_.next(most);
    }
    const Batch& front = batches_.front().batch();
    rows_.clear();
    for (; rows_.size() < most && position_ < front.size; ++position_)
      rows_.push_back(static_cast<std::uint32_t>(position_));
    part_ = front;
    part_.rows = {rows_.data(), rows_.size()};
    return &part_;
  }

 private:
  std::deque<KeptBatch> batches_;
  algebra3d::MemoryAccount account_;
  TupleStreamPtr rest_;
  BatchReader rest_batches_;
  std::size_t position_ = 0;  // in the first batch
  std::vector<std::uint32_t> rows_;
  Batch part_;
};

}  // namespace

KeptBatch::KeptBatch(const Batch& batch) : own_(std::make_unique<OwnBatch>()) {
  std::vector<const algebra3d::Type*> types;
  for (const ValueColumn* const column : batch.columns) types.push_back(&column->type());
  own_->set_types(types);
  bytes_ = sizeof(OwnBatch) + batch.rows.count * sizeof(TupleId);
  for (std::size_t attribute = 0; attribute < types.size(); ++attribute) {
    gather(*batch.columns[attribute], batch.rows, own_->columns[attribute]);
    bytes_ += bytes_of(own_->columns[attribute]);
  }
  if (batch.ids != nullptr) batch.rows.for_each([&](std::size_t row) { own_->ids.push_back(batch.ids[row]); });
  own_->finish(batch.rows.count);
}

Status BatchBuffer::add(const Batch& batch) {
  if (!rest_) {
    KeptBatch kept(batch);
    if (account_.take(kept.bytes())) {
      batches_.push_back(std::move(kept));
      return {};
    }
    rest_.emplace(context_);
  }
  for (std::size_t i = 0; i < batch.rows.count; ++i) A3D_TRY(rest_->add(tuple_of(batch, batch.rows[i])));
  return {};
}

TupleStreamPtr BatchBuffer::take() {
  TupleStreamPtr rest = rest_ ? rest_->scan() : TupleBuffer(std::vector<TuplePtr>()).scan();
  return std::make_shared<BufferedBatches>(std::move(batches_), std::move(account_), std::move(rest));
}

}  // namespace queries
