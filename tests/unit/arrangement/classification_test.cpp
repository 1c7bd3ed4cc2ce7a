// Winding jumps, and stage 8: front windings. What is expected of sub-facets is worked out anew from the boxes
// alone: a place is in a box or it is not.
#include "algebra3d/kernel/arrangement/detail/classification.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/propagating.h"
#include "algebra3d/kernel/arrangement/detail/seeding.h"
#include "algebra3d/kernel/arrangement/detail/sub_facets.h"
#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

/// Refers to the boxes.
struct Classified {
  explicit Classified(const stages::Boxes& boxes)
      : subdivision(boxes.subdivision()),
        jumps(winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges)),
        fronts(classify(subdivision, jumps, Closure::each, {}).value()) {}

  Lines audited() const { return audit(subdivision, jumps, Closure::each, fronts); }

  Subdivision subdivision;
  WindingJumps jumps;
  Classification fronts;
};

/// The windings at a point, which lies on no boundary.
WindingVector windings_at(const Operands& operands, const Vec3& point) {
  WindingVector windings;
  for (const OperandId operand : operands.ids()) {
    Box3 box;
    for (const Vec3& corner : operands.mesh(operand).points().approx()) box.extend(corner);
    const bool is_inside = box.min.x < point.x && point.x < box.max.x && box.min.y < point.y && point.y < box.max.y &&
                           box.min.z < point.z && point.z < box.max.z;
    if (is_inside) ++windings[operands.group(operand)];
  }
  return windings;
}

Vec3 normal_of(const Plane& plane) {
  const auto& [a, b, c] = plane.triangle();
  const Vec3 n = cross(b.approx - a.approx, c.approx - a.approx);
  return (1 / length(n)) * n;
}

/// A point of the sub-facet near to the middle of the sub-edge.
Vec3 point_beside(const Subdivision& subdivision, SubEdgeSide at) {
  const auto [u, v] = subdivision.sub_edges[at.sub_edge()].ends;
  const Vec3 from = subdivision.complex.nodes[u].approx, to = subdivision.complex.nodes[v].approx;
  const Vec3 to_the_left = cross(normal_of(subdivision.plane_of(at.sub_edge())), to - from);
  return 0.5 * (from + to) + (at.side() == Side::left ? 1e-3 : -1e-3) * to_the_left;
}

void expect_fronts(const stages::Boxes& boxes) {
  const Classified found(boxes);
  const auto& [subdivision, jumps, fronts] = found;
  for (const SubEdgeSide side : subdivision.sub_edges.sides()) {
    const Vec3 point = point_beside(subdivision, side);
    const Vec3 normal = 1e-3 * normal_of(subdivision.plane_of(side.sub_edge()));
    const WindingVector front = windings_at(subdivision.operands, point + normal);
    const WindingVector back = windings_at(subdivision.operands, point - normal);
    EXPECT_EQ(jumps[side], back - front) << side.index();
    if (jumps[side] != WindingVector()) {
      EXPECT_EQ(fronts.at_sides[side], front) << side.index();
    }
  }
  EXPECT_EQ(found.audited(), Lines());
}

TEST(Classification, of_boxes_is_that_of_their_places) {
  expect_fronts(stages::CrossingCubes());
  expect_fronts(stages::SharedFace());
  expect_fronts(stages::SharedEdge());
  expect_fronts(stages::SharedVertex());
  expect_fronts(stages::CoplanarOverlap());
  expect_fronts(stages::Cavity());
}

/// "x=2 A front (0 1) back (1 0)": what is on both sides of the sub-facets of each plane.
Lines text(const Classified& found) {
  const auto& [subdivision, jumps, fronts] = found;
  std::set<std::string> lines;
  for (const SubEdgeSide side : subdivision.sub_edges.sides()) {
    if (jumps[side] == WindingVector()) continue;
    const WindingVector front = fronts.at_sides[side], back = front + jumps[side];
    lines.insert(fmt::format("{}: front ({} {}), back ({} {})", stages::text(subdivision.plane_of(side.sub_edge())),
                             front[0], front[1], back[0], back[1]));
  }
  for (const PatchId patch : subdivision.patches.ids())
    lines.insert(fmt::format("patch of {}: front ({} {})", stages::name(subdivision.patches[patch].operand),
                             fronts.at_patches[patch][0], fronts.at_patches[patch][1]));
  return {lines.begin(), lines.end()};
}

