// Second stage: what two triangles have in common, by places and without constructing a point.
#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

std::string text(const Place& place) {
  switch (place.kind) {
    case Place::Kind::corner:
      return fmt::format("corner {}", place.index);
    case Place::Kind::edge:
      return fmt::format("edge {}", place.index);
    default:
      return "inside";
  }
}

/// "segment: edge 0 | corner 1, inside | edge 2": its ends, each by its places in the first and second triangle.
std::string text(const TriangleContact& contact) {
  if (contact.is_coplanar) return "coplanar";
  Lines ends;
  for (std::size_t i = 0; i < contact.count; ++i)
    ends.push_back(text(contact.points[i].first) + " | " + text(contact.points[i].second));
  constexpr std::array<const char*, 3> kKinds{"nothing", "point: ", "segment: "};
  return fmt::format("{}{}", kKinds[contact.count], fmt::join(stages::sorted(ends), ", "));
}

Lines text(const Operands& operands, const PairContacts& contacts) {
  Lines lines;
  for (const auto& [first, second, contact] : contacts.contacts)
    lines.push_back(stages::text(operands, first) + " " + stages::text(operands, second) + " " + text(contact));
  return stages::sorted(std::move(lines));
}

/// Triangles as operands: A has the corners (0 0 0), (4 0 0), (0 4 0); its edges 0, 1, 2 lie at y = 0, x + y = 4, x =
/// 0.
class TwoTriangles {
 public:
  TwoTriangles(const Vec3& a, const Vec3& b, const Vec3& c) : second_(solids::Maker().triangle(a, b, c).mesh()) {}

  std::string contact() const {
    const std::array<Operand, 2> list{{{&first_, 0}, {&second_, 1}}};
    const Operands operands(list);
    const FacePair pair{InputFaceId(0), InputFaceId(1)};
    const PairContacts found = find_pair_contacts(operands, {{pair}}, {}).value();
    EXPECT_EQ(audit(operands, found), Lines());
    return found.contacts.empty() ? "nothing" : text(found.contacts[0].contact);
  }

 private:
  TriangleMesh first_ = solids::Maker().triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}).mesh();
  TriangleMesh second_;
};

TEST(PairContacts, of_triangles_that_cross) {
  // Through the inside, upright: the plane z = 0 meets the second one from (1 1 0) on its edge 0 to (1 2 0) on edge 2.
  EXPECT_EQ(TwoTriangles({1, 1, -1}, {1, 1, 1}, {1, 3, 1}).contact(), "segment: inside | edge 0, inside | edge 2");
  // Out across the edge y = 0 of the first one.
  EXPECT_EQ(TwoTriangles({1, 1, -1}, {1, 1, 1}, {1, -3, 1}).contact(), "segment: edge 0 | inside, inside | edge 0");
}

TEST(PairContacts, of_triangles_with_a_shared_face) {
  EXPECT_EQ(TwoTriangles({0, 0, 0}, {4, 0, 0}, {0, 4, 0}).contact(), "coplanar");
  EXPECT_EQ(TwoTriangles({0, 0, 0}, {0, 4, 0}, {4, 0, 0}).contact(), "coplanar");
}

TEST(PairContacts, of_triangles_with_a_shared_edge) {
  EXPECT_EQ(TwoTriangles({0, 0, 0}, {4, 0, 0}, {0, 0, 4}).contact(),
            "segment: corner 0 | corner 0, corner 1 | corner 1");
  // Coplanar, on the other side of the edge.
  EXPECT_EQ(TwoTriangles({0, 0, 0}, {4, 0, 0}, {0, -4, 0}).contact(), "coplanar");
  // A part of the edge.
  EXPECT_EQ(TwoTriangles({1, 0, 0}, {3, 0, 0}, {0, 0, 4}).contact(), "segment: edge 0 | corner 0, edge 0 | corner 1");
}

TEST(PairContacts, of_triangles_with_a_shared_vertex) {
  EXPECT_EQ(TwoTriangles({0, 0, 0}, {-4, 0, 0}, {0, 0, 4}).contact(), "point: corner 0 | corner 0");
  EXPECT_EQ(TwoTriangles({0, 0, 0}, {-4, 0, 0}, {0, -4, 0}).contact(), "coplanar");
}

TEST(PairContacts, of_triangles_that_touch) {
  EXPECT_EQ(TwoTriangles({1, 1, 0}, {0, 0, 4}, {1, 0, 4}).contact(), "point: inside | corner 0");
  EXPECT_EQ(TwoTriangles({1, 0, 0}, {0, 0, 4}, {1, -1, 4}).contact(), "point: edge 0 | corner 0");
  EXPECT_EQ(TwoTriangles({2, -2, 1}, {2, 2, -1}, {2, -2, 4}).contact(), "segment: edge 0 | edge 0, inside | edge 1");
  // Edge on edge: (2 0 0) in the middle of both.
  EXPECT_EQ(TwoTriangles({2, -2, -2}, {2, 2, 2}, {2, -2, 2}).contact(), "point: edge 0 | edge 0");
  // An edge that lies on the face.
  EXPECT_EQ(TwoTriangles({1, 1, 0}, {1, 2, 0}, {1, 1, 4}).contact(), "segment: inside | corner 0, inside | corner 1");
}

TEST(PairContacts, of_triangles_that_do_not_touch) {
  EXPECT_EQ(TwoTriangles({0, 0, 1}, {4, 0, 1}, {0, 4, 1}).contact(), "nothing");
  EXPECT_EQ(TwoTriangles({3, 3, -1}, {3, 3, 1}, {4, 4, 1}).contact(), "nothing");
  // Coplanar and apart.
  EXPECT_EQ(TwoTriangles({3, 3, 0}, {5, 3, 0}, {5, 5, 0}).contact(), "nothing");
}

