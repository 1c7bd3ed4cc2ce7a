#include "base/memory_limit.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "base/detail/machine_memory.h"
#include "base/scheduler.h"
#include "base/without_exceptions.h"
#include "base/work_memory.h"
#include "support/scratch_folder.h"

// The test program keeps the allocation functions of the library, so all that is counted here is what is charged here.
namespace algebra3d {
namespace {

constexpr std::size_t kOneMegabyte = std::size_t{1} << 20U;
constexpr std::size_t kLimit = 64 * kOneMegabyte;

/// Gives the process its own limit back.
struct ProcessLimit {
  ProcessLimit(std::size_t limit, std::size_t reserve) { ProcessMemory::set_limit(limit, reserve); }
  ~ProcessLimit() { ProcessMemory::set_limit(MemoryUser::kNoLimit); }
  ProcessLimit(const ProcessLimit&) = delete;
  ProcessLimit& operator=(const ProcessLimit&) = delete;
};

TEST(MemoryLimit, what_would_exceed_it_is_refused_and_not_counted) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  ProcessMemory::charge(40 * kOneMegabyte);
  EXPECT_EQ(user.used(), 40 * kOneMegabyte);
  EXPECT_THROW(ProcessMemory::charge(40 * kOneMegabyte), MemoryLimitReached);
  EXPECT_EQ(user.used(), 40 * kOneMegabyte);
  EXPECT_EQ(memory_left(), 24 * kOneMegabyte);
  ProcessMemory::charge(20 * kOneMegabyte);
  ProcessMemory::discharge(60 * kOneMegabyte);
  EXPECT_EQ(user.used(), 0U);
}

TEST(MemoryLimit, small_amounts_add_up_to_it) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  std::size_t taken = 0;
  EXPECT_THROW(
      while (true) {
        ProcessMemory::charge(48);
        taken += 48;
      },
      MemoryLimitReached);
  EXPECT_GT(taken, kLimit - kOneMegabyte);
  EXPECT_LE(taken, kLimit + static_cast<std::size_t>(ProcessMemory::kBatch));
  ProcessMemory::discharge(taken);
}

TEST(MemoryLimit, what_cannot_fail_is_granted_and_the_next_is_refused) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  ProcessMemory::charge_always(2 * kLimit);
  EXPECT_THROW(ProcessMemory::charge(1), MemoryLimitReached);
  ProcessMemory::discharge(2 * kLimit);
  EXPECT_NO_THROW(ProcessMemory::charge(kOneMegabyte));
  ProcessMemory::discharge(kOneMegabyte);
  EXPECT_EQ(user.used(), 0U);
}

TEST(MemoryLimit, tasks_count_for_the_user_of_their_caller) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  parallel_for(64, 1, [](std::size_t) { ProcessMemory::charge(kOneMegabyte / 2); });
  EXPECT_EQ(user.used(), 32 * kOneMegabyte);
  EXPECT_THROW(parallel_for(200, 1, [](std::size_t) { ProcessMemory::charge(kOneMegabyte); }), MemoryLimitReached);
  ProcessMemory::discharge(user.used());
}

TEST(MemoryLimit, other_users_and_threads_without_one_go_on) {
  MemoryUser large(kLimit), small(kLimit);
  {
    const MemoryUserScope scope(&large);
    ProcessMemory::charge(kLimit);
    EXPECT_THROW(ProcessMemory::charge(kOneMegabyte), MemoryLimitReached);
  }
  {
    const MemoryUserScope scope(&small);
    EXPECT_NO_THROW(ProcessMemory::charge(kOneMegabyte));
    ProcessMemory::discharge(kOneMegabyte);
  }
  ProcessMemory::discharge(kLimit);
}

TEST(MemoryLimit, the_reserve_of_the_process_is_for_those_that_hold_little) {
  const ProcessLimit limit(ProcessMemory::used() + 64 * kOneMegabyte, 16 * kOneMegabyte);
  MemoryUser large, small;
  std::size_t taken = 0;
  {
    const MemoryUserScope scope(&large);
    EXPECT_THROW(
        while (true) {
          ProcessMemory::charge(kOneMegabyte);
          taken += kOneMegabyte;
        },
        MemoryLimitReached);
  }
  EXPECT_EQ(taken, 48 * kOneMegabyte);
  {
    const MemoryUserScope scope(&small);
    EXPECT_NO_THROW(ProcessMemory::charge(2 * kOneMegabyte));
    EXPECT_THROW(ProcessMemory::charge(kOneMegabyte), MemoryLimitReached);
    ProcessMemory::discharge(2 * kOneMegabyte);
  }
  ProcessMemory::discharge(taken);
}