TEST(Classification, of_crossing_cubes) {
  EXPECT_EQ(text(Classified(stages::CrossingCubes())),
            (Lines{// B's sides look back: behind them is outside of B.
                   "patch of A: front (0 0)", "patch of B: front (0 0)", "x=2: front (0 1), back (0 0)",
                   "x=2: front (1 1), back (1 0)", "x=4: front (0 0), back (1 0)", "x=4: front (0 1), back (1 1)",
                   "y=2: front (0 1), back (0 0)", "y=2: front (1 1), back (1 0)", "y=4: front (0 0), back (1 0)",
                   "y=4: front (0 1), back (1 1)", "z=2: front (0 1), back (0 0)", "z=2: front (1 1), back (1 0)",
                   "z=4: front (0 0), back (1 0)", "z=4: front (0 1), back (1 1)"}));
}

TEST(Classification, of_a_shared_face) {
  EXPECT_EQ(text(Classified(stages::SharedFace())),
            (Lines{"patch of A: front (0 0)", "patch of B: front (0 0)", "x=2: front (0 1), back (1 0)",
                   "y=0: front (0 1), back (0 0)", "y=0: front (1 0), back (0 0)", "y=2: front (0 0), back (0 1)",
                   "y=2: front (0 0), back (1 0)", "z=0: front (0 1), back (0 0)", "z=0: front (1 0), back (0 0)",
                   "z=2: front (0 0), back (0 1)", "z=2: front (0 0), back (1 0)"}));
}

TEST(Classification, of_a_shared_edge) {
  EXPECT_EQ(text(Classified(stages::SharedEdge())),
            (Lines{"patch of A: front (0 0)", "patch of B: front (0 0)", "x=2: front (0 0), back (1 0)",
                   "x=2: front (0 1), back (0 0)", "y=2: front (0 0), back (1 0)", "y=2: front (0 1), back (0 0)",
                   "z=0: front (0 1), back (0 0)", "z=0: front (1 0), back (0 0)", "z=2: front (0 0), back (0 1)",
                   "z=2: front (0 0), back (1 0)"}));
}

TEST(Classification, of_a_shared_vertex) {
  EXPECT_EQ(text(Classified(stages::SharedVertex())),
            (Lines{"patch of A: front (0 0)", "patch of B: front (0 0)", "x=2: front (0 0), back (1 0)",
                   "x=2: front (0 1), back (0 0)", "y=2: front (0 0), back (1 0)", "y=2: front (0 1), back (0 0)",
                   "z=2: front (0 0), back (1 0)", "z=2: front (0 1), back (0 0)"}));
}

TEST(Classification, of_an_overlap_in_a_plane) {
  EXPECT_EQ(text(Classified(stages::CoplanarOverlap())),
            (Lines{"patch of A: front (0 0)", "patch of B: front (0 0)", "x=1: front (0 1), back (0 0)",
                   "x=2: front (0 0), back (1 0)", "y=1: front (0 1), back (0 0)", "y=2: front (0 0), back (1 0)",
                   // In the plane of both: A alone, B alone, and the two upon each other.
                   "z=2: front (0 0), back (1 0)", "z=2: front (0 1), back (0 0)", "z=2: front (0 1), back (1 0)"}));
}

TEST(Classification, of_a_cavity) {
  EXPECT_EQ(text(Classified(stages::Cavity())), (Lines{"patch of A: front (0 0)", "patch of B: front (1 0)"}));
}

TEST(WindingJumps, of_one_group_cancel_out) {
  stages::SharedFace boxes;
  boxes.list()[1].group = 0;
  const Subdivision subdivision = boxes.subdivision();
  const WindingJumps jumps = winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
  std::size_t in_common_plane = 0;
  for (const SubEdgeSide side : subdivision.sub_edges.sides())
    if (stages::text(subdivision.plane_of(side.sub_edge())) == "x=2" && subdivision.sub_edges.is_covered(side)) {
      EXPECT_EQ(jumps[side], WindingVector());
      ++in_common_plane;
    }
  EXPECT_EQ(in_common_plane, 4U);  // the inner sides of the four sub-edges round the square
}

