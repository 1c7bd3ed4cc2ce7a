// Rounded results of all degenerate families against the definition of a valid solid, by CGAL's exact intersections of
// all pairs of triangles whose boxes meet. ALGEBRA3D_ROUNDS sets how many solids (60 without it); each is rounded to
// doubles, to floats and to a coarse grid. Results that moved by more than 64 units are listed.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

#include "algebra3d/exact/affine_map.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/rounding/rounded_solid.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;

std::vector<Kernel::Triangle_3> triangles_of_cgal(const TriangleMesh& mesh) {
  std::vector<Kernel::Triangle_3> triangles;
  const auto point = [](const PointRef& p) { return Kernel::Point_3(p.approx.x, p.approx.y, p.approx.z); };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    triangles.emplace_back(point(t[0]), point(t[1]), point(t[2]));
  }
  return triangles;
}

bool is_edge_of(const Kernel::Segment_3& part, const Kernel::Triangle_3& t) {
  for (int i = 0; i < 3; ++i) {
    const Kernel::Segment_3 edge(t[i], t[i + 1]);
    if (edge == part || edge.opposite() == part) return true;
  }
  return false;
}

bool is_corner_of(const Kernel::Point_3& point, const Kernel::Triangle_3& t) {
  return point == t[0] || point == t[1] || point == t[2];
}

/// Counts of faults that the definition forbids, and of points of contact, which it allows.
struct Faults {
  int degenerate = 0, improper_pairs = 0, unbalanced_edges = 0;
  int points_inside = 0;  ///< pairs that share one point, which is no corner of both
};

Faults faults_of(const TriangleMesh& mesh) {
  Faults faults;
  const std::vector<Kernel::Triangle_3> triangles = triangles_of_cgal(mesh);
  for (const Kernel::Triangle_3& t : triangles) faults.degenerate += static_cast<int>(t.is_degenerate());
  if (faults.degenerate > 0) return faults;
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Kernel::Triangle_3*>;
  std::vector<Box> boxes;
  for (const Kernel::Triangle_3& t : triangles) boxes.emplace_back(t.bbox(), &t);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const Kernel::Triangle_3 &s = *a.handle(), &t = *b.handle();
    const auto common = CGAL::intersection(s, t);
    if (!common) return;
    if (const auto* point = boost::get<Kernel::Point_3>(&*common))
      faults.points_inside += static_cast<int>(!is_corner_of(*point, s) || !is_corner_of(*point, t));
    else if (const auto* segment = boost::get<Kernel::Segment_3>(&*common))
      faults.improper_pairs += static_cast<int>(!is_edge_of(*segment, s) || !is_edge_of(*segment, t));
    else
      ++faults.improper_pairs;
  });
  std::map<std::pair<Vec3, Vec3>, int> balance;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const TriangleRef t = mesh.corners(FaceId(f));
      const Vec3 &from = t[i].approx, &to = t[(i + 1) % 3].approx;
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  for (const auto& [edge, excess] : balance) faults.unbalanced_edges += static_cast<int>(excess != 0);
  return faults;
}

TriangleMesh turned_a_little(const TriangleMesh& solid, Chance& chance) {
  const double degrees = std::pow(10.0, -chance.between(1, 14));
  const AffineMap turn =
      *AffineMap::rotation(RationalVec3(chance.direction()), RationalVec3(chance.direction()), degrees);
  return mapped(solid, [&](const Vec3& p) { return turn.apply_rounded(ExactPoint(p)); });
}

TriangleMesh random_result(std::uint64_t seed) {
  Chance chance(seed + 1'000'000);
  SetOperations engine;
  RandomSolids random(seed, engine);
  const TriangleMesh a = random.operand();
  const TriangleMesh b =
      a.points().exact_count() == 0 && chance.one_in(3) ? turned_a_little(a, chance) : random.operand();
  if (!prove_volume(b)->is_valid()) return engine.unite(a, random.operand());
  switch (chance.below(3)) {
    case 0:
      return engine.unite(a, b);
    case 1:
      return engine.subtract(a, b);
    default:
      return engine.unite(engine.subtract(a, b), engine.subtract(b, a));
  }
}

TEST(RoundingOracle, rounded_results_are_valid) {
  const char* rounds = std::getenv("ALGEBRA3D_ROUNDS");
  const std::uint64_t count = rounds != nullptr ? std::stoull(rounds) : 60;
  int results = 0, moved = 0, far = 0, points_inside = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const TriangleMesh solid = random_result(seed);
    const double size = largest_coordinate(solid);
    const double step = size * (0.002 + 0.05 * static_cast<double>(seed % 11) / 11);
    const std::array<CoordinateGrid, 3> grids = {CoordinateGrid::doubles(), CoordinateGrid::floats(),
                                                 CoordinateGrid::multiples(step > 0 ? step : 1)};
    for (std::size_t g = 0; g < grids.size(); ++g) {
      const std::string name = "seed " + std::to_string(seed) + " grid " + std::to_string(g);
      SCOPED_TRACE(name);
      const auto rounded = rounded_solid(solid, grids[g]);
      ASSERT_TRUE(rounded.ok());
      ++results;
      if (!rounded->mesh) {
        EXPECT_STREQ(rounded->reason, "a coordinate is out of range");
        continue;
      }
      moved += static_cast<int>(rounded->moved_vertices > 0);
      const Faults faults = faults_of(*rounded->mesh);
      EXPECT_EQ(faults.degenerate, 0);
      EXPECT_EQ(faults.improper_pairs, 0);
      EXPECT_EQ(faults.unbalanced_edges, 0);
      points_inside += faults.points_inside;
      const double units = rounded->largest_movement / grids[g].spacing_up_to(size);
      if (units > 64) {
        ++far;
        std::cout << name << ": moved by " << units << " units, reach " << rounded->reach / grids[g].spacing_up_to(size)
                  << ", " << solid.face_count() << " triangles\n";
      }
      EXPECT_EQ(rounded_solid(*rounded->mesh, grids[g])->moved_vertices, 0U);
    }
  }
  std::cout << results << " results, " << moved << " with moved vertices, " << far << " moved by more than 64 units; "
            << points_inside << " points of contact inside edges or faces\n";
  EXPECT_GT(moved, results / 4);
}

}  // namespace
}  // namespace algebra3d::solids
