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
  EXPECT_TRUE(status.ok()) << status.error().text();
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

// Whether the statement could have ended meanwhile makes no difference.
TEST(DatabaseThreads, changes_are_kept_when_the_end_of_the_rows_was_asked_for_and_never_before) {
  Database database = with_numbers(3);
  for (const int taken : {0, 1, 3}) {
    Result<Rows> rows = database.query("query Numbers feed Numbers deletedirect");
    for (int i = 0; i < taken; ++i) ASSERT_TRUE(rows->next()->has_value());
    std::this_thread::sleep_for(30ms);
    rows->close();
    EXPECT_EQ(*database.value("query Numbers count"), Value(3)) << taken;
  }
  {
    Result<Rows> rows = database.query("query Numbers feed Numbers deletedirect count");
    ASSERT_TRUE(rows->next()->has_value());
    std::this_thread::sleep_for(30ms);
  }
  EXPECT_EQ(*database.value("query Numbers count"), Value(3));
  { Result<Rows> rows = database.query("explain query Numbers feed Numbers deletedirect count"); }
  EXPECT_EQ(*database.value("query Numbers count"), Value(3));
  Result<Rows> rows = database.query("query Numbers feed head[1] Numbers deletedirect");
  ASSERT_TRUE(rows->next()->has_value());
  ASSERT_FALSE(rows->next()->has_value());
  rows->close();
  EXPECT_EQ(*database.value("query Numbers count"), Value(2));
  rows = database.query("query Numbers feed Numbers deletedirect");
  for (const Result<Row>& row : *rows) EXPECT_TRUE(row.ok());
  EXPECT_EQ(*database.value("query Numbers count"), Value(0));
}

TEST(DatabaseThreads, cancelling_before_the_end_is_asked_for_undoes_the_statement) {
  Database database = with_numbers(1);
  Result<Rows> rows = database.query("query Numbers feed Numbers deletedirect");
  ASSERT_TRUE(rows->next()->has_value());
  std::this_thread::sleep_for(30ms);
  database.cancel();
  EXPECT_EQ(rows->next().error().code, ErrorCode::interrupted);
  EXPECT_EQ(*database.value("query Numbers count"), Value(1));
}

TEST(DatabaseThreads, cancelling_ends_the_waiting_for_another_writer) {
  Database writer = with_numbers(10);
  Database other = *Database::open(writer.file());
  ASSERT_TRUE(writer.execute("begin transaction; let a = 1").ok());
  for (const char* statement : {"let b = 2", "begin transaction", "query Numbers feed Numbers deletedirect count"}) {
    const auto start = std::chrono::steady_clock::now();
    std::jthread canceller([&] {
      std::this_thread::sleep_for(200ms);
      other.cancel();
    });
    const Status status = other.execute(statement);
    ASSERT_FALSE(status.ok()) << statement;
    EXPECT_EQ(status.error().code, ErrorCode::interrupted) << status.error().text();
    const auto waited = std::chrono::steady_clock::now() - start;
    EXPECT_GE(waited, 190ms) << statement;
    EXPECT_LT(waited, 2s) << statement;
  }
  ASSERT_TRUE(writer.execute("commit transaction").ok());
  EXPECT_TRUE(other.execute("let b = 2").ok());
}

TEST(DatabaseThreads, a_second_writer_waits_for_the_first_also_in_the_middle_of_its_rows) {
  Database writer = with_numbers(10);
  Database other = *Database::open(writer.file());
  ASSERT_TRUE(writer.execute("begin transaction; let a = 1").ok());
  std::jthread committer([&] {
    std::this_thread::sleep_for(200ms);
    EXPECT_TRUE(writer.execute("commit transaction").ok());
  });
  const auto rows = other.query("query Numbers feed Numbers deletedirect")->all();
  ASSERT_TRUE(rows.ok()) << rows.error().text();
  EXPECT_EQ(rows->size(), 10U);
  EXPECT_EQ(other.report().deleted, 10U);
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