TEST(FrontWindings, are_those_of_sub_facets_and_patches) {
  // Three sides of each cube are divided into a square and an L. Each cube has one patch.
  const stages::CrossingCubes boxes;
  const Subdivision subdivision = boxes.subdivision();
  const FrontWindingIds ids = number_front_windings(subdivision).value();
  EXPECT_EQ(ids.count(), 2U * 3U * 2U + 2U);
  // Squares have four sides, Ls six; those of an L along an uncut edge are undivided.
  std::map<FrontWindingId, std::size_t> sides;
  for (const SubEdgeSide side : subdivision.sub_edges.sides()) {
    EXPECT_EQ(ids.of(side).is_none(), !subdivision.sub_edges.is_covered(side));
    if (!ids.of(side).is_none()) ++sides[ids.of(side)];
  }
  std::map<std::size_t, std::size_t> sub_facets_by_sides;
  for (const auto& [front, count] : sides) ++sub_facets_by_sides[count];
  EXPECT_EQ(sub_facets_by_sides, (std::map<std::size_t, std::size_t>{{4, 6}, {6, 6}}));
}

TEST(FrontWindings, of_what_touches_nothing_are_those_of_patches) {
  const stages::Cavity boxes;
  EXPECT_EQ(number_front_windings(boxes.subdivision()).value().count(), 2U);
}

TEST(SpaceEdgeSet, has_its_edges_and_no_others) {
  const auto edge = [](int u, int v) { return SpaceEdge{NodeId(u), NodeId(v)}; };
  const std::vector<SpaceEdge> edges{edge(0, 3), edge(2, 3), edge(0, 1)};
  const SpaceEdgeSet set(edges, 4);
  for (const SpaceEdge& member : edges) EXPECT_TRUE(set.contains(member));
  for (const SpaceEdge& other : {edge(0, 2), edge(1, 3), edge(1, 2)}) EXPECT_FALSE(set.contains(other));
  EXPECT_FALSE(SpaceEdgeSet().contains(edge(0, 1)));
  for (std::uint32_t i = 0; i < edges.size(); ++i) EXPECT_EQ(set.position(edges[i]), i);
  EXPECT_EQ(set.position(edge(0, 2)), kNone);
}

TEST(UncutEdges, are_found_by_the_space_edges_along_them) {
  const stages::CrossingCubes cubes;
  const Subdivision subdivision = cubes.subdivision();
  const UncutEdges& uncut = subdivision.uncut_edges;
  std::size_t found = 0;
  for (const UncutEdge& edge : uncut.edges) {
    const auto nodes = uncut.nodes_along(edge);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i, ++found)
      EXPECT_EQ(uncut.find(SpaceEdge::of(nodes[i], nodes[i + 1])), &edge);
  }
  EXPECT_EQ(found, uncut.edge_at.size());
  // Three sides of each cube touch the other one: six edges are between these and the other three sides.
  EXPECT_EQ(uncut.edges.size(), 12U);
  for (const SpaceEdge& ends : subdivision.sub_edges.ends)
    EXPECT_EQ(uncut.find(ends) != nullptr, uncut.space_edges.contains(ends));
}

TEST(WindingSets, are_counted) {
  WindingSets sets(3);
  EXPECT_EQ(sets.set_count(), 3U);
  sets.unite(FrontWindingId(0), FrontWindingId(2), {1, 0});
  EXPECT_EQ(sets.set_count(), 2U);
  sets.unite(FrontWindingId(2), FrontWindingId(0), {-1, 0});
  EXPECT_EQ(sets.set_count(), 2U);
  sets.unite(FrontWindingId(1), FrontWindingId(0), {});
  EXPECT_EQ(sets.set_count(), 1U);
}

TEST(Linking, gives_one_seed_for_each_set) {
  const auto seeds_of = [](const stages::Boxes& boxes) {
    const Subdivision subdivision = boxes.subdivision();
    const WindingJumps jumps = winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
    return link_windings(subdivision, jumps).value().seeds;
  };
  // Where both cubes have faces at a space edge, no ray is needed: so there, not at the first space edge.
  for (const auto& seeds : {seeds_of(stages::CrossingCubes()), seeds_of(stages::SharedEdge())}) {
    ASSERT_EQ(seeds.size(), 1U);
    EXPECT_EQ(seeds[0].operand_count, 2U);
  }
  // Two cubes that share a corner alone have two sets, each with faces of one of them.
  const auto seeds = seeds_of(stages::SharedVertex());
  ASSERT_EQ(seeds.size(), 2U);
  for (const SeedPlace& seed : seeds) EXPECT_EQ(seed.operand_count, 1U);
}

