// Ninth stage: the result, in four steps. The unions are worked out by hand.
#include "algebra3d/kernel/arrangement/detail/build_result_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/classification.h"
#include "algebra3d/kernel/arrangement/detail/pseudo_nodes.h"
#include "algebra3d/kernel/arrangement/detail/regions.h"
#include "algebra3d/kernel/halfedge/audit.h"
#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

/// The sub-facets and patches of boxes that their union keeps.
Selection union_of(const Subdivision& subdivision, const WindingJumps& jumps, const Classification& fronts) {
  const auto keep = [](const WindingVector& front, const WindingVector& back) {
    return static_cast<int>(back != WindingVector()) - static_cast<int>(front != WindingVector());
  };
  const auto keep_side = [&](SubEdgeSide side) {
    return jumps[side] == WindingVector() ? 0 : keep(fronts.at_sides[side], fronts.at_sides[side] + jumps[side]);
  };
  const auto keep_patch = [&](PatchId patch) {
    const std::size_t group = subdivision.operands.group(subdivision.patches[patch].operand);
    return keep(fronts.at_patches[patch], fronts.at_patches[patch] + WindingVector::of_group(group, 1));
  };
  return Selection::of(subdivision, keep_side, keep_patch);
}

/// The steps of the stage, for the union of two boxes. Refers to the boxes.
class UnionSteps {
 public:
  explicit UnionSteps(const stages::Boxes& boxes)
      : subdivision(boxes.subdivision()),
        jumps_(winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges)),
        fronts_(classify(subdivision, jumps_, Closure::each, {}).value()),
        selection(union_of(subdivision, jumps_, fronts_)) {
    edges = region_edges(subdivision, selection);
    pseudo_nodes = find_pseudo_nodes(subdivision, edges, PatchCorners(subdivision, selection.patches));
    straight = straightened(edges, pseudo_nodes);
    regions = triangulate_regions(subdivision, straight).value();
  }
  UnionSteps(const UnionSteps&) = delete;
  UnionSteps& operator=(const UnionSteps&) = delete;

  std::string plane_text(const RegionKey& region) const {
    return stages::text(subdivision.facets.planes[region.plane()]);
  }

  Subdivision subdivision;

 private:
  WindingJumps jumps_;
  Classification fronts_;

 public:
  Selection selection;
  std::vector<RegionEdge> edges;
  std::vector<PseudoNode> pseudo_nodes;
  std::vector<RegionEdge> straight;
  Regions regions;
};

/// "x=4: (4 0 0)-(4 0 4) (4 0 0)-(4 4 0)": the edges of each region, without their direction.
Lines text(const UnionSteps& steps, const std::vector<RegionEdge>& edges) {
  std::map<RegionKey, Lines> by_region;
  for (const auto& [region, from, to] : edges)
    by_region[region].push_back(stages::line(steps.subdivision.complex.nodes, from, to));
  Lines lines;
  for (const auto& [region, of_region] : by_region)
    lines.push_back(fmt::format("{}: {}", steps.plane_text(region), fmt::join(stages::sorted(of_region), " ")));
  return stages::sorted(std::move(lines));
}

/// "(2 0 0) in (0 0 0)-(4 0 0) of y=0"
Lines pseudo_nodes_text(const UnionSteps& steps) {
  const NodePool& nodes = steps.subdivision.complex.nodes;
  Lines lines;
  for (const auto& [node, region, before, after] : steps.pseudo_nodes)
    lines.push_back(stages::text(nodes, node) + " in " + stages::line(nodes, before, after) + " of " +
                    steps.plane_text(region));
  return stages::sorted(std::move(lines));
}

