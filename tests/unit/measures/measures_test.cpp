// Clashes and measures of solids with slanted faces, by hand; what cannot be counted in cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/values/measures/clash.h"
#include "algebra3d/values/measures/common_volume.h"
#include "algebra3d/values/measures/contact_area.h"
#include "algebra3d/values/measures/detail/ray_sections.h"
#include "algebra3d/values/measures/hausdorff_distance.h"
#include "algebra3d/values/measures/ray_hits.h"
#include "algebra3d/values/measures/thickness.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d {
namespace {

Volume3d box_solid(const Vec3& low, const Vec3& high) {
  return Volume3d::trusted(solids::box(low, high));
}
Volume3d tetrahedron_solid(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return Volume3d::trusted(solids::tetrahedron(a, b, c, d));
}

Volume3d combined(const Volume3d& a, const Volume3d& b, const KeepRule& rule) {
  const std::array<Operand, 2> operands{{{&a.mesh(), 0}, {&b.mesh(), 1}}};
  return Volume3d::trusted(*combine_solids(operands, rule));
}

TEST(Clash, ATipInAFace) {
  // A tip that points down into the top face of a cube, to the depth 1/2.
  const Volume3d cube = box_solid({0, 0, 0}, {8, 8, 8});
  const Volume3d tip = tetrahedron_solid({4, 4, 7.5}, {3, 3, 9}, {5, 3, 9}, {4, 6, 9});
  const auto clash = clash_of(cube, tip, 0);
  ASSERT_TRUE(clash.ok() && *clash);
  EXPECT_EQ((*clash)->kind, ClashKind::protrusion);
  EXPECT_EQ((*clash)->squared_depth, Rational(1, 4));
  EXPECT_EQ((*clash)->point, ExactPoint(Vec3{4, 4, 7.5}));
  const auto swapped = clash_of(tip, cube, 0);
  EXPECT_EQ((*swapped)->squared_depth, Rational(1, 4));
  EXPECT_EQ((*swapped)->point, (*clash)->point);
  EXPECT_EQ((*swapped)->second_face, (*clash)->first_face);
}

TEST(Clash, ARingRoundABarIsNotDivided) {
  const auto outside = [](const WindingVector& w) { return w[0] > 0 && w[1] == 0; };
  const Volume3d ring = combined(box_solid({0, 0, 0}, {8, 8, 2}), box_solid({2, 2, -1}, {6, 6, 3}), outside);
  EXPECT_EQ((*clash_of(ring, box_solid({1, 1, -4}, {7, 7, 6}), 0))->kind, ClashKind::protrusion);
  EXPECT_EQ((*clash_of(ring, box_solid({2, 2, -4}, {6, 6, 6}), 0))->kind, ClashKind::touching);
  EXPECT_EQ((*clash_of(ring, box_solid({3, 3, 0}, {5, 5, 2}), Rational(2)))->kind, ClashKind::clearance);
  EXPECT_FALSE(*clash_of(ring, box_solid({3, 3, 0}, {5, 5, 2}), 1));
}

TEST(Clash, WholeBodiesInCommonHaveNoDepth) {
  const auto any = [](const WindingVector& w) { return w[0] > 0 || w[1] > 0; };
  const Volume3d shared = box_solid({0, 0, 0}, {1, 1, 1});
  const Volume3d a = combined(shared, box_solid({5, 0, 0}, {6, 1, 1}), any);
  const Volume3d b = combined(shared, box_solid({9, 0, 0}, {11, 1, 1}), any);
  const auto clash = clash_of(a, b, 0);
  ASSERT_TRUE(clash.ok() && *clash);
  EXPECT_EQ((*clash)->kind, ClashKind::protrusion);
  EXPECT_EQ((*clash)->squared_depth, Rational(0));
}

TEST(Clash, PartsOfDifferentBodiesAreNoDivision) {
  const auto any = [](const WindingVector& w) { return w[0] > 0 || w[1] > 0; };
  const Volume3d two = combined(box_solid({0, 0, 0}, {2, 2, 2}), box_solid({4, 0, 0}, {6, 2, 2}), any);
  const auto kind_with = [&](const Volume3d& other) { return (*clash_of(two, other, 0))->kind; };
  EXPECT_EQ(kind_with(box_solid({1, -1, -1}, {5, 3, 3})), ClashKind::protrusion);
  EXPECT_EQ(kind_with(box_solid({0.5, -1, -1}, {1, 3, 3})), ClashKind::piercing);
  // Bodies that touch in an edge, each with a corner cut off.
  const Volume3d touching = combined(box_solid({0, 0, 0}, {2, 2, 2}), box_solid({2, 2, 0}, {4, 4, 2}), any);
  EXPECT_EQ((*clash_of(touching, box_solid({1, 1, -1}, {3, 3, 1}), 0))->kind, ClashKind::protrusion);
  // A body in the cavity of another one; the other solid is divided by the wall, or neither is.
  const auto first = [](const WindingVector& w) { return w[0] > 0 && w[1] == 0; };
  const Volume3d hollow = combined(box_solid({0, 0, 0}, {10, 10, 10}), box_solid({1, 1, 1}, {9, 9, 9}), first);
  const Volume3d nested = combined(hollow, box_solid({3, 3, 3}, {7, 7, 7}), any);
  EXPECT_EQ((*clash_of(nested, box_solid({-1, 4, 4}, {5, 6, 6}), 0))->kind, ClashKind::piercing);
  EXPECT_EQ((*clash_of(nested, box_solid({0.5, 4, 4}, {5, 6, 6}), 0))->kind, ClashKind::protrusion);
}

TEST(Clash, EmptySolidsDoNotClash) {
  EXPECT_FALSE(*clash_of(Volume3d(), box_solid({0, 0, 0}, {1, 1, 1}), 1000));
}

TEST(Clash, CanBeCancelled) {
  const std::atomic<bool> cancel = true;
  const Volume3d a = box_solid({0, 0, 0}, {2, 2, 2}), b = box_solid({1, 1, 1}, {3, 3, 3});
  EXPECT_EQ(clash_of(a, b, 0, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(contact_area(a.geometry(), b.geometry(), &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(common_volume(a, b, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(hausdorff_distance(a, b, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(facet_thicknesses(a, &cancel).error().code, ErrorCode::interrupted);
}

TEST(ContactArea, SlantedFaces) {
  // Two tetrahedra on both sides of a triangle with the sides 7 sqrt(2): its area is 24.5 sqrt(3).
  const Volume3d below = tetrahedron_solid({7, 0, 0}, {0, 7, 0}, {0, 0, 7}, {0, 0, 0});
  const Volume3d above = tetrahedron_solid({7, 0, 0}, {0, 7, 0}, {0, 0, 7}, {9, 9, 9});
  EXPECT_EQ(*contact_area(below.geometry(), above.geometry()), std::sqrt(1800.75));
}

TEST(CommonVolume, CornersOfCubes) {
  // x + y + z <= 1 of the unit cube is a sixth of it.
  const Volume3d cube = box_solid({0, 0, 0}, {1, 1, 1});
  const Volume3d large = tetrahedron_solid({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-5, -5, -5});
  EXPECT_EQ(*common_volume(cube, large), Rational(1, 6));
}

TEST(RayHits, AnExactPointInASlope) {
  const Volume3d solid = tetrahedron_solid({7, 0, 0}, {0, 7, 0}, {0, 0, 7}, {0, 0, 0});
  const Rational third(1, 3);
  const auto hits = ray_hits(solid, RationalVec3(1, 1, 1), RationalVec3(1, 1, 1));
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].first, Rational(4, 3));
  EXPECT_EQ(hits[0].kind, RayHitKind::leaving);
  EXPECT_EQ(hits[0].first_point, ExactPoint(RationalVec3(7 * third, 7 * third, 7 * third)));
}

TEST(RayHits, SurfacesHaveFrontsAndBacks) {
  solids::Maker maker;
  const Surface3d square = Surface3d::trusted(maker.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}).mesh());
  const auto kind_of = [&](const RationalVec3& from, const RationalVec3& direction) {
    const auto hits = ray_hits(square, from, direction);
    EXPECT_EQ(hits.size(), 1U);
    return hits[0].kind;
  };
  EXPECT_EQ(kind_of({1, 1, 3}, {0, 0, -1}), RayHitKind::entering);  // on the diagonal of the two triangles
  EXPECT_EQ(kind_of({1, 1, -3}, {0, 0, 1}), RayHitKind::leaving);
  EXPECT_EQ(kind_of({-1, 1, 0}, {1, 0, 0}), RayHitKind::touching);
  EXPECT_TRUE(ray_hits(square, {-1, 1, 1}, {1, 0, 0}).empty());
}

TEST(RayHits, BothEndsOfTheRangeOfDoubles) {
  for (const double size : {0x1p-1070, 0x1p1000}) {
    const Volume3d solid = box_solid({0, 0, 0}, {size, size, size});
    const Rational half = Rational(size) / 2;
    const auto hits = ray_hits(solid, RationalVec3(-half, half, half), RationalVec3(half, half / 4, 0));
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_EQ(hits[0].first, 1);
    EXPECT_EQ(hits[1].first, Rational(3));
  }
}

/// Against the sections of all triangles with each ray.
void expect_exact_thickness(const Volume3d& solid) {
  const auto all = facet_thicknesses(solid);
  for (const FacetThickness& facet : *all) {
    const TriangleRef triangle = solid.mesh().corners(facet.face);
    const RationalVec3 a = triangle[0].rational(), u = triangle[1].rational() - a, v = triangle[2].rational() - a;
    const Ray ray{a + Rational(1, 3) * (u + v), cross(v, u)};
    const auto sections = sections_of(ray, solid.geometry());
    const auto first = std::ranges::find_if(sections, [](const RaySection& s) { return s.first.sign() > 0; });
    ASSERT_NE(first, sections.end());
    EXPECT_EQ(facet.opposite, first->face);
    EXPECT_EQ(facet.thickness, (first->first * first->first * dot(ray.direction, ray.direction)).nearest_root());
  }
}

/// A prism over a regular polygon: the rays from its sides end in the diagonals of the sides across.
Volume3d prism_solid(unsigned n, double radius, double height, const Vec3& centre, const RationalVec3& shift = {}) {
  PointArray points;
  std::vector<IndexTriangle> triangles;
  for (unsigned i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    for (const double z : {0.0, height})
      points.push_back(
          ExactPoint(RationalVec3(centre + Vec3{radius * std::cos(angle), radius * std::sin(angle), z}) + shift));
    const unsigned a = 2 * i, b = 2 * ((i + 1) % n);
    triangles.insert(triangles.end(), {{a, b, a + 1}, {b, b + 1, a + 1}});
    if (i > 1) triangles.insert(triangles.end(), {{0, a, a - 2}, {1, a - 1, a + 1}});
  }
  return Volume3d::trusted(TriangleMesh(std::move(points), triangles));
}

TEST(Thickness, IsThatOfExactRays) {
  for (const unsigned n : {3U, 4U, 7U, 8U, 40U})
    for (const Vec3& centre : {Vec3{0, 0, 0}, Vec3{0.1, 0.2, 0.3}, Vec3{1e6, -1e5, 3}}) {
      SCOPED_TRACE(std::to_string(n) + " at " + std::to_string(centre.x));
      expect_exact_thickness(prism_solid(n, 2, 0.7, centre));
    }
  expect_exact_thickness(box_solid({0.1, 0.2, 0.3}, {0.7, 0.5, 1.9}));
  expect_exact_thickness(box_solid({1e-30, 0, 0}, {1, 1e-20, 1}));
  // Corners that are not doubles.
  expect_exact_thickness(
      prism_solid(12, 2, 0.7, {0, 0, 0}, RationalVec3(Rational(1, 3), Rational(1, 7), Rational(1, 11))));
}

TEST(Thickness, ASlantedWall) {
  // Behind the slanted face of the corner, the ray from (7/3, 7/3, 7/3) ends in the origin.
  const Volume3d solid = tetrahedron_solid({7, 0, 0}, {0, 7, 0}, {0, 0, 7}, {0, 0, 0});
  const auto all = facet_thicknesses(solid);
  const auto slanted = std::ranges::find_if(*all, [&](const FacetThickness& facet) {
    return centroid_of(solid.mesh().corners(facet.face)) ==
           ExactPoint(RationalVec3(Rational(7, 3), Rational(7, 3), Rational(7, 3)));
  });
  ASSERT_NE(slanted, all->end());
  EXPECT_EQ(slanted->thickness, Rational(49, 3).nearest_root());
}

}  // namespace
}  // namespace algebra3d
