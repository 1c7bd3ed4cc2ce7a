#pragma once

#include <cstddef>
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

/// Calls visit(i) for each i below `count`, from `worth_a_thread` on in two halves at the same time. A call must not
/// share anything that another one changes.
template <typename Visit>
void in_halves(std::size_t count, std::size_t worth_a_thread, const Visit& visit) {
  const auto visit_all = [&visit](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) visit(i);
  };
  const std::size_t half = count / 2;
  in_parallel(
      count >= worth_a_thread, [&] { visit_all(0, half); }, [&] { visit_all(half, count); });
}

}  // namespace algebra3d
