// Regions as surfaces and solids, and back.
#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/planar/polygon_measures.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "algebra3d/kernel/validity/validity.h"
#include "algebra3d/values/types/planar.h"
#include "support/plane_shapes.h"
#include "unit/operators/call_operator.h"

namespace algebra3d::regions_tests {
namespace {

using calls::call;
using plane_shapes::box;
using plane_shapes::Cycle;
using plane_shapes::on_grid;
using plane_shapes::reversed;
using plane_shapes::star;

Region region(const std::vector<plane_shapes::Face>& faces) {
  const auto proved = Region::prove(plane_shapes::polygons_of(faces));
  EXPECT_TRUE(proved.ok() && *proved) << (proved.ok() ? proved->reason() : proved.error().text());
  return **proved;
}

bool equal(const Region& a, const Region& b) {
  return compare(Value::of(a), Value::of(b)) == 0;
}

std::vector<Region> samples() {
  std::mt19937_64 random(1);
  std::vector<Region> regions{
      region({{box(0, 0, 4, 4)}}),
      region({{box(0, 0, 4, 4), box(1, 1, 3, 3)}}),
      region({{box(0, 0, 8, 8), box(1, 1, 7, 7)}, {box(2, 2, 6, 6), box(3, 3, 5, 5)}}),
      region({{box(0, 0, 1, 1)}, {box(1, 1, 2, 2)}}),         // touch in a corner
      region({{box(0, 0, 4, 4), {{0, 2}, {1, 1}, {1, 3}}}}),  // a hole that touches the outer segment
      region({{box(0, 0, 4, 4), {{1, 1}, {2, 2}, {1, 2}}, {{2, 2}, {3, 2}, {3, 3}}}}),  // holes that touch
      region({{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}}}}),  // corners in the middle of segments
  };
  for (int i = 0; i < 10; ++i)
    regions.push_back(region({{on_grid(star(10 + i, 0.4, 5, random)), on_grid(star(3 + i, 0.333333, 1.5, random))}}));
  return regions;
}

TEST(Regions, the_surface_is_valid_and_has_the_area) {
  for (const Region& sample : samples()) {
    const auto surface = call("region2surface", sample).get<Surface3d>();
    EXPECT_EQ(prove_surface(surface.mesh())->text(), "");
    Rational doubled;
    for (std::uint32_t f = 0; f < surface.mesh().face_count(); ++f) {
      const TriangleRef t = surface.mesh().corners(FaceId(f));
      const RationalVec3 a = t[0].rational(), b = t[1].rational(), c = t[2].rational();
      const Rational own = cross(b - a, c - a).z;
      EXPECT_GT(own.sign(), 0);
      doubled += own;
    }
    EXPECT_EQ(doubled, doubled_area(sample.polygons()));
  }
}

TEST(Regions, the_prism_is_valid_and_has_the_area_times_the_height) {
  for (const Region& sample : samples())
    for (const double height : {3.0, -0.5, 0.1}) {
      const auto solid = call("region2volume", sample, height).get<Volume3d>();
      EXPECT_EQ(prove_volume(solid.mesh())->text(), "");
      EXPECT_EQ(*exact_volume(solid.mesh().points(), triangles_of(solid.mesh())),
                doubled_area(sample.polygons()) / Rational(2) * Rational(height).abs());
      for (const double part : {0.0, 0.5, 1.0})
        EXPECT_TRUE(equal(call("slice", solid, part * height).get<Region>(), sample)) << part;
      EXPECT_TRUE(equal(call("projectXY", solid).get<Region>(), sample));
    }
}

TEST(Regions, shadows_of_solids_that_overlap_are_what_they_cover_together) {
  const Region a = region({{box(0, 0, 4, 4), box(1, 1, 3, 3)}}), b = region({{box(2, 2, 6, 6)}});
  const auto below = call("region2volume", a, 1.0).get<Volume3d>();
  const auto above =
      call("translate", call("region2volume", b, 1.0).get<Volume3d>(), calls::vector(0, 0, 5)).get<Volume3d>();
  const auto both = call("union", below, above).get<Volume3d>();
  EXPECT_TRUE(equal(call("projectXY", both).get<Region>(), call("union", a, b).get<Region>()));
}

// Of rectangles on a grid, by its cells.
TEST(Regions, set_operations_are_those_of_the_cells) {
  std::mt19937_64 random(3);
  constexpr int kSize = 6;
  using Cells = std::array<std::array<bool, kSize>, kSize>;
  const auto area_of_cells = [](const Cells& a, const Cells& b, auto rule) {
    int count = 0;
    for (int x = 0; x < kSize; ++x)
      for (int y = 0; y < kSize; ++y) count += rule(a[x][y], b[x][y]) ? 1 : 0;
    return static_cast<double>(count);
  };
  const auto random_cells = [&] {
    Cells cells;
    for (auto& column : cells)
      for (bool& cell : column) cell = random() % 2 == 0;
    return cells;
  };
  const auto region_of = [&](const Cells& cells) {
    Region result;
    for (int x = 0; x < kSize; ++x)
      for (int y = 0; y < kSize; ++y)
        if (cells[x][y])
          result = call("union", result, region({{plane_shapes::shifted(box(0, 0, 1, 1), x, y)}})).get<Region>();
    return result;
  };
  for (int trial = 0; trial < 5; ++trial) {
    const Cells a = random_cells(), b = random_cells();
    const Region p = region_of(a), q = region_of(b);
    EXPECT_FALSE(polygon_defect(p.polygons())->has_value());
    const auto area_after = [&](const char* op) { return call("area", call(op, p, q).get<Region>()).get<double>(); };
    EXPECT_EQ(area_after("union"), area_of_cells(a, b, [](bool i, bool j) { return i || j; }));
    EXPECT_EQ(area_after("intersection"), area_of_cells(a, b, [](bool i, bool j) { return i && j; }));
    EXPECT_EQ(area_after("minus"), area_of_cells(a, b, [](bool i, bool j) { return i && !j; }));
    EXPECT_EQ(area_after("symmetricDifference"), area_of_cells(a, b, [](bool i, bool j) { return i != j; }));
    const Region back =
        call("union", call("minus", p, q).get<Region>(), call("intersection", p, q).get<Region>()).get<Region>();
    EXPECT_TRUE(equal(back, p));
    EXPECT_EQ(hash(Value::of(back)), hash(Value::of(p)));
  }
}

}  // namespace
}  // namespace algebra3d::regions_tests
