#pragma once

#include <cstdint>
#include <optional>
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

  /// The numbers of the keys of a batch, by tuple: a new one is the number of keys that there were before the tuple.
  /// Once the memory is exhausted nothing is added, and new keys have kNoRoom; the first key always has room.
  void find_numbers(const Batch& batch, std::vector<std::uint32_t>& numbers);
  std::size_t size() const { return chains_.size(); }
  void clear();

 private:
  template <typename Element>
  void find_words(const ValueColumn& column, const Element* values, const SelectedRows& rows,
                  std::vector<std::uint32_t>& numbers);
  void append_key(const ValueColumn& column, std::size_t row);
  std::uint32_t number_of_bytes();
  bool has_room_for(std::size_t bytes);
  std::string_view key(std::size_t number) const;

  std::vector<std::size_t> keys_;
  std::size_t more_bytes_;
  algebra3d::MemoryAccount account_;
  HashChains chains_;
  std::optional<std::uint32_t> undefined_;  // the number of undefined as the only key
  std::string bytes_;                       // of all keys, unless numbers are the only key
  std::vector<std::size_t> ends_;           // in the bytes
  std::string key_;                         // of the row; reused
  std::vector<std::size_t> hashes_;         // of rows; reused
  bool is_full_ = false;
};

}  // namespace queries
