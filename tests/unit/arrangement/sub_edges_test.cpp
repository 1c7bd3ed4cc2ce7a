// Sixth stage: the subdivision of all planes.
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

/// "(4 2 4)-(4 4 4): A x=4 edge, A z=4 edge": each line in space with the facets that hold a sub-edge there.
Lines text(const Facets& facets, const SegmentComplex& complex, const SubEdges& sub_edges) {
  Lines lines;
  sub_edges.for_each_space_edge([&](IdRange<SubEdgeId> line) {
    Lines holders;
    for (const SubEdgeId id : line)
      for (const IncidentFacet& incident : sub_edges.incident_to(id))
        holders.push_back(stages::text(facets, incident.facet()) +
                          (incident.sides() == FacetSides::both ? " inside" : " edge"));
    const auto [u, v] = sub_edges[line.front()].ends;
    lines.push_back(stages::line(complex.nodes, u, v) + ": " +
                    fmt::format("{}", fmt::join(stages::sorted(holders), ", ")));
  });
  return stages::sorted(std::move(lines));
}

void expect_sub_edges(const stages::Boxes& boxes, const Lines& expected) {
  const Facets facets = boxes.facets();
  SegmentComplex complex = boxes.overlaid(facets);
  const SubEdges sub_edges = divide(facets, complex);
  EXPECT_EQ(text(facets, complex, sub_edges), stages::sorted(expected));
  EXPECT_EQ(audit(facets, complex, sub_edges), Lines());
}

TEST(SubEdges, of_crossing_cubes) {
  expect_sub_edges(stages::CrossingCubes(),
                   {"(4 2 2)-(4 2 4): A x=4 inside, B y=2 inside", "(4 2 2)-(4 4 2): A x=4 inside, B z=2 inside",
                    "(2 4 2)-(2 4 4): A y=4 inside, B x=2 inside", "(2 4 2)-(4 4 2): A y=4 inside, B z=2 inside",
                    "(2 2 4)-(2 4 4): A z=4 inside, B x=2 inside", "(2 2 4)-(4 2 4): A z=4 inside, B y=2 inside",
                    // A
                    "(4 0 0)-(4 4 0): A x=4 edge", "(4 0 0)-(4 0 4): A x=4 edge", "(0 4 0)-(4 4 0): A y=4 edge",
                    "(0 4 0)-(0 4 4): A y=4 edge", "(0 0 4)-(4 0 4): A z=4 edge", "(0 0 4)-(0 4 4): A z=4 edge",
                    "(4 4 0)-(4 4 2): A x=4 edge, A y=4 edge", "(4 4 2)-(4 4 4): A x=4 edge, A y=4 edge",
                    "(4 0 4)-(4 2 4): A x=4 edge, A z=4 edge", "(4 2 4)-(4 4 4): A x=4 edge, A z=4 edge",
                    "(0 4 4)-(2 4 4): A y=4 edge, A z=4 edge", "(2 4 4)-(4 4 4): A y=4 edge, A z=4 edge",
                    // B
                    "(2 2 2)-(2 2 4): B x=2 edge, B y=2 edge", "(2 2 4)-(2 2 6): B x=2 edge, B y=2 edge",
                    "(2 2 2)-(2 4 2): B x=2 edge, B z=2 edge", "(2 4 2)-(2 6 2): B x=2 edge, B z=2 edge",
                    "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge", "(4 2 2)-(6 2 2): B y=2 edge, B z=2 edge",
                    "(2 2 6)-(2 6 6): B x=2 edge", "(2 6 2)-(2 6 6): B x=2 edge", "(2 2 6)-(6 2 6): B y=2 edge",
                    "(6 2 2)-(6 2 6): B y=2 edge", "(2 6 2)-(6 6 2): B z=2 edge", "(6 2 2)-(6 6 2): B z=2 edge"});
}

