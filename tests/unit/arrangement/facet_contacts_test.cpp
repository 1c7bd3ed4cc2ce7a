// Fourth stage: common parts of facets, and the boundaries of facets, as segments. Diagonals of sides are not seen.
#include "algebra3d/kernel/arrangement/detail/facet_contacts.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

struct ExpectedComplex {
  Lines segments, cuts, touches;
};

void expect_complex(const stages::Boxes& boxes, const ExpectedComplex& expected) {
  const Facets facets = boxes.facets();
  const SegmentComplex complex = boxes.facet_contacts(facets);
  EXPECT_EQ(stages::segments(facets, complex), stages::sorted(expected.segments));
  EXPECT_EQ(stages::cuts(complex), stages::sorted(expected.cuts));
  EXPECT_EQ(stages::touches(facets, complex), stages::sorted(expected.touches));
  EXPECT_EQ(audit(boxes.operands(), facets, complex), Lines());
}

TEST(FacetContacts, of_crossing_cubes) {
  expect_complex(stages::CrossingCubes(),
                 {{// The hexagon in which the boundaries meet.
                   "(4 2 2)-(4 2 4): A x=4 inside, B y=2 inside", "(4 2 2)-(4 4 2): A x=4 inside, B z=2 inside",
                   "(2 4 2)-(2 4 4): A y=4 inside, B x=2 inside", "(2 4 2)-(4 4 2): A y=4 inside, B z=2 inside",
                   "(2 2 4)-(2 4 4): A z=4 inside, B x=2 inside", "(2 2 4)-(4 2 4): A z=4 inside, B y=2 inside",
                   // Boundaries of A's facets.
                   "(4 0 0)-(4 4 0): A x=4 edge", "(4 0 0)-(4 0 4): A x=4 edge", "(0 4 0)-(4 4 0): A y=4 edge",
                   "(0 4 0)-(0 4 4): A y=4 edge", "(0 0 4)-(4 0 4): A z=4 edge", "(0 0 4)-(0 4 4): A z=4 edge",
                   "(4 4 0)-(4 4 4): A x=4 edge, A y=4 edge", "(4 0 4)-(4 4 4): A x=4 edge, A z=4 edge",
                   "(0 4 4)-(4 4 4): A y=4 edge, A z=4 edge",
                   // Boundaries of B's facets.
                   "(2 2 2)-(2 2 6): B x=2 edge, B y=2 edge", "(2 2 2)-(2 6 2): B x=2 edge, B z=2 edge",
                   "(2 2 2)-(6 2 2): B y=2 edge, B z=2 edge", "(2 2 6)-(2 6 6): B x=2 edge",
                   "(2 6 2)-(2 6 6): B x=2 edge", "(2 2 6)-(6 2 6): B y=2 edge", "(6 2 2)-(6 2 6): B y=2 edge",
                   "(2 6 2)-(6 6 2): B z=2 edge", "(6 2 2)-(6 6 2): B z=2 edge"},
                  // Each corner of the hexagon lies on an edge.
                  {"(4 4 0)-(4 4 4) at (4 4 2)", "(4 0 4)-(4 4 4) at (4 2 4)", "(0 4 4)-(4 4 4) at (2 4 4)",
                   "(2 2 2)-(2 2 6) at (2 2 4)", "(2 2 2)-(2 6 2) at (2 4 2)", "(2 2 2)-(6 2 2) at (4 2 2)"},
                  // Faces of both sides of the edges report the corners.
                  {"A x=4 at (4 2 2)", "A x=4 at (4 2 4)", "A x=4 at (4 4 2)", "A y=4 at (2 4 2)", "A y=4 at (2 4 4)",
                   "A y=4 at (4 4 2)", "A z=4 at (2 2 4)", "A z=4 at (2 4 4)", "A z=4 at (4 2 4)", "B x=2 at (2 2 4)",
                   "B x=2 at (2 4 2)", "B x=2 at (2 4 4)", "B y=2 at (2 2 4)", "B y=2 at (4 2 2)", "B y=2 at (4 2 4)",
                   "B z=2 at (2 4 2)", "B z=2 at (4 2 2)", "B z=2 at (4 4 2)"}});
}

