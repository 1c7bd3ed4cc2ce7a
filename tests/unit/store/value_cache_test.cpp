// What the cache of loaded values keeps when more is asked for than it holds.
#include "queries/store/detail/value_cache.h"

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"

namespace queries {
namespace {

using algebra3d::Value;

ValuePlace place(std::int64_t tuple) {
  return {1, tuple, 0};
}

/// Asks for values as a store does; each takes one byte. Returns how many were in the cache.
std::size_t scan(ValueCache& cache, std::int64_t first, std::int64_t last) {
  std::size_t hits = 0;
  for (std::int64_t tuple = first; tuple < last; ++tuple) {
    if (cache.find(place(tuple)))
      ++hits;
    else
      cache.add(place(tuple), Value::of(tuple), 1);
  }
  return hits;
}

TEST(ValueCache, keeps_all_that_fits) {
  ValueCache cache(1000);
  EXPECT_EQ(scan(cache, 0, 1000), 0U);
  EXPECT_EQ(scan(cache, 0, 1000), 1000U);
  EXPECT_EQ(cache.bytes(), 1000U);
}

TEST(ValueCache, serves_scans_of_more_than_it_holds) {
  ValueCache cache(1000);
  scan(cache, 0, 2000);
  for (int round = 0; round < 5; ++round) EXPECT_GE(scan(cache, 0, 2000), 700U);
  EXPECT_EQ(cache.bytes(), 1000U);
}

TEST(ValueCache, keeps_what_is_used_beside_a_long_scan) {
  ValueCache cache(1000);
  scan(cache, 0, 200);
  EXPECT_EQ(scan(cache, 0, 200), 200U);
  scan(cache, 1000, 5000);
  EXPECT_EQ(scan(cache, 0, 200), 200U);
}

TEST(ValueCache, forgets_what_is_no_longer_used) {
  ValueCache cache(1000);
  for (int round = 0; round < 2; ++round) scan(cache, 0, 900);
  for (int round = 0; round < 20; ++round) scan(cache, 10'000, 12'000);
  EXPECT_GE(scan(cache, 10'000, 12'000), 600U);
}

TEST(ValueCache, keeps_a_value_that_is_larger_than_itself) {
  ValueCache cache(10);
  cache.add(place(1), Value::of(1), 5);
  cache.add(place(2), Value::of(2), 100);
  EXPECT_TRUE(cache.find(place(2)));
  EXPECT_FALSE(cache.find(place(1)));
  cache.add(place(3), Value::of(3), 5);
  EXPECT_TRUE(cache.find(place(3)));
  EXPECT_EQ(cache.bytes(), 5U);
}

TEST(ValueCache, erases_tuples_and_tables) {
  ValueCache cache(100);
  for (std::int64_t tuple = 0; tuple < 10; ++tuple) {
    cache.add({1, tuple, 0}, Value::of(tuple), 1);
    cache.add({2, tuple, 0}, Value::of(tuple), 1);
  }
  cache.erase(1, 3);
  EXPECT_FALSE(cache.find(place(3)));
  EXPECT_TRUE(cache.find(place(4)));
  cache.erase_table(1);
  EXPECT_FALSE(cache.find(place(4)));
  EXPECT_EQ(cache.bytes(), 10U);
  cache.clear();
  EXPECT_EQ(cache.bytes(), 0U);
}

}  // namespace
}  // namespace queries