TEST(SubEdges, of_boxes_with_a_shared_face) {
  // On its own boundary a facet lies on one side, whatever common part runs there.
  expect_sub_edges(stages::SharedFace(),
                   {"(2 0 0)-(2 0 2): A x=2 edge, A y=0 edge, B x=2 edge, B y=0 edge",
                    "(2 2 0)-(2 2 2): A x=2 edge, A y=2 edge, B x=2 edge, B y=2 edge",
                    "(2 0 0)-(2 2 0): A x=2 edge, A z=0 edge, B x=2 edge, B z=0 edge",
                    "(2 0 2)-(2 2 2): A x=2 edge, A z=2 edge, B x=2 edge, B z=2 edge",
                    // A
                    "(0 0 0)-(0 2 0): A z=0 edge", "(0 0 0)-(0 0 2): A y=0 edge", "(0 0 2)-(0 2 2): A z=2 edge",
                    "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 0)-(2 0 0): A y=0 edge, A z=0 edge",
                    "(0 2 0)-(2 2 0): A y=2 edge, A z=0 edge", "(0 0 2)-(2 0 2): A y=0 edge, A z=2 edge",
                    "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge",
                    // B
                    "(4 0 0)-(4 2 0): B z=0 edge", "(4 0 0)-(4 0 2): B y=0 edge", "(4 0 2)-(4 2 2): B z=2 edge",
                    "(4 2 0)-(4 2 2): B y=2 edge", "(2 0 0)-(4 0 0): B y=0 edge, B z=0 edge",
                    "(2 2 0)-(4 2 0): B y=2 edge, B z=0 edge", "(2 0 2)-(4 0 2): B y=0 edge, B z=2 edge",
                    "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge"});
}

TEST(SubEdges, of_boxes_with_a_shared_edge) {
  expect_sub_edges(
      stages::SharedEdge(),
      {"(2 2 0)-(2 2 2): A x=2 edge, A y=2 edge, B x=2 edge, B y=2 edge",
       // A
       "(2 0 0)-(2 2 0): A x=2 edge, A z=0 edge", "(2 0 2)-(2 2 2): A x=2 edge, A z=2 edge",
       "(2 0 0)-(2 0 2): A x=2 edge", "(0 2 0)-(2 2 0): A y=2 edge, A z=0 edge",
       "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge", "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 0)-(2 0 0): A z=0 edge",
       "(0 0 0)-(0 2 0): A z=0 edge", "(0 0 2)-(2 0 2): A z=2 edge", "(0 0 2)-(0 2 2): A z=2 edge",
       // B
       "(2 2 0)-(2 4 0): B x=2 edge, B z=0 edge", "(2 2 2)-(2 4 2): B x=2 edge, B z=2 edge",
       "(2 4 0)-(2 4 2): B x=2 edge", "(2 2 0)-(4 2 0): B y=2 edge, B z=0 edge",
       "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge", "(4 2 0)-(4 2 2): B y=2 edge", "(2 4 0)-(4 4 0): B z=0 edge",
       "(4 2 0)-(4 4 0): B z=0 edge", "(2 4 2)-(4 4 2): B z=2 edge", "(4 2 2)-(4 4 2): B z=2 edge"});
}

TEST(SubEdges, of_boxes_with_a_shared_vertex) {
  expect_sub_edges(stages::SharedVertex(),
                   {"(2 0 0)-(2 2 0): A x=2 edge", "(2 0 0)-(2 0 2): A x=2 edge", "(0 2 0)-(2 2 0): A y=2 edge",
                    "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 2)-(2 0 2): A z=2 edge", "(0 0 2)-(0 2 2): A z=2 edge",
                    "(2 2 0)-(2 2 2): A x=2 edge, A y=2 edge", "(2 0 2)-(2 2 2): A x=2 edge, A z=2 edge",
                    "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge",  //
                    "(2 2 2)-(2 2 4): B x=2 edge, B y=2 edge", "(2 2 2)-(2 4 2): B x=2 edge, B z=2 edge",
                    "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge", "(2 2 4)-(2 4 4): B x=2 edge",
                    "(2 4 2)-(2 4 4): B x=2 edge", "(2 2 4)-(4 2 4): B y=2 edge", "(4 2 2)-(4 2 4): B y=2 edge",
                    "(2 4 2)-(4 4 2): B z=2 edge", "(4 2 2)-(4 4 2): B z=2 edge"});
}