/// Sets of front windings that have a jump or are those of patches.
std::size_t set_count(const stages::Boxes& boxes) {
  const Subdivision subdivision = boxes.subdivision();
  const WindingJumps jumps = winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
  LinkedWindings linked = link_windings(subdivision, jumps).value();
  std::set<FrontWindingId> sets;
  for (const SubEdgeSide side : subdivision.sub_edges.sides())
    if (jumps[side] != WindingVector()) sets.insert(linked.sets.find(linked.ids.of(side)).set);
  for (const PatchId patch : subdivision.patches.ids()) sets.insert(linked.sets.find(linked.ids.of(patch)).set);
  return sets.size();
}

TEST(Linking, unites_what_meets_in_lines) {
  EXPECT_EQ(set_count(stages::CrossingCubes()), 1U);
  EXPECT_EQ(set_count(stages::SharedFace()), 1U);
  EXPECT_EQ(set_count(stages::SharedEdge()), 1U);
  EXPECT_EQ(set_count(stages::CoplanarOverlap()), 1U);
  // A point and nothing at all leave two.
  EXPECT_EQ(set_count(stages::SharedVertex()), 2U);
  EXPECT_EQ(set_count(stages::Cavity()), 2U);
}

TEST(Seeding, finds_the_windings_of_each_set) {
  const stages::Cavity boxes;
  const Subdivision subdivision = boxes.subdivision();
  LinkedWindings linked = link_windings(subdivision, {}).value();
  const SetWindings known = seed_windings(subdivision, {}, linked, Closure::each, {}).value();
  EXPECT_EQ(known, (SetWindings{{linked.ids.of(PatchId(0)), {0, 0}}, {linked.ids.of(PatchId(1)), {1, 0}}}));
}

TEST(Seeding, from_above_gives_what_faces_give) {
  const auto expect_same = [](const stages::Boxes& boxes) {
    const Classified by_faces(boxes);
    const auto& [subdivision, jumps, fronts] = by_faces;
    const Classification from_above = classify(subdivision, jumps, Closure::together, {}).value();
    for (const SubEdgeSide side : subdivision.sub_edges.sides()) {
      if (jumps[side] != WindingVector()) {
        EXPECT_EQ(from_above.at_sides[side], fronts.at_sides[side]);
      }
    }
    EXPECT_EQ(from_above.at_patches, fronts.at_patches);
  };
  expect_same(stages::CrossingCubes());
  expect_same(stages::SharedFace());
  expect_same(stages::SharedEdge());
  expect_same(stages::SharedVertex());
  expect_same(stages::CoplanarOverlap());
  expect_same(stages::Cavity());
}

TEST(Seeding, goes_upwards_where_many_surround_each_other) {
  // Twelve cubes in each other, the innermost first: rays upwards link each to the next one.
  std::vector<TriangleMesh> cubes;
  for (int i = 1; i <= 12; ++i) cubes.push_back(solids::cube(-i, i));
  std::vector<Operand> list;
  for (const TriangleMesh& cube : cubes) list.push_back({&cube, 0});
  const Subdivision subdivision = subdivide(list, Boundaries::none, {}, {}).value();
  const Classification fronts = classify(subdivision, {}, Closure::each, {}).value();
  for (const PatchId patch : subdivision.patches.ids())
    EXPECT_EQ(fronts.at_patches[patch], WindingVector(11 - static_cast<int>(patch.index()), 0));
}

/// What the audits of the steps say of boxes as they are.
Lines audited_steps(const stages::Boxes& boxes) {
  const Subdivision subdivision = boxes.subdivision();
  const WindingJumps jumps = winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
  Lines violations = audit(subdivision, jumps);
  for (std::string& line : audit(subdivision, jumps, link_windings(subdivision, jumps).value()))
    violations.push_back(std::move(line));
  return violations;
}

TEST(Linking, and_winding_jumps_of_boxes_pass_their_audits) {
  EXPECT_EQ(audited_steps(stages::CrossingCubes()), Lines());
  EXPECT_EQ(audited_steps(stages::SharedFace()), Lines());
  EXPECT_EQ(audited_steps(stages::SharedEdge()), Lines());
  EXPECT_EQ(audited_steps(stages::SharedVertex()), Lines());
  EXPECT_EQ(audited_steps(stages::CoplanarOverlap()), Lines());
  EXPECT_EQ(audited_steps(stages::Cavity()), Lines());
}

