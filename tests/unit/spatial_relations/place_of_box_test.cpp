#include "algebra3d/values/spatial_relations/place_of_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/solids.h"

namespace algebra3d {
namespace {

/// The distance between a box and the boundary of a larger one, from coordinates alone.
double distance_from_walls(const Box3& box, const Box3& walls) {
  if (!walls.contains(box)) return distance(box, walls);
  double least = Box3::kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis)
    least = std::min({least, box.min[axis] - walls.min[axis], walls.max[axis] - box.max[axis]});
  return least;
}

// The triangles of a wall have flat boxes, so the bound is the distance but for roundings.
TEST(place_of_box, of_a_box_is_as_its_coordinates_say) {
  const Box3 walls{{0, 0, 0}, {16, 24, 32}};
  const Volume3d solid = Volume3d::trusted(solids::box(walls.min, walls.max));
  const Surface3d surface = Surface3d::trusted(solids::box(walls.min, walls.max));
  solids::Chance chance(18);
  int inside_count = 0, apart_count = 0;
  for (int i = 0; i < 5000; ++i) {
    Box3 box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<double>(chance.below(48)) - 8;
      box.max[axis] = box.min[axis] + static_cast<double>(chance.below(8));
    }
    const bool is_within = walls.contains(box);
    if (!is_within && walls.intersects(box) && distance(box, walls) == 0) {
      EXPECT_EQ(place_of_box(box, solid, 100).gap, 0);  // meets a wall
      continue;
    }
    const double expected = distance_from_walls(box, walls);
    const PlaceOfBox place = place_of_box(box, solid, 100);
    EXPECT_LE(place.gap, expected);
    EXPECT_GE(place.gap, expected * (1 - 1e-4) - 1e-4);
    EXPECT_EQ(place.is_inside, is_within && expected > 0);
    EXPECT_FALSE(place_of_box(box, surface, 100).is_inside);
    inside_count += place.is_inside ? 1 : 0;
    apart_count += place.gap > 0 && !place.is_inside ? 1 : 0;
    if (expected > 0) {
      EXPECT_EQ(place_of_box(box, solid, expected / 2).gap, Box3::kInfinity);
    }
  }
  EXPECT_GT(inside_count, 100);
  EXPECT_GT(apart_count, 100);
}

// The bound holds for points of the boundary, and a box is inside of a convex solid if its corners are.
TEST(place_of_box, of_a_ball_is_a_lower_bound) {
  const TriangleMesh mesh = solids::geodesic_sphere(8);
  const Volume3d ball = Volume3d::trusted(mesh);
  std::vector<Vec3> samples;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef corners = mesh.corners(FaceId(f));
    const Vec3 &a = corners[0].approx, &b = corners[1].approx, &c = corners[2].approx;
    samples.insert(samples.end(), {a, 0.5 * (a + b), (1 / 3.0) * (a + b + c)});
  }
  solids::Chance chance(19);
  int inside_count = 0, apart_count = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 corner{1.5 * chance.unit(), 1.5 * chance.unit(), 1.5 * chance.unit()};
    const double side = 0.2 * std::abs(chance.unit());
    const Box3 box{corner, corner + Vec3{side, side, side}};
    const PlaceOfBox place = place_of_box(box, ball, Box3::kInfinity);
    double nearest = Box3::kInfinity;
    for (const Vec3& p : samples) nearest = std::min(nearest, distance(box, Box3::of(p)));
    EXPECT_LE(place.gap, nearest + 1e-12);
    EXPECT_GE(place.gap, nearest - 0.5);  // the size of the boxes of its faces
    const double farthest = length(Vec3{std::max(std::abs(box.min.x), std::abs(box.max.x)),
                                        std::max(std::abs(box.min.y), std::abs(box.max.y)),
                                        std::max(std::abs(box.min.z), std::abs(box.max.z))});
    // The faces lie within the sphere of radius 1.
    if (place.is_inside) {
      EXPECT_LT(farthest, 1);
    } else if (place.gap > 0) {
      EXPECT_GT(farthest, 0.9);
    }
    inside_count += place.is_inside ? 1 : 0;
    apart_count += place.gap > 0 && !place.is_inside ? 1 : 0;
  }
  EXPECT_GT(inside_count, 30);
  EXPECT_GT(apart_count, 1000);
}

TEST(place_of_box, nothing_is_told_of_points_and_boxes) {
  const Box3 box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(place_of_box(box, Box3{{5, 5, 5}, {6, 6, 6}}, 0).gap, 0);
  EXPECT_EQ(place_of_box(box, PointSet{}, 0).gap, 0);
}

}  // namespace
}  // namespace algebra3d