TEST(FacetContacts, of_boxes_with_a_shared_face) {
  // Sides at right angles have an edge of the square x = 2 in common, which is one segment with the edges of both.
  const auto at_square = [](const std::string& line, const std::string& plane) {
    return fmt::format(
        "{0}: A x=2 edge, A x=2 inside, A {1} edge, A {1} inside, "
        "B x=2 edge, B x=2 inside, B {1} edge, B {1} inside",
        line, plane);
  };
  expect_complex(stages::SharedFace(),
                 {{at_square("(2 0 0)-(2 0 2)", "y=0"), at_square("(2 2 0)-(2 2 2)", "y=2"),
                   at_square("(2 0 0)-(2 2 0)", "z=0"), at_square("(2 0 2)-(2 2 2)", "z=2"),
                   // A
                   "(0 0 0)-(0 2 0): A z=0 edge", "(0 0 0)-(0 0 2): A y=0 edge", "(0 0 2)-(0 2 2): A z=2 edge",
                   "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 0)-(2 0 0): A y=0 edge, A z=0 edge",
                   "(0 2 0)-(2 2 0): A y=2 edge, A z=0 edge", "(0 0 2)-(2 0 2): A y=0 edge, A z=2 edge",
                   "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge",
                   // B
                   "(4 0 0)-(4 2 0): B z=0 edge", "(4 0 0)-(4 0 2): B y=0 edge", "(4 0 2)-(4 2 2): B z=2 edge",
                   "(4 2 0)-(4 2 2): B y=2 edge", "(2 0 0)-(4 0 0): B y=0 edge, B z=0 edge",
                   "(2 2 0)-(4 2 0): B y=2 edge, B z=0 edge", "(2 0 2)-(4 0 2): B y=0 edge, B z=2 edge",
                   "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge"},
                  {},
                  {}});
}

TEST(FacetContacts, of_boxes_with_a_shared_edge) {
  expect_complex(
      stages::SharedEdge(),
      {{"(2 2 0)-(2 2 2): A x=2 edge, A x=2 inside, A y=2 edge, A y=2 inside, "
        "B x=2 edge, B x=2 inside, B y=2 edge, B y=2 inside",
        // A
        "(2 0 0)-(2 2 0): A x=2 edge, A z=0 edge", "(2 0 2)-(2 2 2): A x=2 edge, A z=2 edge",
        "(2 0 0)-(2 0 2): A x=2 edge", "(0 2 0)-(2 2 0): A y=2 edge, A z=0 edge",
        "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge", "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 0)-(2 0 0): A z=0 edge",
        "(0 0 0)-(0 2 0): A z=0 edge", "(0 0 2)-(2 0 2): A z=2 edge", "(0 0 2)-(0 2 2): A z=2 edge",
        // B
        "(2 2 0)-(2 4 0): B x=2 edge, B z=0 edge", "(2 2 2)-(2 4 2): B x=2 edge, B z=2 edge",
        "(2 4 0)-(2 4 2): B x=2 edge", "(2 2 0)-(4 2 0): B y=2 edge, B z=0 edge",
        "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge", "(4 2 0)-(4 2 2): B y=2 edge", "(2 4 0)-(4 4 0): B z=0 edge",
        "(4 2 0)-(4 4 0): B z=0 edge", "(2 4 2)-(4 4 2): B z=2 edge", "(4 2 2)-(4 4 2): B z=2 edge"},
       {},
       {}});
}

