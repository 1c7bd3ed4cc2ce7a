#pragma once

#include <atomic>

namespace algebra3d {

/// An intrusive reference count of a shared immutable object. Thread-safe. `Integer` must hold the largest possible
/// number of owners.
template <typename Integer>
class ReferenceCount {
 public:
  explicit ReferenceCount(Integer owners) : owners_(owners) {}

  void add() noexcept { owners_.fetch_add(1, std::memory_order_relaxed); }
  /// True if this was the last owner, who must delete the object and sees all writes of the others.
  [[nodiscard]] bool remove() noexcept { return owners_.fetch_sub(1, std::memory_order_acq_rel) == 1; }

 private:
  std::atomic<Integer> owners_;
};

}  // namespace algebra3d
