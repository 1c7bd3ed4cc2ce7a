#pragma once

#include <atomic>
#include <cstdint>

namespace algebra3d {

/// Counters of the cost of exact arithmetic in this process. Each thread has its own; reading sums them.
struct ExactCounters {
  std::uint64_t calls = 0;            ///< predicate calls
  std::uint64_t filter_failures = 0;  ///< calls that the floating-point filter could not decide
  std::uint64_t big_fallbacks = 0;    ///< calls that needed rationals or big integers
  std::uint64_t heap_rationals = 0;   ///< rationals created that did not fit 64 bits
};

/// The sum over all threads, ended ones included. Concurrent calls may be missing. Cost: one lock.
ExactCounters exact_counters();
/// The predicate calls of the calling thread so far: the difference of two readings is the cost of the work between
/// them.
std::uint64_t exact_calls_of_this_thread();
/// Sets the counts of all threads to zero. A concurrent call may restore its thread's old count.
void reset_exact_counters();

namespace detail {

/// The counts of one thread. Only that thread writes them, so an increment is a plain load and store.
struct ThreadCounters {
  std::atomic<std::uint64_t> calls{0};
  std::atomic<std::uint64_t> filter_failures{0};
  std::atomic<std::uint64_t> big_fallbacks{0};
  std::atomic<std::uint64_t> heap_rationals{0};
};

/// The counts of the calling thread while it is registered; null before its first count.
extern constinit thread_local ThreadCounters* thread_counters;  // NOLINT(readability-identifier-naming)
/// Registers the calling thread, so that its counts are included, also after its end.
ThreadCounters& register_thread_counters();

inline void increment(std::atomic<std::uint64_t> ThreadCounters::*count, std::uint64_t by = 1) {
  ThreadCounters* counters = thread_counters;
  if (counters == nullptr) [[unlikely]]
    counters = &register_thread_counters();
  auto& value = counters->*count;
  value.store(value.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

inline void count_call() {
  increment(&ThreadCounters::calls);
}
inline void count_calls(std::uint64_t count) {
  increment(&ThreadCounters::calls, count);
}
inline void count_filter_failure() {
  increment(&ThreadCounters::filter_failures);
}
inline void count_big_fallback() {
  increment(&ThreadCounters::big_fallbacks);
}
inline void count_heap_rational() {
  increment(&ThreadCounters::heap_rationals);
}

}  // namespace detail
}  // namespace algebra3d