struct Counts {
  std::size_t region_triangles, faces, vertices;

  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts counts(const UnionSteps& steps) {
  const TriangleMesh mesh = build_result_mesh(steps.subdivision, steps.selection).value();
  return {steps.regions.triangles.size(), mesh.face_count(), mesh.vertex_count()};
}

void expect_audited(const UnionSteps& steps) {
  EXPECT_EQ(audit(steps.subdivision, steps.edges), Lines());
  EXPECT_EQ(audit(steps.subdivision, steps.pseudo_nodes), Lines());
  EXPECT_EQ(audit(steps.subdivision, steps.straight), Lines());
  EXPECT_EQ(audit(steps.subdivision, steps.straight, steps.regions), Lines());
}

TEST(BuildResultMesh, of_crossing_cubes) {
  const stages::CrossingCubes boxes;
  const UnionSteps steps(boxes);
  // Of each side that crosses, an angle is left.
  const Lines expected = {
      "x=2: (2 2 4)-(2 2 6) (2 2 4)-(2 4 4) (2 2 6)-(2 6 6) (2 4 2)-(2 4 4) (2 4 2)-(2 6 2) (2 6 2)-(2 6 6)",
      "x=4: (4 0 0)-(4 0 4) (4 0 0)-(4 4 0) (4 0 4)-(4 2 4) (4 2 2)-(4 2 4) (4 2 2)-(4 4 2) (4 4 0)-(4 4 2)",
      "y=2: (2 2 4)-(2 2 6) (2 2 4)-(4 2 4) (2 2 6)-(6 2 6) (4 2 2)-(4 2 4) (4 2 2)-(6 2 2) (6 2 2)-(6 2 6)",
      "y=4: (0 4 0)-(0 4 4) (0 4 0)-(4 4 0) (0 4 4)-(2 4 4) (2 4 2)-(2 4 4) (2 4 2)-(4 4 2) (4 4 0)-(4 4 2)",
      "z=2: (2 4 2)-(2 6 2) (2 4 2)-(4 4 2) (2 6 2)-(6 6 2) (4 2 2)-(4 4 2) (4 2 2)-(6 2 2) (6 2 2)-(6 6 2)",
      "z=4: (0 0 4)-(0 4 4) (0 0 4)-(4 0 4) (0 4 4)-(2 4 4) (2 2 4)-(2 4 4) (2 2 4)-(4 2 4) (4 0 4)-(4 2 4)"};
  EXPECT_EQ(text(steps, steps.edges), expected);
  EXPECT_EQ(pseudo_nodes_text(steps), Lines());
  EXPECT_EQ(text(steps, steps.straight), expected);
  // Six angles of four triangles, and six faces of each cube.
  EXPECT_EQ(counts(steps), (Counts{24, 36, 20}));
  expect_audited(steps);
}

TEST(BuildResultMesh, of_a_shared_face) {
  const stages::SharedFace boxes;
  const UnionSteps steps(boxes);
  EXPECT_EQ(
      text(steps, steps.edges),
      (Lines{"y=0: (0 0 0)-(0 0 2) (0 0 0)-(2 0 0) (0 0 2)-(2 0 2) (2 0 0)-(4 0 0) (2 0 2)-(4 0 2) (4 0 0)-(4 0 2)",
             "y=2: (0 2 0)-(0 2 2) (0 2 0)-(2 2 0) (0 2 2)-(2 2 2) (2 2 0)-(4 2 0) (2 2 2)-(4 2 2) (4 2 0)-(4 2 2)",
             "z=0: (0 0 0)-(0 2 0) (0 0 0)-(2 0 0) (0 2 0)-(2 2 0) (2 0 0)-(4 0 0) (2 2 0)-(4 2 0) (4 0 0)-(4 2 0)",
             "z=2: (0 0 2)-(0 2 2) (0 0 2)-(2 0 2) (0 2 2)-(2 2 2) (2 0 2)-(4 0 2) (2 2 2)-(4 2 2) (4 0 2)-(4 2 2)"}));
  // Each of the four long edges goes on past the corners of the common square, in both of its faces.
  EXPECT_EQ(pseudo_nodes_text(steps),
            (Lines{"(2 0 0) in (0 0 0)-(4 0 0) of y=0", "(2 0 0) in (0 0 0)-(4 0 0) of z=0",
                   "(2 0 2) in (0 0 2)-(4 0 2) of y=0", "(2 0 2) in (0 0 2)-(4 0 2) of z=2",
                   "(2 2 0) in (0 2 0)-(4 2 0) of y=2", "(2 2 0) in (0 2 0)-(4 2 0) of z=0",
                   "(2 2 2) in (0 2 2)-(4 2 2) of y=2", "(2 2 2) in (0 2 2)-(4 2 2) of z=2"}));
  EXPECT_EQ(text(steps, steps.straight),
            (Lines{"y=0: (0 0 0)-(0 0 2) (0 0 0)-(4 0 0) (0 0 2)-(4 0 2) (4 0 0)-(4 0 2)",
                   "y=2: (0 2 0)-(0 2 2) (0 2 0)-(4 2 0) (0 2 2)-(4 2 2) (4 2 0)-(4 2 2)",
                   "z=0: (0 0 0)-(0 2 0) (0 0 0)-(4 0 0) (0 2 0)-(4 2 0) (4 0 0)-(4 2 0)",
                   "z=2: (0 0 2)-(0 2 2) (0 0 2)-(4 0 2) (0 2 2)-(4 2 2) (4 0 2)-(4 2 2)"}));
  EXPECT_EQ(counts(steps), (Counts{8, 12, 8}));
  expect_audited(steps);
}

TEST(BuildResultMesh, of_a_shared_edge) {
  const stages::SharedEdge boxes;
  const UnionSteps steps(boxes);
  // In the planes of both sides, A and B look in opposite directions; in z=0 and z=2 in one, and touch in a corner.
  const Lines expected = {
      "x=2: (2 0 0)-(2 0 2) (2 0 0)-(2 2 0) (2 0 2)-(2 2 2) (2 2 0)-(2 2 2)",
      "x=2: (2 2 0)-(2 2 2) (2 2 0)-(2 4 0) (2 2 2)-(2 4 2) (2 4 0)-(2 4 2)",
      "y=2: (0 2 0)-(0 2 2) (0 2 0)-(2 2 0) (0 2 2)-(2 2 2) (2 2 0)-(2 2 2)",
      "y=2: (2 2 0)-(2 2 2) (2 2 0)-(4 2 0) (2 2 2)-(4 2 2) (4 2 0)-(4 2 2)",
      "z=0: (0 0 0)-(0 2 0) (0 0 0)-(2 0 0) (0 2 0)-(2 2 0) (2 0 0)-(2 2 0) (2 2 0)-(2 4 0) (2 2 0)-(4 2 0) "
      "(2 4 0)-(4 4 0) (4 2 0)-(4 4 0)",
      "z=2: (0 0 2)-(0 2 2) (0 0 2)-(2 0 2) (0 2 2)-(2 2 2) (2 0 2)-(2 2 2) (2 2 2)-(2 4 2) (2 2 2)-(4 2 2) "
      "(2 4 2)-(4 4 2) (4 2 2)-(4 4 2)"};
  EXPECT_EQ(text(steps, steps.edges), expected);
  EXPECT_EQ(pseudo_nodes_text(steps), Lines());
  EXPECT_EQ(text(steps, steps.straight), expected);
  EXPECT_EQ(counts(steps), (Counts{16, 24, 14}));
  expect_audited(steps);
}

TEST(BuildResultMesh, of_a_shared_vertex) {
  const stages::SharedVertex boxes;
  const UnionSteps steps(boxes);
  const Lines expected = {"x=2: (2 0 0)-(2 0 2) (2 0 0)-(2 2 0) (2 0 2)-(2 2 2) (2 2 0)-(2 2 2)",
                          "x=2: (2 2 2)-(2 2 4) (2 2 2)-(2 4 2) (2 2 4)-(2 4 4) (2 4 2)-(2 4 4)",
                          "y=2: (0 2 0)-(0 2 2) (0 2 0)-(2 2 0) (0 2 2)-(2 2 2) (2 2 0)-(2 2 2)",
                          "y=2: (2 2 2)-(2 2 4) (2 2 2)-(4 2 2) (2 2 4)-(4 2 4) (4 2 2)-(4 2 4)",
                          "z=2: (0 0 2)-(0 2 2) (0 0 2)-(2 0 2) (0 2 2)-(2 2 2) (2 0 2)-(2 2 2)",
                          "z=2: (2 2 2)-(2 4 2) (2 2 2)-(4 2 2) (2 4 2)-(4 4 2) (4 2 2)-(4 4 2)"};
  EXPECT_EQ(text(steps, steps.edges), expected);
  EXPECT_EQ(pseudo_nodes_text(steps), Lines());
  EXPECT_EQ(text(steps, steps.straight), expected);
  EXPECT_EQ(counts(steps), (Counts{12, 24, 15}));
  expect_audited(steps);
}

TEST(BuildResultMesh, of_an_overlap_in_a_plane) {
  const stages::CoplanarOverlap boxes;
  const UnionSteps steps(boxes);
  // Where the two cross in the plane z = 2, one face ends along a straight edge and another one begins: a corner.
  const Lines expected = {
      "x=1: (1 1 2)-(1 1 4) (1 1 2)-(1 2 2) (1 1 4)-(1 3 4) (1 2 2)-(1 3 2) (1 3 2)-(1 3 4)",
      "x=2: (2 0 0)-(2 0 2) (2 0 0)-(2 2 0) (2 0 2)-(2 1 2) (2 1 2)-(2 2 2) (2 2 0)-(2 2 2)",
      "y=1: (1 1 2)-(1 1 4) (1 1 2)-(2 1 2) (1 1 4)-(3 1 4) (2 1 2)-(3 1 2) (3 1 2)-(3 1 4)",
      "y=2: (0 2 0)-(0 2 2) (0 2 0)-(2 2 0) (0 2 2)-(1 2 2) (1 2 2)-(2 2 2) (2 2 0)-(2 2 2)",
      "z=2: (0 0 2)-(0 2 2) (0 0 2)-(2 0 2) (0 2 2)-(1 2 2) (1 1 2)-(1 2 2) (1 1 2)-(2 1 2) (2 0 2)-(2 1 2)",
      "z=2: (1 2 2)-(1 3 2) (1 2 2)-(2 2 2) (1 3 2)-(3 3 2) (2 1 2)-(2 2 2) (2 1 2)-(3 1 2) (3 1 2)-(3 3 2)"};
  EXPECT_EQ(text(steps, steps.edges), expected);
  EXPECT_EQ(pseudo_nodes_text(steps), Lines());
  EXPECT_EQ(text(steps, steps.straight), expected);
  EXPECT_EQ(counts(steps), (Counts{20, 32, 18}));
  expect_audited(steps);
}

TEST(BuildResultMesh, of_a_cavity) {
  const stages::Cavity boxes;
  const UnionSteps steps(boxes);
  EXPECT_EQ(steps.edges, std::vector<RegionEdge>());
  EXPECT_EQ(counts(steps), (Counts{0, 12, 8}));
  // Both patches make A without B.
  const TriangleMesh hollow = build_result_mesh(steps.subdivision, {steps.selection.sub_facets, {1, -1}}).value();
  EXPECT_EQ(hollow.face_count(), 24U);
  EXPECT_EQ(audit(hollow), Lines());
}

// The one frees sub-edges on the way, and takes no patches beside the regions.
TEST(BuildResultMesh, of_a_subdivision_that_is_not_needed_any_more_is_the_same) {
  const stages::CrossingCubes boxes;
  UnionSteps steps(boxes);
  const TriangleMesh kept = build_result_mesh(steps.subdivision, steps.selection).value();
  const TriangleMesh freed = build_result_mesh(std::move(steps.subdivision), steps.selection).value();
  EXPECT_EQ(audit(freed), Lines());
  EXPECT_EQ(kept.points(), freed.points());
  EXPECT_TRUE(std::ranges::equal(kept.origins(), freed.origins()));
}

TEST(BuildResultMesh, faces_that_are_not_bounded_all_round_are_an_error) {
  const stages::CrossingCubes boxes;
  const UnionSteps steps(boxes);
  std::vector<RegionEdge> open = steps.straight;
  open.pop_back();
  const auto regions = triangulate_regions(steps.subdivision, open);
  ASSERT_FALSE(regions.ok());
  EXPECT_EQ(regions.error().code, ErrorCode::internal);
  EXPECT_NE(regions.error().message.find("do not bound a face all round"), std::string::npos);
  EXPECT_NE(regions.error().message.find("near ("), std::string::npos) << regions.error().message;
}

TEST(BuildResultMesh, a_selection_that_no_classification_gives_is_an_error) {
  const stages::CrossingCubes boxes;
  const Subdivision subdivision = boxes.subdivision();
  const auto result_of = [&](const std::function<int(SubEdgeSide)>& of_side) {
    return build_result_mesh(subdivision, Selection::of(subdivision, of_side, [](PatchId) { return 0; }));
  };
  EXPECT_TRUE(result_of([](SubEdgeSide) { return 0; })->is_empty());
  const IdRange<SubEdgeSide> sides = subdivision.sub_edges.sides();
  const auto covered =
      std::ranges::find_if(sides, [&](SubEdgeSide side) { return subdivision.sub_edges.is_covered(side); });
  const auto result = result_of([&](SubEdgeSide side) { return side == *covered ? 1 : 0; });
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::internal);
}