TEST(FacetContacts, of_boxes_with_a_shared_vertex) {
  // A corner on a corner divides nothing.
  expect_complex(stages::SharedVertex(),
                 {{"(2 0 0)-(2 2 0): A x=2 edge", "(2 0 0)-(2 0 2): A x=2 edge", "(0 2 0)-(2 2 0): A y=2 edge",
                   "(0 2 0)-(0 2 2): A y=2 edge", "(0 0 2)-(2 0 2): A z=2 edge", "(0 0 2)-(0 2 2): A z=2 edge",
                   "(2 2 0)-(2 2 2): A x=2 edge, A y=2 edge", "(2 0 2)-(2 2 2): A x=2 edge, A z=2 edge",
                   "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge",  //
                   "(2 2 2)-(2 2 4): B x=2 edge, B y=2 edge", "(2 2 2)-(2 4 2): B x=2 edge, B z=2 edge",
                   "(2 2 2)-(4 2 2): B y=2 edge, B z=2 edge", "(2 2 4)-(2 4 4): B x=2 edge",
                   "(2 4 2)-(2 4 4): B x=2 edge", "(2 2 4)-(4 2 4): B y=2 edge", "(4 2 2)-(4 2 4): B y=2 edge",
                   "(2 4 2)-(4 4 2): B z=2 edge", "(4 2 2)-(4 4 2): B z=2 edge"},
                  {},
                  {}});
}

TEST(FacetContacts, of_boxes_that_overlap_in_a_plane) {
  expect_complex(
      stages::CoplanarOverlap(),
      {{// The boundary of the square in which both lie.
        "(1 1 2)-(1 2 2): A z=2 inside, B x=1 inside", "(1 1 2)-(2 1 2): A z=2 inside, B y=1 inside",
        "(2 1 2)-(2 2 2): A x=2 inside, B z=2 inside", "(1 2 2)-(2 2 2): A y=2 inside, B z=2 inside",
        // A
        "(2 0 0)-(2 2 0): A x=2 edge", "(2 0 0)-(2 0 2): A x=2 edge", "(2 2 0)-(2 2 2): A x=2 edge, A y=2 edge",
        "(2 0 2)-(2 2 2): A x=2 edge, A z=2 edge", "(0 2 0)-(2 2 0): A y=2 edge", "(0 2 0)-(0 2 2): A y=2 edge",
        "(0 2 2)-(2 2 2): A y=2 edge, A z=2 edge", "(0 0 2)-(2 0 2): A z=2 edge", "(0 0 2)-(0 2 2): A z=2 edge",
        // B
        "(1 1 2)-(1 1 4): B x=1 edge, B y=1 edge", "(1 1 2)-(1 3 2): B x=1 edge, B z=2 edge",
        "(1 1 4)-(1 3 4): B x=1 edge", "(1 3 2)-(1 3 4): B x=1 edge", "(1 1 2)-(3 1 2): B y=1 edge, B z=2 edge",
        "(1 1 4)-(3 1 4): B y=1 edge", "(3 1 2)-(3 1 4): B y=1 edge", "(1 3 2)-(3 3 2): B z=2 edge",
        "(3 1 2)-(3 3 2): B z=2 edge"},
       {"(0 2 2)-(2 2 2) at (1 2 2)", "(2 0 2)-(2 2 2) at (2 1 2)", "(1 1 2)-(1 3 2) at (1 2 2)",
        "(1 1 2)-(3 1 2) at (2 1 2)"},
       // Corners inside facets, and edges that cross.
       {"A z=2 at (1 1 2)", "B x=1 at (1 1 2)", "B y=1 at (1 1 2)", "B z=2 at (2 2 2)", "A x=2 at (2 2 2)",
        "A y=2 at (2 2 2)", "A x=2 at (2 1 2)", "B y=1 at (2 1 2)", "A y=2 at (1 2 2)", "B x=1 at (1 2 2)"}});
}

TEST(FacetContacts, of_a_cavity_are_none) {
  expect_complex(stages::Cavity(), {});
}

