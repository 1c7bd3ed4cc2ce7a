// Rounded results of all degenerate families against the definition of a valid solid, by CGAL's exact intersections of
// all pairs of triangles whose boxes meet. Each solid is rounded to doubles, to floats and to a coarse grid. Results
// that moved by more than 64 units are listed.
#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <string>

#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/search/boxes.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/faults_by_cgal.h"

namespace algebra3d::solids {
namespace {

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
  int results = 0, moved = 0, far = 0, points_inside = 0;
  std::size_t contacts = 0;
  std::map<std::string, int> methods;
  for (std::uint64_t seed = 1; seed <= rounds(15U); ++seed) {
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
        EXPECT_TRUE(rounded->reason.starts_with("a coordinate is out of range")) << rounded->reason;
        continue;
      }
      moved += static_cast<int>(rounded->moved_vertices > 0);
      ++methods[name_of(rounded->method)];
      const Faults faults = faults_of(*rounded->mesh);
      EXPECT_EQ(faults.degenerate, 0);
      EXPECT_EQ(faults.improper_pairs, 0);
      EXPECT_EQ(faults.unbalanced_edges, 0);
      points_inside += faults.points_inside;
      contacts += rounded->contact_vertices;
      const double units = rounded->largest_movement / grids[g].spacing_up_to(size);
      if (units > 64) {
        ++far;
        std::cout << name << ": moved by " << units << " units, " << name_of(rounded->method) << ", reach "
                  << rounded->reach / grids[g].spacing_up_to(size) << ", " << solid.face_count() << " triangles\n";
      }
      EXPECT_EQ(rounded_solid(*rounded->mesh, grids[g])->moved_vertices, 0U);
    }
  }
  std::cout << results << " results, " << moved << " with moved vertices, " << far << " moved by more than 64 units; "
            << points_inside << " points of contact inside edges or faces of pairs, " << contacts
            << " vertices there\n";
  for (const auto& [method, times] : methods) std::cout << times << " by: " << method << "\n";
  EXPECT_GT(moved, results / 4);
}

}  // namespace
}  // namespace algebra3d::solids
