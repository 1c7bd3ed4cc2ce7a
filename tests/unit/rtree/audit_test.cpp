#include <gtest/gtest.h>

#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using Nodes = Storage<ExactLeaf<std::uint64_t>>;

Nodes sound_nodes() {
  return samples::Tree::bulk_load(samples::random_entries(300, samples::Kind::uniform, 1)).storage();
}

void expect_complaint(const Nodes& nodes, const std::string& text) {
  const auto problems = audit(nodes);
  EXPECT_TRUE(
      std::ranges::any_of(problems, [&](const auto& problem) { return problem.find(text) != std::string::npos; }))
      << "expected: " << text << "\nfirst of " << problems.size() << ": " << (problems.empty() ? "" : problems[0]);
}

NodeIndex some_leaf(const Nodes& nodes) {
  NodeIndex node = nodes.root;
  for (std::uint32_t level = nodes.height; level > 0; --level) node = nodes.inner[node].reference[0];
  return node;
}

TEST(Audit, sound_nodes_have_no_problems) {
  EXPECT_EQ(audit(sound_nodes()), std::vector<std::string>{});
}

TEST(Audit, finds_a_box_that_is_not_the_union) {
  Nodes nodes = sound_nodes();
  nodes.inner[nodes.root].max[1][0] += 1;
  expect_complaint(nodes, "the box is not the union of the boxes of inner node");
}

TEST(Audit, finds_wrong_counts) {
  Nodes nodes = sound_nodes();
  ++nodes.entry_count;
  expect_complaint(nodes, "300 entries in leaves, but the count says 301");
  nodes = sound_nodes();
  for (std::size_t slot = 3; slot < kFanOut; ++slot) static_cast<KeyBoxes&>(nodes.leaves[some_leaf(nodes)]).clear(slot);
  expect_complaint(nodes, "has 3 slots in use, at least 6 are expected");
}

TEST(Audit, finds_unreachable_and_twice_reached_nodes) {
  Nodes nodes = sound_nodes();
  nodes.add_node(0);
  expect_complaint(nodes, "leaf 19 is neither reachable nor free");
  nodes = sound_nodes();
  nodes.add_node(1);
  expect_complaint(nodes, "inner node 3 is neither reachable nor free");
  nodes = sound_nodes();
  nodes.free_leaf = some_leaf(nodes);
  expect_complaint(nodes, "is in use or listed twice");
  nodes.free_leaf = 999'999;
  expect_complaint(nodes, "free leaf 999999 does not exist");
  nodes = sound_nodes();
  nodes.inner[nodes.root].reference[1] = nodes.inner[nodes.root].reference[0];
  expect_complaint(nodes, "is reached more than once");
}

TEST(Audit, finds_free_nodes_that_are_linked_wrongly) {
  Nodes nodes = sound_nodes();
  const NodeIndex first = nodes.add_node(0), second = nodes.add_node(0);
  nodes.free_node(first, 0);
  nodes.free_node(second, 0);
  EXPECT_EQ(audit(nodes), std::vector<std::string>{});
  Nodes circle = nodes;
  circle.leaves[first].reference[0] = second;
  expect_complaint(circle, "is in use or listed twice");
  Nodes cut = nodes;
  cut.leaves[second].reference[0] = kNoNode;
  expect_complaint(cut, "leaf 19 is neither reachable nor free");
  nodes.leaves[first].set_box(0, {{0, 0, 0}, {1, 1, 1}});
  expect_complaint(nodes, "free leaf 19 is not clear");
}

TEST(Audit, finds_wrong_references_and_heights) {
  Nodes nodes = sound_nodes();
  nodes.inner[nodes.root].reference[0] = 999'999;
  expect_complaint(nodes, "names inner node 999999, which does not exist");
  nodes = sound_nodes();
  nodes.root = 999'999;
  expect_complaint(nodes, "root 999999 does not exist");
  nodes = sound_nodes();
  nodes.height = 1000;
  expect_complaint(nodes, "a height of 1000 is not possible");
}

TEST(Audit, finds_empty_boxes_and_boxes_in_unused_slots) {
  Nodes nodes = sound_nodes();
  nodes.leaves[some_leaf(nodes)].set_box(2, {{0, 0, 0}, {0, 0, -1}});
  expect_complaint(nodes, "slot 2 holds an empty box");
  nodes = sound_nodes();
  nodes.inner[nodes.root].set_box(5, {{INT32_MAX, 0, 0}, {1, 1, 1}});
  expect_complaint(nodes, "slot 5 is unused but has a box");
}

}  // namespace
}  // namespace rtree
