#include "base/diagnostics.h"

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
  for (int i = 0; i < 10'000; ++i) diagnostics.show("reason " + std::to_string(i));
  EXPECT_EQ(diagnostics.entries().size(), Diagnostics::kTextsKept);
  EXPECT_EQ(diagnostics.dropped_count(), 10'000 - Diagnostics::kTextsKept);
  EXPECT_EQ(diagnostics.summary().back(), "9800 further diagnostics of other kinds");
}

TEST(Diagnostics, of_those_that_differ_only_in_numbers_three_are_kept) {
  Diagnostics diagnostics;
  for (int i = 1; i <= 10'000; ++i) {
    diagnostics.report("the result " + std::to_string(-i) + " is beyond 7");
    diagnostics.report("the value " + std::to_string(i * 0.5) + " is new");
  }
  EXPECT_EQ(diagnostics.summary(),
            (std::vector<std::string>{"the result -1 is beyond 7", "the value 0.500000 is new",
                                      "the result -2 is beyond 7", "the value 1.000000 is new",
                                      "the result -3 is beyond 7; 9997 more differ only in numbers",
                                      "the value 1.500000 is new; 9997 more differ only in numbers"}));
}

TEST(Diagnostics, an_equal_text_is_counted_however_many_are_alike) {
  Diagnostics diagnostics;
  for (int i = 0; i < 10; ++i) diagnostics.report("point " + std::to_string(i));
  diagnostics.report("point 0", "here");
  EXPECT_EQ(diagnostics.entries()[0].count, 2U);
  EXPECT_EQ(diagnostics.entries()[2].alike, 7U);
}

TEST(Diagnostics, the_last_reason_is_that_of_an_undefined_value) {
  Diagnostics diagnostics;
  EXPECT_EQ(diagnostics.last_reason(), "");
  diagnostics.report_undefined("division by zero");
  diagnostics.report("a remark");
  diagnostics.report("not written", {}, Diagnostics::About::unwritten);
  EXPECT_EQ(diagnostics.last_reason(), "division by zero");
  diagnostics.report("no such file", "a.stl", Diagnostics::About::unreadable);
  EXPECT_EQ(diagnostics.last_reason(), "no such file (a.stl)");
  for (int i = 0; i < 10; ++i) diagnostics.report_undefined("point " + std::to_string(i));
  EXPECT_EQ(diagnostics.last_reason(), "point 9");  // although its text is not kept
  diagnostics.clear();
  EXPECT_EQ(diagnostics.last_reason(), "");
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