TEST(FacetContacts, note_segments_of_one_line) {
  const stages::CoplanarOverlap boxes;
  const Facets facets = boxes.facets();
  const SegmentComplex complex = boxes.facet_contacts(facets);
  Lines found;
  for (const auto& [a, b] : complex.collinear)
    found.push_back(stages::line(complex.nodes, complex.segments[a].from, complex.segments[a].to) + " on " +
                    stages::line(complex.nodes, complex.segments[b].from, complex.segments[b].to));
  EXPECT_EQ(stages::sorted(found), (Lines{"(1 1 2)-(1 2 2) on (1 1 2)-(1 3 2)", "(1 1 2)-(2 1 2) on (1 1 2)-(3 1 2)",
                                          "(1 2 2)-(2 2 2) on (0 2 2)-(2 2 2)", "(2 1 2)-(2 2 2) on (2 0 2)-(2 2 2)"}));
}

TEST(FacetContacts, that_end_inside_both_facets_are_an_error) {
  const stages::CrossingCubes boxes;
  PairContacts contacts = boxes.contacts();
  // One end of a segment is moved into the insides of both faces.
  for (PairContact& pair : contacts.contacts)
    if (pair.contact.count == 2) pair.contact.points[1].first = pair.contact.points[1].second = Place();
  const auto found = find_facet_contacts(boxes.operands(), boxes.facets(), contacts);
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::internal);
  EXPECT_NE(found.error().message.find("one ends inside both"), std::string::npos) << found.error().message;
}

TEST(FacetContacts, audit_sees_damage) {
  const stages::CoplanarOverlap boxes;
  const Facets facets = boxes.facets();
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    SegmentComplex damaged = boxes.facet_contacts(facets);
    damage(damaged);
    const std::string violations = fmt::format("{}", fmt::join(audit(boxes.operands(), facets, damaged), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  const SegmentId first(0);
  // A segment that is a common part alone.
  const auto common = [](const SegmentComplex& c) {
    return *std::ranges::find_if(c.segments.ids(), [&](SegmentId s) { return c.segments[s].edge.is_none(); });
  };
  expect_seen([&](SegmentComplex& c) { c.segments[first].to = c.segments[first].from; }, "segment 0 is a point");
  expect_seen([&](SegmentComplex& c) { c.segments[first].to = NodeId(99); }, "segment 0 names what is not there");
  expect_seen([&](SegmentComplex& c) { c.segments[first] = c.segments[SegmentId(1)]; },
              "segments 0 and 1 are between the same nodes");
  expect_seen([&](SegmentComplex& c) { c.segments[common(c)].first_facet = c.segments[common(c)].second_facet = {}; },
              "is neither an edge nor a common part");
  expect_seen([&](SegmentComplex& c) { c.segments[common(c)].second_facet = {}; }, "is a common part of one facet");
  expect_seen([&](SegmentComplex& c) { c.segments.back().edge = InputEdgeId(0); }, "has other ends than its edge 0");
  expect_seen(
      [&](SegmentComplex& c) {
        c.incidences.push_back({common(c), FacetId(0), FacetSides::left});
      },
      "bounds facet 0, but is not an edge");
  expect_seen(
      [&](SegmentComplex& c) {
        for (const FacetId facet : facets.ids()) c.incidences.push_back({first, facet, FacetSides::both});
      },
      "segment 0 is not in the plane of its facet");
  expect_seen(
      [&](SegmentComplex& c) {
        for (const NodeId node : c.nodes.ids()) c.cuts.push_back({first, node});
      },
      "segment 0 is cut at node");
  expect_seen(
      [&](SegmentComplex& c) {
        for (const NodeId node : c.nodes.ids()) c.touches.push_back({FacetId(0), node});
      },
      "touches facet 0 outside of its plane");
  expect_seen(
      [&](SegmentComplex& c) {
        for (const SegmentId s : c.segments.ids()) c.note_collinear(first, s);
      },
      "are not on one line");
  expect_seen([&](SegmentComplex& c) { c.nodes_of_vertices[0].node = c.nodes_of_vertices[1].node; },
              "is not at its node");
  expect_seen([&](SegmentComplex& c) { c.nodes_of_vertices.push_back(c.nodes_of_vertices[0]); }, "has two nodes");
}

}  // namespace
}  // namespace algebra3d::arrangement