TEST(WindingJumps, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const Subdivision subdivision = boxes.subdivision();
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    WindingJumps damaged = winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
    damage(damaged);
    const std::string violations = fmt::format("{}", fmt::join(audit(subdivision, damaged), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  // The first jump of A becomes another one.
  const auto set_of_a = [](WindingJumps& jumps, const WindingVector& jump) {
    jumps.set(*std::ranges::find_if(jumps.ids(), [&](SubEdgeSide side) { return jumps[side][0] == 1; }), jump);
  };
  expect_seen([](WindingJumps& jumps) { jumps = WindingJumps(jumps.size() - 1); }, "winding jumps for");
  expect_seen([&](WindingJumps& jumps) { set_of_a(jumps, {2, 0}); }, "a jump of 2 at 1 facets of group 0");
  expect_seen([&](WindingJumps& jumps) { set_of_a(jumps, {0, 0}); }, "a jump of 0 at 1 facets of group 0");
  expect_seen([&](WindingJumps& jumps) { set_of_a(jumps, {1, -1}); }, "a jump of -1 at 0 facets of group 1");
  // As if a facet lay the other way round: possible there, but not with those round the line.
  expect_seen(
      [](WindingJumps& jumps) {
        for (const SubEdgeSide side : jumps.ids())
          if (jumps[side][0] == 1) jumps.set(side, {-1, jumps[side][1]});
        const SubEdgeSide first =
            *std::ranges::find_if(jumps.ids(), [&](SubEdgeSide side) { return jumps[side][0] != 0; });
        jumps.set(first, {1, jumps[first][1]});
      },
      "windings change by (");
}

TEST(Linking, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const Subdivision subdivision = boxes.subdivision();
  const WindingJumps jumps = winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    LinkedWindings damaged = link_windings(subdivision, jumps).value();
    damage(damaged);
    const std::string violations = fmt::format("{}", fmt::join(audit(subdivision, jumps, damaged), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  expect_seen([](LinkedWindings& linked) { linked.sets = WindingSets(linked.ids.count()); },
              "are not linked by the cell between them");
  expect_seen([](LinkedWindings& linked) { linked.sets = WindingSets(linked.ids.count() - 1); },
              "front windings in the sets");
  // All in one set, and all the same.
  expect_seen(
      [](LinkedWindings& linked) {
        WindingSets wrong(linked.ids.count());
        for (const FrontWindingId id : wrong.ids()) wrong.unite(FrontWindingId(0), id, {});
        linked.sets = wrong;
      },
      "are not linked by the cell between them");
  expect_seen([](LinkedWindings& linked) { linked.seeds[0].operand_count = 0; }, "has no operand");
  expect_seen([&](LinkedWindings& linked) { linked.seeds[0].half_plane = SubEdgeSide(jumps.size() - 1); },
              "has no half-plane of its own with a jump");
  expect_seen(
      [](LinkedWindings& linked) {
        linked.seeds[0].sub_edges = {SubEdgeId(0), SubEdgeId(0)};
      },
      "which are not all along a space edge");
}

TEST(Classification, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    Classified damaged(boxes);
    damage(damaged);
    const std::string violations = fmt::format("{}", fmt::join(damaged.audited(), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  const auto side_with_jump = [](const Classified& c) {
    return *std::ranges::find_if(c.subdivision.sub_edges.sides(),
                                 [&](SubEdgeSide side) { return c.jumps[side] != WindingVector(); });
  };
  const auto add_to_front = [&](Classified& c, const WindingVector& difference) {
    const SubEdgeSide side = side_with_jump(c);
    c.fronts.at_sides.set(side, c.fronts.at_sides[side] + difference);
  };
  expect_seen([&](Classified& c) { add_to_front(c, {0, 1}); }, "do not agree on the cell between them");
  expect_seen(
      [&](Classified& c) {
        add_to_front(c, {-1 - c.fronts.at_sides[side_with_jump(c)][0], 0});
      },
      "windings (-1 ");
  expect_seen([&](Classified& c) { ++c.fronts.at_patches[PatchId(0)][0]; }, "patch 0: windings (1 0) in front");
  expect_seen([&](Classified& c) { c.fronts.at_patches.resize(1); }, "front windings are missing");
}

}  // namespace
}  // namespace algebra3d::arrangement
