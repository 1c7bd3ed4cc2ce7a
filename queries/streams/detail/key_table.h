#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/work_memory.h"
#include "queries/streams/batch.h"
#include "queries/streams/detail/hash_table.h"

namespace queries {

/// Numbers the different keys of rows from 0, in the order in which they come, within the work memory. Keys are values
/// of types that stand in columns (type_in_columns). Undefined equals undefined.
class KeyTable {
 public:
  static constexpr std::uint32_t kNoRoom = HashChains::kNone;

  /// `more_bytes`: what the caller keeps for each key.
  KeyTable(std::vector<std::size_t> keys, std::size_t more_bytes, const Context& context)
      : keys_(std::move(keys)), more_bytes_(more_bytes), account_(context.memory) {}

  /// The number of the key of a row, which is new if it is the number of keys that there were. Once the memory is
  /// exhausted nothing is added, and new keys have kNoRoom; the first key always has room.
  std::uint32_t number_of(const Batch& batch, std::size_t row);
  std::size_t size() const { return ends_.size(); }
  void clear();

 private:
  void append_key(const ValueColumn& column, std::size_t row);
  std::string_view key(std::size_t number) const;

  std::vector<std::size_t> keys_;
  std::size_t more_bytes_;
  algebra3d::MemoryAccount account_;
  HashChains chains_;
  std::string bytes_;              // of all keys
  std::vector<std::size_t> ends_;  // in the bytes
  std::string key_;                // of the row; reused
  bool is_full_ = false;
};

}  // namespace queries
