#include <gtest/gtest.h>

#include "unit/rtree/rtree_samples.h"

namespace rtree {
namespace {

using Nodes = Storage<std::uint64_t>;

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
  while (nodes.infos[node].level > 0) node = nodes.nodes[node].child(0);
  return node;
}

TEST(Audit, sound_nodes_have_no_problems) {
  EXPECT_EQ(audit(sound_nodes()), std::vector<std::string>{});
}

TEST(Audit, finds_a_box_that_is_not_the_union) {
  Nodes nodes = sound_nodes();
  nodes.nodes[nodes.root].max[1][0] += 1;
  expect_complaint(nodes, "the box is not the union of the boxes of child");
}

TEST(Audit, finds_wrong_counts) {
  Nodes nodes = sound_nodes();
  ++nodes.entry_count;
  expect_complaint(nodes, "300 entries in leaves, but the count says 301");
  nodes = sound_nodes();
  nodes.infos[some_leaf(nodes)].count = 3;
  expect_complaint(nodes, "has 3 slots in use, at least 6 are expected");
  nodes.infos[some_leaf(nodes)].count = 17;
  expect_complaint(nodes, "has 17 slots in use, at most 16 are possible");
}

TEST(Audit, finds_unreachable_and_twice_reached_nodes) {
  Nodes nodes = sound_nodes();
  nodes.add_node(0);
  expect_complaint(nodes, "is neither reachable nor free");
  nodes = sound_nodes();
  nodes.free_nodes.push_back(some_leaf(nodes));
  expect_complaint(nodes, "is in use or listed twice");
  nodes = sound_nodes();
  nodes.nodes[nodes.root].reference[1] = nodes.nodes[nodes.root].reference[0];
  expect_complaint(nodes, "is reached more than once");
}

TEST(Audit, finds_wrong_parents_levels_and_references) {
  Nodes nodes = sound_nodes();
  nodes.infos[some_leaf(nodes)].parent = nodes.root;
  expect_complaint(nodes, "as its parent, not");
  nodes = sound_nodes();
  nodes.infos[some_leaf(nodes)].level = 1;
  expect_complaint(nodes, "of level 1 has child");
  nodes = sound_nodes();
  nodes.nodes[nodes.root].reference[0] = 999'999;
  expect_complaint(nodes, "which does not exist");
}

TEST(Audit, finds_empty_boxes_and_boxes_in_unused_slots) {
  Nodes nodes = sound_nodes();
  nodes.nodes[some_leaf(nodes)].set_box(2, Box3{});
  expect_complaint(nodes, "slot 2 holds an empty box");
  nodes = sound_nodes();
  const std::size_t unused = nodes.infos[nodes.root].count;
  nodes.nodes[nodes.root].set_box(unused, {{0, 0, 0}, {1, 1, 1}});
  expect_complaint(nodes, "is unused but has a box");
}

}  // namespace
}  // namespace rtree
