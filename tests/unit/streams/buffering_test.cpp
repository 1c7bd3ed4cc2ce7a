// What keeps tuples: buffers, sorting, hash tables, groups and merge joins, against loops over plain tables.
#include <algorithm>
#include <atomic>
#include <random>

#include "queries/streams/detail/adjacent_groups.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/hash_table.h"
#include "queries/streams/detail/merge_join.h"
#include "queries/streams/detail/sorting.h"
#include "support/rounds.h"
#include "unit/streams/stream_fixture.h"

namespace queries {
namespace {

class Buffering : public StreamTest {
 protected:
  Row random_row() {
    const auto key = static_cast<std::int64_t>(random_() % 12);
    return {key == 0 ? std::nullopt : std::optional(key), static_cast<std::int64_t>(++serial_)};
  }
  Rows random_rows(std::size_t count) {
    Rows result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(random_row());
    return result;
  }
  static TypeExpr type(const char* key, const char* serial) {
    return TypeExpr::tuple({{key, TypeExpr("int")}, {serial, TypeExpr("int")}});
  }

 private:
  std::mt19937 random_{3};
  std::int64_t serial_ = 0;
};

TEST_F(Buffering, a_buffer_is_read_any_number_of_times) {
  const Rows table = random_rows(50);
  const auto buffer = buffered(*stream(table), context);
  ASSERT_TRUE(buffer.ok());
  EXPECT_EQ(buffer->size(), 50U);
  const TupleStreamPtr first = buffer->scan();
  EXPECT_EQ(rows(*buffer->scan()), table);
  EXPECT_EQ(rows(*first), table);
}

TEST_F(Buffering, sorting_is_stable_and_puts_undefined_first) {
  Rows table = random_rows(300);
  const auto result = sorted(*stream(table), {{0, false}}, context);
  ASSERT_TRUE(result.ok());
  // std::nullopt comes before every number, as undefined does.
  std::ranges::stable_sort(table, [](const Row& a, const Row& b) { return a[0] < b[0]; });
  EXPECT_EQ(rows(**result), table);
}

TEST_F(Buffering, sorting_many_blocks_is_stable) {
  // A block holds 2^17 rows.
  Rows table = random_rows(algebra3d::is_thorough() ? 400'000 : 140'000);
  const auto result = sorted(*stream(table), {{0, false}}, context);
  ASSERT_TRUE(result.ok());
  std::ranges::stable_sort(table, [](const Row& a, const Row& b) { return a[0] < b[0]; });
  EXPECT_EQ(rows(**result), table);
}

TEST_F(Buffering, sorting_can_be_ended) {
  const std::atomic<bool> cancel = true;
  context.cancel = &cancel;
  EXPECT_FALSE(sorted(*stream(random_rows(500)), {{0, false}}, context).ok());
}

TEST_F(Buffering, sorting_descends_where_it_is_asked_to) {
  Rows table = random_rows(300);
  const auto result = sorted(*stream(table), {{0, true}, {1, false}}, context);
  ASSERT_TRUE(result.ok());
  std::ranges::stable_sort(table, [](const Row& a, const Row& b) { return a[0] != b[0] ? a[0] > b[0] : a[1] < b[1]; });
  EXPECT_EQ(rows(**result), table);
}

TEST_F(Buffering, a_hash_table_finds_what_a_loop_finds) {
  const Rows table = random_rows(300);
  HashTable hash_table(0, 0, context);
  StreamBlocks parts(stream(table));
  const auto is_last = parts.fill(hash_table, context);
  ASSERT_TRUE(is_last.ok() && *is_last);
  hash_table.finish();
  for (std::int64_t number = 0; number < 14; ++number) {
    Rows expected;
    for (const Row& each : table)
      if (each[0] == number) expected.push_back(each);
    std::vector<TuplePtr> partners;
    ASSERT_TRUE(hash_table.find(Tuple{{Value::of(number)}}, partners).ok());
    Rows found;
    for (const TuplePtr& tuple : partners) found.push_back(row(*tuple));
    EXPECT_EQ(found, expected);
  }
}

TEST_F(Buffering, keys_are_new_once) {
  using Answer = SeenKeys::Answer;
  SeenKeys seen(context);
  const Value undefined(algebra3d::TypeOf<std::int64_t>::type());
  EXPECT_EQ(seen.add({Value::of(1), undefined}), Answer::is_new);
  EXPECT_EQ(seen.add({Value::of(1), undefined}), Answer::was_seen);
  EXPECT_EQ(seen.add({undefined, Value::of(1)}), Answer::is_new);
  EXPECT_EQ(seen.add({Value::of(1), Value::of(1)}), Answer::is_new);
}

TEST_F(Buffering, groups_are_runs_of_equal_keys) {
  AdjacentGroups groups(stream({{1, 1}, {1, 2}, {{}, 3}, {{}, 4}, {1, 5}}), {0});
  std::vector<Rows> found;
  while (true) {
    const auto group = groups.next(context);
    ASSERT_TRUE(group.ok());
    if (!*group) break;
    found.push_back(rows(*(*group)->tuples.scan()));
  }
  EXPECT_EQ(found, (std::vector<Rows>{{{1, 1}, {1, 2}}, {{{}, 3}, {{}, 4}}, {{1, 5}}}));
}

TEST_F(Buffering, a_merge_join_gives_what_two_loops_give) {
  for (const bool is_outer : {false, true}) {
    Rows left = random_rows(80);
    Rows right = random_rows(60);
    std::ranges::sort(left);
    std::ranges::sort(right);
    Rows expected;
    for (const Row& a : left) {
      bool is_alone = true;
      for (const Row& b : right) {
        if (!a[0] || a[0] != b[0]) continue;
        expected.push_back({a[0], a[1], b[0], b[1]});
        is_alone = false;
      }
      if (is_outer && is_alone) expected.push_back({a[0], a[1], {}, {}});
    }
    for (const Row& b : right) {
      const bool is_alone = !b[0] || std::ranges::none_of(left, [&](const Row& a) { return a[0] == b[0]; });
      if (is_outer && is_alone) expected.push_back({{}, {}, b[0], b[1]});
    }
    const MergeJoinParameters parameters{{type("A", "X"), type("B", "Y"), {}}, {0, 0}, is_outer, "join"};
    Rows found = rows(*merge_join(stream(left), stream(right), parameters, context));
    std::ranges::sort(found);
    std::ranges::sort(expected);
    EXPECT_EQ(found, expected) << is_outer;
  }
}

TEST_F(Buffering, a_merge_join_refuses_what_is_not_sorted) {
  const MergeJoinParameters parameters{{type("A", "X"), type("B", "Y"), {}}, {0, 0}, false, "join"};
  const TupleStreamPtr joined = merge_join(stream({{1, 1}}), stream({{2, 1}, {1, 2}}), parameters, context);
  const auto next = joined->next();
  ASSERT_FALSE(next.ok());
  EXPECT_EQ(next.error().text(), "join: the second stream is not sorted by B; write `sortby[B]`, or use sortmergejoin");
}

}  // namespace
}  // namespace queries
