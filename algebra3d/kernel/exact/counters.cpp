#include "algebra3d/kernel/exact/counters.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace algebra3d {

namespace detail {

constinit thread_local ThreadCounters* thread_counters = nullptr;

namespace {

struct Registry {
  std::mutex mutex;
  std::vector<ThreadCounters*> running;
  ThreadCounters ended;  // sums over threads that are gone
};

// Never destroyed: threads and static objects may still count while the program ends.
Registry& registry() {
  static auto* const the_registry = new Registry;
  return *the_registry;
}

template <typename Action>
void for_each_count(Action action) {
  action(&ThreadCounters::calls);
  action(&ThreadCounters::filter_failures);
  action(&ThreadCounters::big_fallbacks);
  action(&ThreadCounters::heap_rationals);
}

void add(ThreadCounters& sum, const ThreadCounters& counters) {
  for_each_count([&](auto count) { (sum.*count) += (counters.*count).load(std::memory_order_relaxed); });
}

// Belongs to one thread. On its end the counts pass to the registry; a count after that (from a destructor of another
// thread-local object) goes to a block that is shared by all such threads and may lose increments to races, not memory.
class Registration {
 public:
  Registration() {
    const std::lock_guard lock(registry().mutex);
    registry().running.push_back(&counters_);
    thread_counters = &counters_;
  }
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;
  ~Registration() {
    const std::lock_guard lock(registry().mutex);
    add(registry().ended, counters_);
    std::erase(registry().running, &counters_);
    thread_counters = &registry().ended;
  }

 private:
  ThreadCounters counters_;
};

}  // namespace

ThreadCounters& register_thread_counters() {
  static thread_local const Registration registration;
  return *thread_counters;
}

}  // namespace detail

ExactCounters exact_counters() {
  auto& registry = detail::registry();
  const std::lock_guard lock(registry.mutex);
  detail::ThreadCounters sum;
  detail::add(sum, registry.ended);
  for (const auto* counters : registry.running) detail::add(sum, *counters);
  return {sum.calls, sum.filter_failures, sum.big_fallbacks, sum.heap_rationals};
}

std::uint64_t exact_calls_of_this_thread() {
  const detail::ThreadCounters* const counters = detail::thread_counters;
  return counters == nullptr ? 0 : counters->calls.load(std::memory_order_relaxed);
}

void reset_exact_counters() {
  auto& registry = detail::registry();
  const std::lock_guard lock(registry.mutex);
  const auto clear = [](detail::ThreadCounters& counters) {
    detail::for_each_count([&](auto count) { (counters.*count).store(0, std::memory_order_relaxed); });
  };
  clear(registry.ended);
  for (auto* counters : registry.running) clear(*counters);
}

}  // namespace algebra3d
