#include "base/work_memory.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace algebra3d {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20U;

/// Takes until there is no more.
void fill(MemoryAccount& account) {
  while (account.take(1000)) {
  }
}

TEST(WorkMemory, many_accounts_stay_within_the_limit_and_each_finds_something) {
  WorkMemory memory(64 * kMegabyte, "/tmp");
  std::vector<MemoryAccount> accounts;
  for (int i = 0; i < 8; ++i) fill(accounts.emplace_back(&memory));
  EXPECT_LE(memory.used(), memory.limit());
  for (const MemoryAccount& account : accounts) EXPECT_GT(account.used(), memory.limit() / 600);
  EXPECT_GT(accounts[0].used(), memory.limit() * 33 / 100);
  EXPECT_LE(accounts[0].used(), memory.limit() / 3);
  accounts.clear();
  EXPECT_EQ(memory.used(), 0U);
}

TEST(WorkMemory, what_is_refused_is_not_taken) {
  WorkMemory memory(kMegabyte, "/tmp");
  MemoryAccount account(&memory);
  EXPECT_TRUE(account.take(1000));
  EXPECT_FALSE(account.take(kMegabyte));
  EXPECT_EQ(account.used(), 1000U);
  EXPECT_EQ(memory.used(), 1000U);
}

TEST(WorkMemory, a_little_is_always_to_be_had) {
  WorkMemory memory(1, "/tmp");
  MemoryAccount account(&memory);
  EXPECT_TRUE(account.take(MemoryAccount::kLeast));
  EXPECT_FALSE(account.take(1));
}

TEST(WorkMemory, an_account_that_moves_is_given_back_once) {
  WorkMemory memory(kMegabyte, "/tmp");
  {
    MemoryAccount first(&memory);
    EXPECT_TRUE(first.take(1000));
    MemoryAccount second(std::move(first));
    MemoryAccount third(&memory);
    EXPECT_TRUE(third.take(500));
    third = std::move(second);
    EXPECT_EQ(memory.used(), 1000U);
  }
  EXPECT_EQ(memory.used(), 0U);
}

TEST(WorkMemory, without_a_limit_everything_is_to_be_had) {
  MemoryAccount account(nullptr);
  EXPECT_TRUE(account.take(std::size_t{1} << 60U));
}

}  // namespace
}  // namespace algebra3d
