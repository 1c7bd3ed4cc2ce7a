#pragma once

#include <set>

#include "unit/session/random_driver.h"

// Random queries, and what the model answers.
namespace queries::random_queries {

inline const Rows& rows_or_none(RandomDriver& driver, const std::string& name) {
  static const Rows none;
  const Rows* rows = driver.find(name);
  return rows == nullptr ? none : *rows;
}

inline void whole(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  driver.expect_query(name, driver.find(name) != nullptr, text_of(rows_or_none(driver, name)));
}

inline void sums(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  int sum = 0;
  for (const Row& row : rows_or_none(driver, name)) sum += row.value;
  driver.expect_query(name + " feed sum[V]", driver.find(name) != nullptr, std::to_string(sum));
}

inline void groups(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  std::map<int, std::pair<int, int>> found;
  for (const Row& row : rows_or_none(driver, name)) {
    ++found[row.key].first;
    found[row.key].second += row.value;
  }
  std::string text;
  for (const auto& [key, group] : found)
    text += fmt::format("{}({} {} {})", text.empty() ? "" : " ", key, group.first, group.second);
  driver.expect_query(name + " feed sortby[K] groupby[K; N: group count, S: group feed sum[V]] consume",
                      driver.find(name) != nullptr, "(" + text + ")");
}

// Pairs with equal keys, in each of the ways that there are to find them.
inline void join(RandomDriver& driver) {
  static constexpr const char* kJoins[] = {
      "{0} feed {{a}} {1} feed {{b}} hashjoin[K_a, K_b] count",
      "{0} feed {{a}} {1} feed {{b}} itHashJoin[K_a, K_b] count",
      "{0} feed {{a}} {1} feed {{b}} sortmergejoin[K_a, K_b] count",
      "{0} feed {{a}} {1} feed {{b}} symmjoin[.K_a = ..K_b] count",
      "{0} feed {{a}} {1} feed {{b}} product filter[.K_a = .K_b] count",
      "{0} feed {{a}} sortby[K_a] {1} feed {{b}} sortby[K_b] mergejoin[K_a, K_b] count",
      "{0} feed {{a}} loopjoin[fun(t: TUPLE) {1} feed filter[.K = attr(t, K_a)]] count"};
  const std::string left = driver.relation_name();
  const std::string right = driver.relation_name();
  std::size_t pairs = 0;
  for (const Row& a : rows_or_none(driver, left)) pairs += rows_with(rows_or_none(driver, right), a.key, a.key).size();
  driver.expect_query(fmt::format(fmt::runtime(kJoins[driver.below(std::size(kJoins))]), left, right),
                      driver.find(left) != nullptr && driver.find(right) != nullptr, std::to_string(pairs));
}

inline void outer_join(RandomDriver& driver) {
  const std::string left = driver.relation_name();
  const std::string right = driver.relation_name();
  const Rows& left_rows = rows_or_none(driver, left);
  const Rows& right_rows = rows_or_none(driver, right);
  std::size_t count = 0;
  for (const Row& a : left_rows) count += std::max<std::size_t>(1, rows_with(right_rows, a.key, a.key).size());
  for (const Row& b : right_rows) count += rows_with(left_rows, b.key, b.key).empty() ? 1 : 0;
  const char* op = driver.below(2) == 0 ? "smouterjoin[K_a, K_b]" : "symmouterjoin[.K_a = ..K_b]";
  driver.expect_query(fmt::format("{} feed {{a}} {} feed {{b}} {} count", left, right, op),
                      driver.find(left) != nullptr && driver.find(right) != nullptr, std::to_string(count));
}

inline void set_operation(RandomDriver& driver) {
  const std::string left = driver.relation_name();
  const std::string right = driver.relation_name();
  std::set<int> a;
  std::set<int> b;
  for (const Row& row : rows_or_none(driver, left)) a.insert(row.key);
  for (const Row& row : rows_or_none(driver, right)) b.insert(row.key);
  std::vector<int> found;
  const int kind = driver.below(3);
  if (kind == 0) std::ranges::set_union(a, b, std::back_inserter(found));
  if (kind == 1) std::ranges::set_intersection(a, b, std::back_inserter(found));
  if (kind == 2) std::ranges::set_difference(a, b, std::back_inserter(found));
  static constexpr const char* kNames[] = {"mergeunion", "mergesec", "mergediff"};
  std::string text;
  for (const int key : found) text += fmt::format("{}({})", text.empty() ? "" : " ", key);
  driver.expect_query(fmt::format("{} feed project[K] sort rdup {} feed project[K] krduph[K] sort {} consume", left,
                                  right, kNames[kind]),
                      driver.find(left) != nullptr && driver.find(right) != nullptr, "(" + text + ")");
}

inline void sorted(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  Rows copy = rows_or_none(driver, name);
  std::ranges::sort(copy,
                    [](const Row& a, const Row& b) { return a.key != b.key ? a.key < b.key : a.value > b.value; });
  driver.expect_query(name + " feed sortby[K, V desc] consume", driver.find(name) != nullptr, text_of(copy));
}

// An index is the one of its relation, however that has been changed since.
inline void by_index(RandomDriver& driver) {
  const std::string index = driver.index_name();
  const std::string name = driver.relation_name();
  const int low = driver.below(4);
  const int high = driver.below(3) == 0 ? driver.below(4) : low;
  const auto found = driver.model().indexes.find(index);
  const bool is_possible = found != driver.model().indexes.end() && found->second == name;
  Rows rows = rows_with(rows_or_none(driver, name), low, high);
  std::ranges::stable_sort(rows, {}, &Row::key);
  const std::string bracket =
      low == high ? fmt::format("exactmatch[{}]", low) : fmt::format("range[{}, {}]", low, high);
  driver.expect_query(fmt::format("{} {} {} consume", index, name, bracket), is_possible, text_of(rows));
}

inline void derived(RandomDriver& driver) {
  const std::string name = driver.derived_name();
  const auto found = driver.model().derived.find(name);
  const bool is_there = found != driver.model().derived.end();
  driver.expect_query(name, is_there, is_there ? std::to_string(found->second.count) : "");
}

inline void objects(RandomDriver& driver) {
  const std::string name = driver.relation_name();
  driver.expect(fmt::format("if {} > 0 then query 1 else query 0 endif", name + " count"),
                driver.find(name) == nullptr ? "error"
                : driver.find(name)->empty() ? "0"
                                             : "1");
}

// More than a megabyte of tuples: sorting, grouping and hashing go through files. The numbers n * 7919 mod 9973 are all
// different for n below 9973, which is a prime.
inline void with_little_memory(RandomDriver& driver) {
  if (driver.below(8) != 0) return;
  constexpr int kCount = 9000;
  int smallest[3] = {9973, 9973, 9973};
  std::int64_t even = 0;
  for (int n = 1; n <= kCount; ++n) {
    const int number = n * 7919 % 9973;
    even += number % 2 == 0 ? 1 : 0;
    for (int& place : smallest)
      if (number < place) {
        std::copy_backward(&place, std::end(smallest) - 1, std::end(smallest));
        place = number;
        break;
      }
  }
  const std::string source = fmt::format(
      "intstream(1, {}) transformstream extend[M: (.Elem * 7919) mod 9973, "
      "T: \"a text that takes some memory, so that the limit is reached before the end of the stream\"]",
      kCount);
  driver.expect("set \"memory\" = 1", "");
  switch (driver.below(4)) {
    case 0:
      driver.expect("query " + source + " sortby[M] head[3] project[M] consume",
                    fmt::format("(({}) ({}) ({}))", smallest[0], smallest[1], smallest[2]));
      break;
    case 1:
      driver.expect("query " + source + " extend[P: .M mod 2] sortby[P] groupby[P; N: group count] consume",
                    fmt::format("((0 {}) (1 {}))", even, kCount - even));
      break;
    case 2:
      driver.expect(fmt::format("query {0} {{a}} {0} {{b}} hashjoin[M_a, Elem_b] filter[.Elem_a = .M_b] count", source),
                    [&] {
                      int count = 0;
                      for (int n = 1; n <= kCount; ++n) {
                        const int m = n * 7919 % 9973;
                        count += m >= 1 && m <= kCount && m * 7919 % 9973 == n ? 1 : 0;
                      }
                      return std::to_string(count);
                    }());
      break;
    default:
      driver.expect("query " + source + " krduph[M] count", std::to_string(kCount));
  }
  if (driver.below(2) == 0) driver.expect("set \"memory\" = 500", "");
}

inline constexpr RandomStep kSteps[] = {
    {3, whole},  {1, sums},     {1, groups},  {3, join},    {1, outer_join},        {1, set_operation},
    {1, sorted}, {4, by_index}, {2, derived}, {1, objects}, {1, with_little_memory}};

}  // namespace queries::random_queries