TEST(MemoryLimit, a_thread_that_ends_has_counted_all) {
  const std::size_t before = ProcessMemory::used();
  std::thread([] { ProcessMemory::charge(kOneMegabyte), ProcessMemory::charge(1000); }).join();
  EXPECT_EQ(ProcessMemory::used(), before + kOneMegabyte + 1000);
  ProcessMemory::discharge(kOneMegabyte + 1000);
}

TEST(MemoryLimit, destructors_may_allocate_while_an_exception_is_on_its_way) {
  struct Allocating {
    ~Allocating() {
      for (int i = 0; i < 1000; ++i) ProcessMemory::charge(1000);
    }
  };
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  ProcessMemory::charge(kLimit);
  EXPECT_THROW(
      {
        const Allocating allocating;
        ProcessMemory::charge(kOneMegabyte);
      },
      MemoryLimitReached);
  ProcessMemory::discharge(user.used());
}

TEST(MemoryLimit, the_error_says_limit_and_remedy) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  const Status caught = without_exceptions([]() -> Status {
    ProcessMemory::charge(2 * kLimit);
    return {};
  });
  ASSERT_FALSE(caught);
  EXPECT_EQ(caught.error().code, ErrorCode::limit_exceeded);
  EXPECT_EQ(
      caught.error().text(),
      "more memory is needed than the memory limit of 64 MB (`set \"memory\"` or --memory) allows; split the work "
      "or raise the limit");
  EXPECT_EQ(memory_error(std::bad_alloc()).code, ErrorCode::out_of_memory);
}

TEST(MemoryLimit, known_sizes_are_refused_before_the_work) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  EXPECT_TRUE(require_memory(kLimit, "work: 1 part"));
  const Status refused = require_memory(kLimit + 1, "work: 2 parts");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::limit_exceeded);
  EXPECT_EQ(
      refused.error().text(),
      "work: 2 parts would take about 65 MB, and 64 MB are left of the memory limit of 64 MB (`set \"memory\"` or "
      "--memory); raise it, or ask for less");
}

TEST(MemoryLimit, operators_spill_by_what_the_heap_leaves) {
  MemoryUser user(kLimit);
  const MemoryUserScope scope(&user);
  WorkMemory memory(kLimit, "/tmp", &user);
  MemoryAccount account(&memory);
  EXPECT_TRUE(account.take(20 * kOneMegabyte));
  account.clear();
  ProcessMemory::charge(34 * kOneMegabyte);
  EXPECT_FALSE(account.take(11 * kOneMegabyte));
  EXPECT_TRUE(account.take(9 * kOneMegabyte));
  ProcessMemory::discharge(34 * kOneMegabyte);
}

TEST(MachineMemory, the_least_limit_of_the_control_groups_counts) {
  const ScratchFolder scratch;
  const std::filesystem::path root = scratch.path("cgroup"), groups = scratch.path("groups");
  const auto write = [](const std::filesystem::path& file, const char* text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  };
  write(groups, "0::/a/b");
  EXPECT_EQ(control_group_limit(groups, root), SIZE_MAX);
  write(root / "a/b/memory.max", "max");
  write(root / "a/memory.max", "1000000");
  EXPECT_EQ(control_group_limit(groups, root), 1000000U);
  write(root / "a/b/memory.max", "900000");
  EXPECT_EQ(control_group_limit(groups, root), 900000U);
  write(groups, "5:memory,cpu:/c\n4:pids:/d");
  write(root / "memory/c/memory.limit_in_bytes", "800000");
  EXPECT_EQ(control_group_limit(groups, root), 800000U);
  EXPECT_GT(available_memory(), 16 * kOneMegabyte);
}

}  // namespace
}  // namespace algebra3d
