#include "base/scheduler.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace algebra3d {
namespace {

/// Number of threads that take part in a loop of 2,000 steps of 20 microseconds.
std::size_t threads_at_work() {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  parallel_for(2000, 1, [&](std::size_t) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(20);
    while (std::chrono::steady_clock::now() < end) continue;
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  return threads.size();
}

/// What `work` gives in a child of this process; 255 if it does not end within 20 seconds.
template <typename Work>
int in_child(const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(static_cast<int>(work()));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 255;
}

TEST(Scheduler, VisitsEachIndexOnce) {
  for (const std::size_t count : {0, 1, 2, 7, 8, 9, 1000}) {
    std::vector<std::atomic<int>> visits(count);
    parallel_for(count, 8, [&](std::size_t i) { ++visits[i]; });
    for (const auto& visit : visits) EXPECT_EQ(visit, 1);
  }
}

TEST(Scheduler, RoundsToNearestWhateverTheCallerDoes) {
  const int before = std::fegetround();
  std::fesetround(FE_UPWARD);
  std::atomic<int> others = 0;
  const auto look = [&] { others += std::fegetround() != FE_TONEAREST; };
  parallel_for(1000, 1, [&](std::size_t) { look(); });
  parallel_invoke(true, look, look);
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  std::fesetround(before);
  EXPECT_EQ(others, 0);
}

TEST(Scheduler, CollectsInOrder) {
  for (const std::size_t count : {0, 1, 9, 10, 11, 1000}) {
    const auto found = parallel_collect(count, 10, [](std::size_t begin, std::size_t end) {
      std::vector<std::size_t> range(end - begin);
      std::iota(range.begin(), range.end(), begin);
      return range;
    });
    std::vector<std::size_t> expected(count);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(found, expected);
  }
}

TEST(Scheduler, InvokesBoth) {
  for (const bool is_worth_a_thread : {false, true}) {
    int first = 0, second = 0;
    parallel_invoke(
        is_worth_a_thread, [&] { first = 1; }, [&] { second = 2; });
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 2);
  }
}

TEST(Scheduler, Nests) {
  std::array<std::atomic<int>, 16> sums{};
  parallel_for(16, 1, [&](std::size_t i) { parallel_for(100, 10, [&](std::size_t) { ++sums[i]; }); });
  for (const auto& sum : sums) EXPECT_EQ(sum, 100);
}

TEST(Scheduler, ThrowsWhatAPartThrows) {
  EXPECT_THROW(parallel_for(1000, 1,
                            [](std::size_t i) {
                              if (i == 500) throw std::runtime_error("500");
                            }),
               std::runtime_error);
  EXPECT_THROW(parallel_invoke(
                   true, [] {}, [] { throw std::bad_alloc(); }),
               std::bad_alloc);
}

// A part that another one has thrown out must not go on as if its own loops had been done.
TEST(Scheduler, NestedLoopsAreWholeOrThrowWhenAnotherPartThrows) {
  std::atomic<int> incomplete = 0, ended = 0;
  for (int round = 0; round < 300; ++round) {
    std::atomic<bool> has_begun = false;
    std::vector<int> visits(4096);
    const auto fail_beside = [&] {
      const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
      while (!has_begun && std::chrono::steady_clock::now() < end) std::this_thread::yield();
      throw std::runtime_error("first");
    };
    const auto loops = [&] {
      has_begun = true;
      for (int i = 0; i < 100; ++i) {
        std::ranges::fill(visits, 0);
        if (i % 2 == 0)
          parallel_for(visits.size(), 64, [&](std::size_t k) { visits[k] = 1; });
        else
          parallel_invoke(
              true, [&] { std::fill_n(visits.begin(), 2048, 1); },
              [&] { std::fill_n(visits.begin() + 2048, 2048, 1); });
        if (std::ranges::find(visits, 0) != visits.end()) ++incomplete;
      }
      ++ended;
    };
    EXPECT_THROW(parallel_invoke(true, fail_beside, loops), std::runtime_error);
  }
  EXPECT_EQ(incomplete, 0);
  EXPECT_LT(ended, 300) << "no loop was ever ended";
}

TEST(Scheduler, UsesSoManyThreadsAsAllowed) {
  with_threads(1, [] { EXPECT_EQ(threads_at_work(), 1U); });
  const std::thread::id caller = std::this_thread::get_id();
  with_threads(1, [&] { EXPECT_EQ(std::this_thread::get_id(), caller); });
  with_threads(4, [] {
    EXPECT_GE(threads_at_work(), 2U);
    EXPECT_LE(threads_at_work(), 4U);
  });
}

TEST(Scheduler, OneThreadDoesEverythingInOrder) {
  std::vector<std::size_t> order;
  with_threads(1, [&] {
    parallel_for(10, 3, [&](std::size_t i) { order.push_back(i); });
    parallel_invoke(
        true, [&] { order.push_back(10); }, [&] { order.push_back(11); });
    // Within it, another number holds, and afterwards this one again.
    with_threads(4, [] { EXPECT_GE(threads_at_work(), 2U); });
    EXPECT_EQ(threads_at_work(), 1U);
    EXPECT_THROW(parallel_for(10, 3,
                              [](std::size_t i) {
                                if (i == 7) throw std::runtime_error("seven");
                              }),
                 std::runtime_error);
  });
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(order.at(i), i);
  EXPECT_EQ(order.size(), 12U);
}

TEST(Scheduler, AWaitingThreadTakesNoWorkOfOthers) {
  // Each outer step notes whether its thread is inside of another outer step.
  static thread_local bool is_inside = false;
  std::atomic<int> strays = 0;
  parallel_for(64, 1, [&](std::size_t) {
    if (is_inside) ++strays;
    is_inside = true;
    static_cast<void>(
        parallel_collect(50, 1, [](std::size_t begin, std::size_t) { return std::vector<std::size_t>(100, begin); }));
    is_inside = false;
  });
  EXPECT_EQ(strays, 0);
}

TEST(Scheduler, ChildrenStartThreadsOfTheirOwn) {
  const std::size_t before = threads_at_work();
  EXPECT_EQ(in_child(threads_at_work), before);
  if (std::thread::hardware_concurrency() > 1) {
    EXPECT_GE(before, 2U);
  }
  EXPECT_EQ(threads_at_work(), before);
}

TEST(Scheduler, AChildOfABusyParentWorksAlone) {
  std::atomic<bool> is_over = false, has_begun = false;
  std::thread other([&] {
    parallel_for(64, 1, [&](std::size_t) {
      has_begun = true;
      while (!is_over) std::this_thread::yield();
    });
  });
  while (!has_begun) std::this_thread::yield();
  EXPECT_EQ(in_child(threads_at_work), 1);
  is_over = true;
  other.join();
}

}  // namespace
}  // namespace algebra3d
