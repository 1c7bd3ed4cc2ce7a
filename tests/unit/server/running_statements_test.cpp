#include "queries/server/detail/running_statements.h"

#include <algorithm>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace {

// Statements that begin within a microsecond of each other: an order by how long they have run changes while it is
// made.
TEST(RunningStatements, AreListedInTheOrderInWhichTheyBegan) {
  constexpr int kStatements = 500;
  constexpr int kLists = 2000;
  queries::RunningStatements running;
  for (int i = 0; i < kStatements; ++i)
    ASSERT_TRUE(running.add(std::make_shared<queries::Execution>(
        queries::StatementRequest{.id = running.new_id(), .text = "query 1"}, algebra3d::WorkingFolder())));
  for (int i = 0; i < kLists; ++i) {
    const auto listed = running.list();
    ASSERT_EQ(listed.size(), kStatements);
    ASSERT_TRUE(std::ranges::is_sorted(listed, {}, [](const auto& execution) { return execution->start(); }));
  }
}

}  // namespace
