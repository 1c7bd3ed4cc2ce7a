#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/indices.h"

namespace algebra3d::detail {

/// Numbers keys of 64 bits from 0 in order of first use: open addressing with linear probing.
class KeyNumbers {
 public:
  explicit KeyNumbers(std::size_t expected_count) : slots_(std::bit_ceil(2 * expected_count + 16)) {}

  std::uint32_t operator()(std::uint64_t key) {
    if (keys_.size() >= slots_.size() / 8 * 5) grow();
    Slot& slot = slot_of(key);
    if (slot.number == kNone) {
      slot = {key, static_cast<std::uint32_t>(keys_.size())};
      keys_.push_back(key);
    }
    return slot.number;
  }
  /// The keys by number.
  const std::vector<std::uint64_t>& keys() const { return keys_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;
  };

  Slot& slot_of(std::uint64_t key) {
    // The upper bits of the product depend on all bits of the key.
    std::size_t i = (key * 0x9E3779B97F4A7C15U) >> (64U - static_cast<unsigned>(std::countr_zero(slots_.size())));
    while (slots_[i].number != kNone && slots_[i].key != key) i = (i + 1) & (slots_.size() - 1);
    return slots_[i];
  }
  void grow() {
    slots_.assign(2 * slots_.size(), {});
    for (std::uint32_t number = 0; number < keys_.size(); ++number) slot_of(keys_[number]) = {keys_[number], number};
  }

  std::vector<Slot> slots_;  // their number is a power of two
  std::vector<std::uint64_t> keys_;
};

}  // namespace algebra3d::detail
