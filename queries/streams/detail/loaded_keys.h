#pragma once

#include <optional>
#include <vector>

#include "queries/streams/batch.h"

namespace queries {

/// Batches with loaded values of their key attributes: those whose type has large values follow the other columns once
/// more, loaded.
class LoadedKeys {
 public:
  explicit LoadedKeys(std::vector<std::size_t> keys) : keys_(std::move(keys)) {}
  /// The batch with its keys, valid until the next call, and as long as the batch. Errors: those of loading.
  Result<const Batch*> with_keys(const Batch& batch);
  /// The column of a key in what `with_keys` has given.
  std::size_t attribute(std::size_t which) const { return columns_[which]; }

 private:
  std::vector<std::size_t> keys_;
  std::vector<std::size_t> columns_;  // of the keys
  std::vector<ValueColumn> loaded_;
  Batch batch_;
};

}  // namespace queries
