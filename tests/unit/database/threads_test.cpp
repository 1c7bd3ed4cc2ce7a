// Cancelling, progress, several databases and several threads.
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "algebra3d/database/database.h"

namespace algebra3d::database {
namespace {

using namespace std::chrono_literals;

// Pairs of 30,000 boxes that all meet each other: 900 million, which takes minutes.
constexpr const char* kLongJoin =
    "query intstream(1, 30000) transformstream extend[B: rectangle3(0.0, 1.0, 0.0, 1.0, 0.0, 1.0)] {a} "
    "intstream(1, 30000) transformstream extend[B: rectangle3(0.0, 1.0, 0.0, 1.0, 0.0, 1.0)] {b} "
    "itSpatialJoin[B_a, B_b] count";

Database with_numbers(int count) {
  Database database = *Database::temporary();
  const Status status =
      database.execute("let Numbers = intstream(1, $count) transformstream consume", {{"count", count}});
  EXPECT_TRUE(status.ok()) << status.error().message;
  return database;
}

TEST(DatabaseThreads, another_thread_cancels_a_long_join) {
  Database database = *Database::temporary();
  std::jthread canceller([&] {
    std::this_thread::sleep_for(200ms);
    database.cancel();
  });
  const Result<Value> count = database.value(kLongJoin);
  ASSERT_FALSE(count.ok());
  EXPECT_EQ(count.error().code, ErrorCode::interrupted);
  canceller.join();
  database.cancel();  // nothing runs: no effect on what follows
  EXPECT_EQ(*database.value("query 1 + 1"), Value(2));
}

TEST(DatabaseThreads, cancelling_ends_rows_that_are_read) {
  Database database = with_numbers(10);
  Result<Rows> rows = database.query("query intstream(1, 1000000000000)");
  ASSERT_TRUE(rows.ok());
  ASSERT_TRUE(rows->next()->has_value());
  database.cancel();
  const Status status = rows->for_each([](const Row&) {});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
  EXPECT_EQ(rows->next().error().code, ErrorCode::interrupted);  // for good
  EXPECT_EQ(*database.value("query Numbers count"), Value(10));
}

TEST(DatabaseThreads, destroying_rows_ends_their_statement_and_undoes_it) {
  Database database = with_numbers(10000);
  {
    Result<Rows> rows = database.query("query Numbers feed Numbers deletedirect");
    ASSERT_TRUE(rows->next()->has_value());
    EXPECT_EQ(database.value("query 1").error().code, ErrorCode::wrong_usage);  // one statement at a time
  }
  EXPECT_EQ(*database.value("query Numbers count"), Value(10000));
  Result<Rows> rows = database.query("query Numbers");
  rows->close();
  EXPECT_FALSE(rows->next()->has_value());
}

TEST(DatabaseThreads, progress_comes_in_the_thread_that_waits) {
  Database database = with_numbers(10);
  std::vector<std::string> heard;
  bool is_here = true;
  const auto own = std::this_thread::get_id();
  database.on_progress([&](const std::string& how_far) {
    heard.push_back(how_far);
    is_here = is_here && std::this_thread::get_id() == own;
  });
  ASSERT_TRUE(database.execute("check database").ok());
  EXPECT_FALSE(heard.empty());
  EXPECT_TRUE(is_here);
  database.on_progress({});
  const std::size_t before = heard.size();
  ASSERT_TRUE(database.execute("check database").ok());
  EXPECT_EQ(heard.size(), before);
}

TEST(DatabaseThreads, one_database_is_used_by_one_thread_after_another) {
  Database database = with_numbers(10);
  for (int i = 0; i < 4; ++i)
    std::jthread([&] {
      EXPECT_EQ(*database.value("query Numbers count"), Value(10 + i));
      ASSERT_TRUE(database.execute("query Numbers feed head[1] Numbers insert count").ok());
    }).join();
  EXPECT_EQ(*database.value("query Numbers count"), Value(14));
}

TEST(DatabaseThreads, two_databases_work_at_the_same_time) {
  Database first = with_numbers(100), second = with_numbers(200);
  Result<Rows> one = first.query("query Numbers"), two = second.query("query Numbers");
  std::size_t count = 0;
  while (true) {
    const auto a = *one->next(), b = *two->next();
    if (!b) break;
    ++count;
    EXPECT_EQ(a.has_value(), count <= 100);
  }
  EXPECT_EQ(count, 200U);
  std::atomic<int> right = 0;
  {
    std::vector<std::jthread> threads;
    for (Database* database : {&first, &second})
      threads.emplace_back([&right, database] {
        for (int i = 0; i < 20; ++i) right += database->value("query Numbers feed sum[Elem]").ok();
      });
  }
  EXPECT_EQ(right, 40);
}

TEST(DatabaseThreads, two_databases_share_a_file) {
  Database writer = with_numbers(10);
  Database reader = *Database::open(writer.file());
  Result<Rows> rows = reader.query("query Numbers");  // holds the state of its beginning
  ASSERT_TRUE(rows->next()->has_value());
  ASSERT_TRUE(writer.execute("query Numbers feed Numbers insert count").ok());
  EXPECT_EQ(rows->all()->size(), 9U);
  EXPECT_EQ(*reader.value("query Numbers count"), Value(20));
}

}  // namespace
}  // namespace algebra3d::database