void expect_part(const std::vector<std::string>& violations, const std::string& part) {
  const std::string all = fmt::format("{}", fmt::join(violations, "\n"));
  EXPECT_NE(all.find(part), std::string::npos) << "expected: " << part << "\n" << all;
}

TEST(BuildResultMesh, audit_sees_damaged_edges) {
  const stages::SharedFace boxes;
  const UnionSteps steps(boxes);
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    std::vector<RegionEdge> damaged = steps.edges;
    damage(damaged);
    expect_part(audit(steps.subdivision, damaged), part);
  };
  expect_seen([](auto& edges) { edges.pop_back(); }, "more edges begin than end at node");
  expect_seen([](auto& edges) { edges.push_back(edges.front()); }, "twice");
  expect_seen([](auto& edges) { edges[0].to = edges[0].from; }, "has no two ends or no plane");
  expect_seen([](auto& edges) { edges[0].from = NodeId(99); }, "has no two ends or no plane");
  expect_seen([](auto& edges) { edges[0].region = {PlaneId(99), false}; }, "has no two ends or no plane");
  expect_seen(
      [&](auto& edges) {
        const auto other = std::ranges::find_if(edges, [&](const RegionEdge& e) {
          return steps.plane_text(e.region) != steps.plane_text(edges[0].region);
        });
        std::swap(edges[0].region, other->region);
        for (RegionEdge& edge : edges) edge.region = edges[0].region;
      },
      "is not in the plane");
}

