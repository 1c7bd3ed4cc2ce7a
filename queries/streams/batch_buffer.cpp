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
  Content& content = *content_;
  if (!content.rest) {
    KeptBatch kept(batch);
    if (content.account.take(kept.bytes())) {
      content.batches.push_back(std::move(kept));
      return {};
    }
    content.rest.emplace(content.context);
  }
  for (std::size_t i = 0; i < batch.rows.count; ++i) A3D_TRY(content.rest->add(tuple_of(batch, batch.rows[i])));
  return {};
}

class BatchBuffer::Scan final : public TupleStream {
 public:
  explicit Scan(std::shared_ptr<const Content> content)
      : content_(std::move(content)),
        rest_(content_->rest ? content_->rest->scan() : TupleBuffer(std::vector<TuplePtr>()).scan()),
        rest_batches_(*rest_) {}

  Result<TuplePtr> next() override {
    A3D_ASSIGN(const Batch* const batch, next_batch(1));
    return batch == nullptr ? TuplePtr() : tuple_of(*batch, batch->rows[0]);
  }
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (batch_ < content_->batches.size() && position_ == content_->batches[batch_].batch().size) {
      position_ = 0;
      ++batch_;
    }
    if (batch_ == content_->batches.size()) return rest_batches_.next(most);
    part_ = content_->batches[batch_].batch();
    rows_.clear();
    for (; rows_.size() < most && position_ < part_.size; ++position_)
      rows_.push_back(static_cast<std::uint32_t>(position_));
    part_.rows = {rows_.data(), rows_.size()};
    return &part_;
  }

 private:
  std::shared_ptr<const Content> content_;
  TupleStreamPtr rest_;
  BatchReader rest_batches_;
  std::size_t batch_ = 0, position_ = 0;  // of the next tuple
  std::vector<std::uint32_t> rows_;
  Batch part_;
};

TupleStreamPtr BatchBuffer::scan() const {
  return std::make_shared<Scan>(content_);
}

}  // namespace queries
