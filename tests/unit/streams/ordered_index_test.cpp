// The ordered index against a plain list of its entries.
#include "queries/streams/ordered_index.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"

namespace queries {
namespace {

Value key(std::int64_t number) {
  return Value::of(number);
}

/// The oracle: numbers and ids in a vector that is searched from end to end.
class PlainIndex {
 public:
  void insert(std::int64_t number, TupleId id) {
    if (std::ranges::find(entries_, std::pair(number, id)) == entries_.end()) entries_.emplace_back(number, id);
  }
  void erase(std::int64_t number, TupleId id) { std::erase(entries_, std::pair(number, id)); }
  std::size_t size() const { return entries_.size(); }
  std::vector<TupleId> range(std::optional<std::int64_t> low, std::optional<std::int64_t> high) const {
    std::vector<std::pair<std::int64_t, TupleId>> found;
    for (const auto& entry : entries_)
      if ((!low || *low <= entry.first) && (!high || entry.first <= *high)) found.push_back(entry);
    std::ranges::sort(found);
    std::vector<TupleId> ids;
    for (const auto& entry : found) ids.push_back(entry.second);
    return ids;
  }
  std::vector<OrderedTree::Entry> entries() const {
    std::vector<OrderedTree::Entry> result;
    for (const auto& [number, id] : entries_) result.push_back({key(number), id});
    return result;
  }

 private:
  std::vector<std::pair<std::int64_t, TupleId>> entries_;
};

void expect_same(const OrderedTree& tree, const PlainIndex& plain) {
  EXPECT_EQ(*tree.size(), plain.size());
  EXPECT_EQ(*tree.range({}, {}), plain.range({}, {}));
  for (std::int64_t low = -1; low <= 20; low += 3) {
    EXPECT_EQ(*tree.range(key(low), {}), plain.range(low, {}));
    EXPECT_EQ(*tree.range({}, key(low)), plain.range({}, low));
    for (std::int64_t high = low - 1; high <= 20; high += 4)
      EXPECT_EQ(*tree.range(key(low), key(high)), plain.range(low, high));
  }
}

TEST(OrderedTree, is_empty_at_first) {
  expect_same(OrderedTree(), PlainIndex());
}

TEST(OrderedTree, follows_insertions_and_erasures) {
  std::mt19937 random(7);
  OrderedTree tree;
  PlainIndex plain;
  for (int step = 0; step < 2000; ++step) {
    const auto number = static_cast<std::int64_t>(random() % 20);
    const auto id = static_cast<TupleId>(1 + random() % 30);
    if (random() % 3 == 0) {
      tree.erase(key(number), id);
      plain.erase(number, id);
    } else {
      tree.insert(key(number), id);
      plain.insert(number, id);
    }
    if (step % 200 == 0) expect_same(tree, plain);
  }
  expect_same(tree, plain);
}

TEST(OrderedTree, bulk_load_equals_insertion) {
  std::mt19937 random(11);
  PlainIndex plain;
  for (int step = 0; step < 500; ++step)
    plain.insert(static_cast<std::int64_t>(random() % 20), static_cast<TupleId>(1 + random() % 100));
  expect_same(OrderedTree::bulk_load(plain.entries()), plain);
}

TEST(OrderedTree, a_copy_is_a_tree_of_its_own) {
  OrderedTree tree;
  tree.insert(key(1), 1);
  const OrderedTree copy = tree;
  tree.insert(key(2), 2);
  tree.erase(key(1), 1);
  EXPECT_EQ(*copy.range({}, {}), std::vector<TupleId>{1});
  EXPECT_EQ(*tree.range({}, {}), std::vector<TupleId>{2});
}

TEST(OrderedTree, entries_come_in_order) {
  OrderedTree tree;
  tree.insert(key(5), 1);
  tree.insert(key(3), 9);
  tree.insert(key(3), 2);
  std::vector<std::pair<std::int64_t, TupleId>> found;
  for (const auto& entry : tree.entries()) found.emplace_back(entry.key.get<std::int64_t>(), entry.id);
  EXPECT_EQ(found, (std::vector<std::pair<std::int64_t, TupleId>>{{3, 2}, {3, 9}, {5, 1}}));
}

}  // namespace
}  // namespace queries