TEST(SubEdges, of_boxes_that_overlap_in_a_plane) {
  expect_sub_edges(
      stages::CoplanarOverlap(),
      {// The boundary of the common square, with both in the plane z = 2.
       "(1 1 2)-(1 2 2): A z=2 inside, B x=1 edge, B z=2 edge", "(1 1 2)-(2 1 2): A z=2 inside, B y=1 edge, B z=2 edge",
       "(2 1 2)-(2 2 2): A x=2 edge, A z=2 edge, B z=2 inside", "(1 2 2)-(2 2 2): A y=2 edge, A z=2 edge, B z=2 inside",
       // The same edges outside of it.
       "(1 2 2)-(1 3 2): B x=1 edge, B z=2 edge", "(2 1 2)-(3 1 2): B y=1 edge, B z=2 edge",
       "(2 0 2)-(2 1 2): A x=2 edge, A z=2 edge", "(0 2 2)-(1 2 2): A y=2 edge, A z=2 edge",
       // A
       "(2 0 0)-(2 2 0): A x=2 edge", "(2 0 0)-(2 0 2): A x=2 edge", "(2 2 0)-(2 2 2): A x=2 edge, A y=2 edge",
       "(0 2 0)-(2 2 0): A y=2 edge", "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 2)-(2 0 2): A z=2 edge",
       "(0 0 2)-(0 2 2): A z=2 edge",
       // B
       "(1 1 2)-(1 1 4): B x=1 edge, B y=1 edge", "(1 1 4)-(1 3 4): B x=1 edge", "(1 3 2)-(1 3 4): B x=1 edge",
       "(1 1 4)-(3 1 4): B y=1 edge", "(3 1 2)-(3 1 4): B y=1 edge", "(1 3 2)-(3 3 2): B z=2 edge",
       "(3 1 2)-(3 3 2): B z=2 edge"});
}

TEST(SubEdges, beside_one_are_those_along_its_space_edge) {
  const stages::CrossingCubes boxes;
  const SubEdges sub_edges = boxes.subdivision().sub_edges;
  for (const SubEdgeId s : sub_edges.ids()) {
    const IdRange<SubEdgeId> beside = sub_edges.beside(s), along = sub_edges.along(sub_edges.ends[s]);
    EXPECT_EQ(*beside.begin(), *along.begin());
    EXPECT_EQ(*beside.end(), *along.end());
  }
}

TEST(SubEdges, of_a_cavity_are_none) {
  expect_sub_edges(stages::Cavity(), {});
}

TEST(SubEdges, of_facets_lie_on_the_side_of_the_facet) {
  const stages::SharedVertex boxes;
  const Facets facets = boxes.facets();
  SegmentComplex complex = boxes.overlaid(facets);
  const SubEdges sub_edges = divide(facets, complex);
  // Each is a boundary: a facet lies on one side of it, and nothing on the other.
  for (const SubEdgeId id : sub_edges.ids())
    EXPECT_NE(sub_edges.is_covered({id, Side::left}), sub_edges.is_covered({id, Side::right}));
  for (const SubEdgeId id : sub_edges.ids()) {
    const IdRange<SubEdgeId> along = sub_edges.along(sub_edges[id].ends);
    EXPECT_TRUE(along.front() <= id && id.index() < along.front().index() + along.size());
  }
}

TEST(SubEdges, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const Facets facets = boxes.facets();
  const SegmentComplex complex = boxes.overlaid(facets);
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    SegmentComplex divided = complex;
    SubEdges damaged = divide(facets, divided);
    damage(damaged);
    const std::string violations = fmt::format("{}", fmt::join(audit(facets, complex, damaged), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  const SubEdgeId first(0);
  expect_seen([&](SubEdges& s) { std::swap(s.ends[first].u, s.ends[first].v); },
              "sub-edge 0 has no two ends, ascending");
  expect_seen([&](SubEdges& s) { std::swap(s.ends[first], s.ends.back()); }, "is not behind the one before it");
  expect_seen([&](SubEdges& s) { s.first_incident[SubEdgeId(1)] = 0; }, "sub-edge 0 has the incident facets 0 to 0");
  expect_seen([&](SubEdges& s) { s.incident[0] = {FacetId(99), FacetSides::both}; }, "an incident facet is not there");
  expect_seen([&](SubEdges& s) { s.planes[first] = PlaneId(5 - s.planes[first].index()); }, "is in another plane");
  expect_seen(
      [&](SubEdges& s) {
        s.incident.insert(s.incident.begin(), s.incident.front());
        for (std::uint32_t& begin : s.first_incident) ++begin;
        s.first_incident[first] = 0;
      },
      "is on one side twice");
  // A diagonal of a side, which crosses sub-edges of its plane.
  expect_seen(
      [&](SubEdges& s) {
        const auto corner = [&](const Vec3& point) {
          return *std::ranges::find_if(complex.nodes.ids(), [&](NodeId n) { return complex.nodes[n].approx == point; });
        };
        for (SpaceEdge& ends : s.ends)
          if (ends == SpaceEdge::of(corner({4, 0, 0}), corner({4, 4, 0})))
            ends = SpaceEdge::of(corner({4, 0, 0}), corner({4, 4, 4}));
      },
      "meet in more than ends");
}

}  // namespace
}  // namespace algebra3d::arrangement