TEST(BuildResultMesh, audit_sees_damaged_pseudo_nodes) {
  const stages::SharedFace boxes;
  const UnionSteps steps(boxes);
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    std::vector<PseudoNode> damaged = steps.pseudo_nodes;
    damage(damaged);
    expect_part(audit(steps.subdivision, damaged), part);
  };
  expect_seen([](auto& found) { found[0].after = found[0].before; }, "does not lie between");
  expect_seen([](auto& found) { found[0].before = NodeId(99); }, "is not a node");
  expect_seen([](auto& found) { std::swap(found[0], found[1]); }, "is not behind the one before it");
  expect_seen(
      [](auto& found) {
        found.insert(found.begin() + 1, found[0]);
        found[1].after = NodeId(found[1].after.index() + 1);
      },
      "goes on from pseudo-node");
}

TEST(BuildResultMesh, audit_sees_damaged_regions) {
  const stages::CrossingCubes boxes;
  const UnionSteps steps(boxes);
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    Regions damaged = steps.regions;
    damage(damaged);
    expect_part(audit(steps.subdivision, steps.straight, damaged), part);
  };
  expect_seen([](auto& regions) { regions.regions.pop_back(); }, "5 regions are not those of the edges, which are 6");
  expect_seen([](auto& regions) { std::swap(regions.regions[0], regions.regions[1]); }, "are not those of the edges");
  expect_seen([](auto& regions) { --regions.regions[0].triangles.last; }, "its triangles and its boundary differ");
  expect_seen([](auto& regions) { std::swap(regions.triangles[0][0], regions.triangles[0][1]); },
              "is not counter-clockwise from the front");
  expect_seen([](auto& regions) { regions.triangles[0][2] = 99; }, "has a corner that is not a node");
  expect_seen([](auto& regions) { regions.regions[0].has_exact_corner = true; },
              "does not say whether a corner is not a double");
}

}  // namespace
}  // namespace algebra3d::arrangement