TEST(PairContacts, of_crossing_cubes) {
  const stages::CrossingCubes boxes;
  const PairContacts found = boxes.contacts();
  EXPECT_EQ(audit(boxes.operands(), found), Lines());
  // The planes x = 4 and y = 2 meet in (4 2 z). Faces A10 and A11 have z <= 2 and z >= 2 of it, B4 and B5 z <= 4 and
  // z >= 4. The other five pairs of sides are the same in other directions.
  EXPECT_EQ(text(boxes.operands(), found), stages::sorted({
                                               "A10 B4 point: edge 2 | edge 0",
                                               "A11 B4 segment: edge 0 | edge 0, edge 1 | edge 2",
                                               "A11 B5 point: edge 1 | edge 0",
                                               // x = 4, z = 2
                                               "A10 B0 point: edge 1 | edge 2",
                                               "A10 B1 segment: edge 1 | edge 0, edge 2 | edge 2",
                                               "A11 B1 point: edge 0 | edge 2",
                                               // y = 4, x = 2
                                               "A6 B8 point: edge 1 | edge 2",
                                               "A6 B9 segment: edge 1 | edge 0, edge 2 | edge 2",
                                               "A7 B9 point: edge 0 | edge 2",
                                               // y = 4, z = 2
                                               "A6 B0 point: edge 2 | edge 0",
                                               "A7 B0 segment: edge 0 | edge 0, edge 1 | edge 2",
                                               "A7 B1 point: edge 1 | edge 0",
                                               // z = 4, x = 2
                                               "A2 B8 point: edge 2 | edge 0",
                                               "A3 B8 segment: edge 0 | edge 0, edge 1 | edge 2",
                                               "A3 B9 point: edge 1 | edge 0",
                                               // z = 4, y = 2
                                               "A2 B4 point: edge 1 | edge 2",
                                               "A2 B5 segment: edge 1 | edge 0, edge 2 | edge 2",
                                               "A3 B5 point: edge 0 | edge 2",
                                           }));
}

TEST(PairContacts, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const PairContacts found = boxes.contacts();
  const auto expect_seen = [&](const auto& damage, const std::string& part) {
    PairContacts damaged = found;
    damage(damaged.contacts.front());
    const std::string violations = fmt::format("{}", fmt::join(audit(boxes.operands(), damaged), "\n"));
    EXPECT_NE(violations.find(part), std::string::npos) << "expected: " << part << "\n" << violations;
  };
  expect_seen([](PairContact& c) { c.contact.count = 0; }, "is not the one in the contact");
  expect_seen([](PairContact& c) { c.contact.is_coplanar = true; }, "is not the one in the contact");
  expect_seen(
      [](PairContact& c) {
        c.contact.points[0].first = {Place::Kind::edge, 3};
      },
      "has a place that does not exist");
  expect_seen([](PairContact& c) { c.contact.points[0].first_runs_along = true; }, "runs along another edge");
  expect_seen([](PairContact& c) { c.second_face = c.first_face; }, "are of operands 0 and 0");
  expect_seen([](PairContact& c) { c.second_face = InputFaceId(99); }, "no such face");
}

/// Few points on a grid of thirds and a hair beside it, so that triangles of them share corners and nearly lie in one
/// plane.
std::vector<ExactPoint> few_points(std::mt19937& random) {
  std::uniform_int_distribution<int> step(-2, 2);
  const Rational hair(1, std::int64_t{1} << 60);
  std::vector<ExactPoint> points;
  for (int i = 0; i < 10; ++i) {
    const auto coordinate = [&](int divisor) {
      return Rational(step(random), divisor) + (step(random) == 0 ? hair : Rational(0));
    };
    points.emplace_back(RationalVec3(coordinate(3), coordinate(3), coordinate(i % 2 == 0 ? 3 : 30)));
  }
  return points;
}

TriangleMesh one_triangle(const TriangleRef& corners) {
  PointArray points;
  for (const PointRef& corner : corners) points.push_back(corner);
  return {std::move(points), std::vector<TriangleMesh::Triangle>{{0, 1, 2}}};
}

/// The audit compares each contact that is found with intersect_triangles, which shares no code with contact_of.
TEST(PairContacts, agree_with_intersect_triangles_where_corners_are_shared_or_nearly_in_one_plane) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  std::array<int, 4> seen{};
  for (int round = 0; round < 300; ++round) {
    const std::vector<ExactPoint> points = few_points(random);
    std::uniform_int_distribution<std::size_t> any(0, points.size() - 1);
    for (int i = 0; i < 60; ++i) {
      const auto corners = [&] { return TriangleRef{points[any(random)], points[any(random)], points[any(random)]}; };
      const TriangleRef first = corners(), second = corners();
      if (collinear(first[0], first[1], first[2]) || collinear(second[0], second[1], second[2])) continue;
      const TriangleMesh first_mesh = one_triangle(first), second_mesh = one_triangle(second);
      const std::array<Operand, 2> list{{{&first_mesh, 0}, {&second_mesh, 1}}};
      const Operands operands(list);
      const PairContacts found = find_pair_contacts(operands, {{{InputFaceId(0), InputFaceId(1)}}}, {}).value();
      const Contact expected = intersect_triangles(first, second);
      ASSERT_EQ(found.contacts.empty(), expected == Contact::none);
      ASSERT_EQ(audit(operands, found), Lines());
      ++seen[static_cast<std::size_t>(expected)];
    }
  }
  for (const int count : seen) EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace algebra3d::arrangement
