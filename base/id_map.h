#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace algebra3d {

/// A map from integers to ids (StrongId) that only grows: open addressing with linear probing, in one array. Source:
/// [knuth1998], section 6.4.
template <typename Id>
class IdMap {
 public:
  /// Makes room for so many keys.
  void reserve(std::size_t count) {
    if (count > capacity_) resize(slots_for(count));
  }
  /// The id of a key; none for a new key, which the caller must set. Valid until the next call. Cost: constant
  /// expected.
  Id& operator[](std::uint64_t key) {
    if (size_ >= capacity_) grow();
    Slot& slot = slot_of(key);
    if (slot.id.is_none()) {
      slot.lower = static_cast<std::uint32_t>(key);
      slot.upper = static_cast<std::uint32_t>(key >> 32U);
      ++size_;
    }
    return slot.id;
  }

 private:
  /// The key in two halves, for twelve bytes a slot.
  struct Slot {
    std::uint32_t lower = 0, upper = 0;
    Id id;  ///< none: the slot is free

    std::uint64_t key() const { return std::uint64_t{upper} << 32U | lower; }
  };

  Slot& slot_of(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (key * 0x9E3779B97F4A7C15U) >> shift_;
    while (!slots_[i].id.is_none() && slots_[i].key() != key) i = (i + 1) & mask;
    return slots_[i];
  }

  // Small maps grow fast and stay half empty; large ones are to take little memory.
  static constexpr std::size_t kFewestSlots = 64, kManySlots = 32768;

  static std::size_t capacity_of(std::size_t slot_count) {
    return slot_count < kManySlots ? slot_count / 2 : slot_count / 4 * 3;
  }
  static std::size_t slots_for(std::size_t count) {
    std::size_t slot_count = kFewestSlots;
    while (capacity_of(slot_count) < count) slot_count *= 2;
    return slot_count;
  }
  void grow() { resize(slots_.empty() ? kFewestSlots : (slots_.size() < kManySlots ? 4 : 2) * slots_.size()); }
  void resize(std::size_t slot_count) {
    capacity_ = capacity_of(slot_count);
    shift_ = 64 - std::countr_zero(slot_count);
    for (const Slot& slot : std::exchange(slots_, std::vector<Slot>(slot_count)))
      if (!slot.id.is_none()) slot_of(slot.key()) = slot;
  }

  std::vector<Slot> slots_;  // their number is 0 or a power of two
  int shift_ = 0;            // from a hash to a place
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace algebra3d
