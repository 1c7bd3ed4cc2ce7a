#include "rtree/nodes.h"

#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

Box3 box_around(const std::vector<NodeSummary>& nodes, std::uint32_t depth) {
  Box3 box;
  for (const NodeSummary& node : nodes)
    if (node.depth == depth) box.extend(node.box);
  return box;
}

TEST(Nodes, an_empty_tree_has_none) {
  EXPECT_TRUE(nodes_of(samples::Tree()).empty());
}

TEST(Nodes, of_one_entry_are_a_leaf) {
  const Box3 box{{0, 1, 2}, {0.1, 1.1, 2.1}};
  samples::Tree tree;
  tree.insert(box, 7);
  const auto nodes = nodes_of(tree);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0].depth, 0U);
  EXPECT_TRUE(nodes[0].is_leaf);
  EXPECT_EQ(nodes[0].member_count, 1U);
  EXPECT_EQ(nodes[0].box, box);
}

// The sums and unions of each level are those of the entries, which are known without the tree.
TEST(Nodes, each_level_holds_all_entries) {
  for (const samples::Kind kind : samples::kKinds) {
    const samples::Entries entries = samples::random_entries(3000, kind, 1);
    Box3 all;
    for (const auto& entry : entries) all.extend(entry.box);
    for (const samples::Tree& tree : {samples::Tree::bulk_load(entries), samples::inserted(entries)}) {
      const auto nodes = nodes_of(tree);
      std::map<std::uint32_t, std::size_t> nodes_at, members_at;
      for (const NodeSummary& node : nodes) {
        ++nodes_at[node.depth];
        members_at[node.depth] += node.member_count;
        EXPECT_EQ(node.is_leaf, node.depth == nodes.back().depth);
      }
      const std::uint32_t deepest = nodes.back().depth;
      EXPECT_EQ(nodes_at[0], 1U);
      EXPECT_EQ(members_at[deepest], entries.size());
      for (std::uint32_t depth = 0; depth <= deepest; ++depth) {
        EXPECT_EQ(box_around(nodes, depth), all);
        if (depth == deepest) continue;
        EXPECT_EQ(members_at[depth], nodes_at[depth + 1]);
      }
    }
  }
}

// Nodes that come after a node and lie deeper are below it.
TEST(Nodes, boxes_of_parents_are_those_around_their_children) {
  const samples::Entries entries = samples::random_entries(3000, samples::Kind::clustered, 2);
  const auto nodes = nodes_of(samples::Tree::bulk_load(entries));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].is_leaf) continue;
    Box3 children;
    std::size_t count = 0;
    for (std::size_t j = i + 1; j < nodes.size() && nodes[j].depth > nodes[i].depth; ++j) {
      if (nodes[j].depth != nodes[i].depth + 1) continue;
      children.extend(nodes[j].box);
      ++count;
    }
    EXPECT_EQ(children, nodes[i].box);
    EXPECT_EQ(count, nodes[i].member_count);
  }
}

}  // namespace
}  // namespace rtree
