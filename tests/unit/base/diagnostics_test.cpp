#include "algebra3d/base/diagnostics.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace algebra3d {
namespace {

TEST(Diagnostics, ten_thousand_equal_ones_are_one_line) {
  Diagnostics diagnostics;
  for (int i = 0; i < 10'000; ++i) diagnostics.report("createCube: an extent is 0", "tuple " + std::to_string(i));
  ASSERT_EQ(diagnostics.entries().size(), 1U);
  EXPECT_EQ(diagnostics.entries()[0].count, 10'000U);
  EXPECT_EQ(diagnostics.summary(),
            std::vector<std::string>{"createCube: an extent is 0 (tuple 0; tuple 1; tuple 2) and 9997 more"});
}

TEST(Diagnostics, different_ones_are_bounded) {
  Diagnostics diagnostics;
  for (int i = 0; i < 10'000; ++i) diagnostics.report("reason " + std::to_string(i));
  EXPECT_EQ(diagnostics.entries().size(), Diagnostics::kTextsKept);
  EXPECT_EQ(diagnostics.dropped_count(), 10'000 - Diagnostics::kTextsKept);
  EXPECT_EQ(diagnostics.summary().back(), "9800 further diagnostics of other kinds");
}

TEST(Diagnostics, several_threads_may_report) {
  Diagnostics diagnostics;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) diagnostics.report("same");
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(diagnostics.entries()[0].count, 4000U);
}

}  // namespace
}  // namespace algebra3d
