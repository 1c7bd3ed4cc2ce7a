#pragma once

#include <atomic>
#include <cstdint>

namespace algebra3d {

/// The work of exact predicates on long numbers, of more than a thousand bits, that the calling thread has done so far,
/// in products of two limbs (words of 64 bits), each one or two nanoseconds. Models have no such numbers; points where
/// triangles meet whose coordinates are of all sizes do. An estimate by lengths only, so the same calls give the same
/// work. The difference of two readings is the work of the thread between them.
std::uint64_t exact_work_of_this_thread();

/// A limit of the exact work of all threads that share it.
class ExactWorkLimit {
 public:
  explicit ExactWorkLimit(std::uint64_t most) : most_(most) {}

  /// Runs `action` and adds the work that it did in this thread.
  template <typename Action>
  auto measured(const Action& action) {
    const std::uint64_t before = exact_work_of_this_thread();
    auto result = action();
    if (const std::uint64_t after = exact_work_of_this_thread(); after != before) done_ += after - before;
    return result;
  }
  bool is_exceeded() const { return done_.load(std::memory_order_relaxed) > most_; }

 private:
  std::uint64_t most_;
  std::atomic<std::uint64_t> done_ = 0;
};

}  // namespace algebra3d
