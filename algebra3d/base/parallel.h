#pragma once

#include <future>
#include <system_error>
#include <thread>
#include <utility>

namespace algebra3d {

/// Calls both, at the same time where that is worth a thread and the machine has two processors, else one after the
/// other. Returns when both have ended; throws what the first throws, or else the second. They must not share anything
/// that one of them changes.
template <typename First, typename Second>
void in_parallel(bool is_worth_a_thread, First&& first, Second&& second) {
  std::future<void> other;
  try {
    if (is_worth_a_thread && std::thread::hardware_concurrency() > 1)
      other = std::async(std::launch::async, std::ref(second));
  } catch (const std::system_error&) {
    // No thread is to be had: one after the other gives the same.
  }
  // If this throws, the destructor of `other` waits.
  std::forward<First>(first)();
  if (other.valid())
    other.get();
  else
    std::forward<Second>(second)();
}

}  // namespace algebra3d
