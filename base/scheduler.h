#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace algebra3d {

// The scheduler of all parallel work: oneTBB tasks on as many threads as the process may use processors.
//
// - Results do not depend on the number of threads: the division of the work depends on its size only.
// - Nested calls use no more threads than processors. A thread that waits inside a call works on that call only, so a
//   call is safe while thread-local state of the caller is in use.
// - Threads start with the first parallel call, never when the library is loaded, and end before a fork; parent and
//   child start new ones when needed. If other threads are working at a fork, the child uses one thread.
// - Tasks round to nearest, whatever the threads did before. Their memory counts for the user of the calling thread
//   (memory_limit.h).
// - An exception in a task is thrown by the call, after all tasks that had begun have ended.

namespace scheduler_detail {
void run_both(const std::function<void()>& first, const std::function<void()>& second);
void run_ranges(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t begin, std::size_t end)>& visit);
}  // namespace scheduler_detail

/// Calls both functions, in parallel if `is_worth_a_thread`, else in sequence. The first one runs on the calling
/// thread, so it may report progress. Neither may change data that the other uses.
template <typename First, typename Second>
void parallel_invoke(bool is_worth_a_thread, First&& first, Second&& second) {
  if (is_worth_a_thread) {
    scheduler_detail::run_both(std::ref(first), std::ref(second));
  } else {
    std::forward<First>(first)();
    std::forward<Second>(second)();
  }
}

/// Calls visit(i) once for each i below `count`, in parallel for ranges of at least `grain` / 2 indices. A call must
/// not change data that another uses.
template <typename Visit>
void parallel_for(std::size_t count, std::size_t grain, const Visit& visit) {
  const auto visit_range = [&visit](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) visit(i);
  };
  if (count <= grain)
    visit_range(0, count);
  else
    scheduler_detail::run_ranges(count, grain, visit_range);
}

/// Calls make(begin, end), which returns a vector, for consecutive ranges of `size` indices below `count`, and
/// concatenates the vectors in order.
template <typename Make>
auto parallel_collect(std::size_t count, std::size_t size, const Make& make) {
  using Items = decltype(make(count, count));
  if (count <= size) return make(0, count);
  std::vector<Items> parts((count + size - 1) / size);
  parallel_for(parts.size(), 1, [&](std::size_t i) { parts[i] = make(i * size, std::min((i + 1) * size, count)); });
  std::size_t total = 0;
  for (const Items& part : parts) total += part.size();
  Items all = std::move(parts.front());
  all.reserve(total);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    all.insert(all.end(), std::make_move_iterator(parts[i].begin()), std::make_move_iterator(parts[i].end()));
    Items().swap(parts[i]);
  }
  return all;
}

/// Runs `work` with at most `threads` threads; 1 for hosts that allow no threads: then everything is done by this one,
/// which costs nothing.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace algebra3d
