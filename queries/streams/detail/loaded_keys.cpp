#include "queries/streams/detail/loaded_keys.h"

#include <algorithm>

#include "base/propagate.h"

namespace queries {

Result<const Batch*> LoadedKeys::with_keys(const Batch& batch) {
  const std::size_t count = batch.columns.size();
  if (columns_.size() < keys_.size())
    for (const std::size_t key : keys_) {
      const bool is_large = batch.columns[key]->type().is_large();
      columns_.push_back(is_large ? count + loaded_.size() : key);
      if (is_large) loaded_.emplace_back(batch.columns[key]->type());
    }
  if (loaded_.empty()) return &batch;
  batch_ = batch;
  for (std::size_t which = 0; which < keys_.size(); ++which) {
    if (columns_[which] < count) continue;
    ValueColumn& loaded = loaded_[columns_[which] - count];
    loaded.restart(batch.size);
    for (std::size_t i = 0; i < batch.rows.count; ++i) {
      const std::size_t row = batch.rows[i];
      A3D_ASSIGN(const Value value, batch.columns[keys_[which]]->value(row).loaded());
      loaded.set(row, value);
    }
    batch_.columns.push_back(&loaded);
  }
  return &batch_;
}

}  // namespace queries
