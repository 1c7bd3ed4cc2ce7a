#include "algebra3d/kernel/autorefinement/winding_selection.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d::solids {
namespace {

/// One mesh of the triangles of several, equal corners welded or not.
TriangleMesh together(const Solids& meshes, bool welds = true) {
  std::map<ExactPoint, std::uint32_t> numbers;
  PointArray points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const TriangleMesh* mesh : meshes) {
    if (!welds) numbers.clear();
    for (TriangleMesh::Triangle triangle : triangles_of(*mesh)) {
      for (std::uint32_t& corner : triangle) {
        const ExactPoint point = mesh->points().point(corner);
        const auto [entry, is_new] = numbers.try_emplace(point, static_cast<std::uint32_t>(points.size()));
        if (is_new) points.push_back(point);
        corner = entry->second;
      }
      triangles.push_back(triangle);
    }
  }
  return {std::move(points), triangles};
}

TriangleMesh solid_of(const TriangleMesh& mesh, const WindingRule& rule) {
  Result<TriangleMesh> solid = solid_by_winding(mesh, rule);
  EXPECT_TRUE(solid.ok());
  EXPECT_EQ(prove_volume(*solid)->text(), "");
  EXPECT_TRUE(audit(*solid).empty());
  const Result<TriangleMesh> in_sheets = solid_by_winding(*ValidParts::in_sheets(mesh), rule);
  EXPECT_EQ(prove_volume(*in_sheets)->text(), "");
  EXPECT_TRUE(SetOperations().same(*in_sheets, *solid));
  return std::move(solid).value();
}
TriangleMesh inside_of(const TriangleMesh& mesh) {
  return solid_of(mesh, [](int winding) { return winding > 0; });
}

int winding_about(const TriangleMesh& mesh, const ExactPoint& point) {
  int winding = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const LineCrossing crossing = cross_vertical_line(point, mesh.corners(FaceId(f)));
    if (crossing.side == -1) winding += crossing.sign;
  }
  return winding;
}

// Where one part has most of the faces, pairs of near ones are found in another way than for two operands, and lines
// upwards go through many small parts.
TEST(WindingSolid, of_one_large_part_and_many_small_ones) {
  const TriangleMesh torus = samples::torus(110, 100);
  // Across the surface, within the body, in the hole and far away.
  const std::vector<TriangleMesh> cubes{mapped(cube(0, 1),
                                               [](const Vec3& p) {
                                                 return 0.5 * p + Vec3{3.6, 0.1, -0.2};
                                               }),
                                        mapped(cube(0, 1),
                                               [](const Vec3& p) {
                                                 return 0.5 * p + Vec3{0.1, -2.3, 0.1};
                                               }),
                                        mapped(cube(0, 1),
                                               [](const Vec3& p) {
                                                 return 0.25 * p + Vec3{-3, 0, 0};
                                               }),
                                        mapped(cube(0, 1), [](const Vec3& p) { return 0.25 * p; }), cube(9, 10)};
  TriangleMesh expected = torus;
  Solids all{&torus};
  for (const TriangleMesh& one : cubes) {
    all.push_back(&one);
    const std::vector<Operand> both{{&expected, 0}, {&one, 1}};
    auto united =
        combine_solids(both, [](const WindingVector& windings) { return windings[0] > 0 || windings[1] > 0; });
    ASSERT_TRUE(united.ok());
    expected = *std::move(united);
  }
  const TriangleMesh solid = inside_of(together(all));
  EXPECT_EQ(exact_volume_of(solid), exact_volume_of(expected));
  EXPECT_EQ(solid.face_count(), expected.face_count());
}

// Set operations on valid solids are what winding numbers of their triangles, thrown together, say as well.
TEST(WindingSolid, of_two_solids_is_union_intersection_and_difference) {
  for (int seed = 1; seed <= rounds(15); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(static_cast<std::uint64_t>(seed), engine);
    const TriangleMesh a = random.operand(), b = random.operand();
    const TriangleMesh both = together({&a, &b}, seed % 2 == 0);
    EXPECT_TRUE(engine.same(inside_of(both), engine.unite(a, b)));
    EXPECT_TRUE(engine.same(solid_of(both, [](int winding) { return winding > 1; }), engine.intersect(a, b)));
    const TriangleMesh turned = flipped(b);
    EXPECT_TRUE(engine.same(inside_of(together({&a, &turned})), engine.subtract(a, b)));
    EXPECT_TRUE(
        engine.same(solid_of(together({&a, &turned}), [](int winding) { return winding < 0; }), engine.subtract(b, a)));
    EXPECT_EQ(engine.complaints(), "");
  }
}

TEST(WindingSolid, counts_repeated_and_opposite_triangles) {
  const TriangleMesh a = cube(0, 1), turned = flipped(a);
  SetOperations engine;
  EXPECT_TRUE(engine.same(solid_of(together({&a, &a, &a}), [](int winding) { return winding == 3; }), a));
  EXPECT_TRUE(solid_of(together({&a, &a, &a}), [](int winding) { return winding == 2; }).is_empty());
  EXPECT_TRUE(inside_of(together({&a, &turned})).is_empty());
  EXPECT_TRUE(engine.same(inside_of(together({&a, &a, &turned})), a));
  EXPECT_TRUE(inside_of(TriangleMesh()).is_empty());
}

TEST(WindingSolid, of_nested_shells) {
  const TriangleMesh outer = cube(0, 5), middle = cube(1, 4), inner = cube(2, 3), hollow = flipped(middle);
  SetOperations engine;
  EXPECT_EQ(inside_of(together({&outer, &middle, &inner})).face_count(), 12U);
  EXPECT_EQ(exact_volume_of(solid_of(together({&outer, &middle, &inner}), [](int winding) { return winding == 2; })),
            Rational(27 - 1));
  EXPECT_EQ(exact_volume_of(inside_of(together({&outer, &hollow, &inner}))), Rational(125 - 27 + 1));
}

TEST(WindingSolid, leaves_out_what_has_no_volume) {
  const TriangleMesh solid = cube(0, 2);
  SetOperations engine;
  // A fin: twice the same triangle, once each way; and one that is only a line.
  const TriangleMesh fin =
      Maker().triangle({1, 1, 1}, {3, 1, 1}, {3, 3, 2}).triangle({1, 1, 1}, {3, 3, 2}, {3, 1, 1}).mesh();
  EXPECT_TRUE(engine.same(inside_of(together({&solid, &fin})), solid));
  const TriangleMesh line = Maker().triangle({0, 0, 2}, {1, 0, 2}, {2, 0, 2}).mesh();
  EXPECT_TRUE(engine.same(inside_of(together({&solid, &line})), solid));
}

TEST(WindingSolid, closes_what_degenerate_triangles_held_together) {
  // The front side is divided at a corner of the top edge that the top does not have.
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{2, 0, 2}, d{0, 0, 2}, m{1, 0, 2};
  const TriangleMesh whole = cube(0, 2);
  std::vector<TriangleMesh::Triangle> triangles;
  Maker maker;
  for (std::size_t f = 0; f < whole.face_count(); ++f) {
    const TriangleRef t = whole.corners(FaceId(f));
    if (t[0].approx.y == 0 && t[1].approx.y == 0 && t[2].approx.y == 0) continue;
    maker.triangle(t[0].approx, t[1].approx, t[2].approx);
  }
  const TriangleMesh divided = maker.triangle(a, b, m).triangle(b, c, m).triangle(a, m, d).triangle(d, m, c).mesh();
  SetOperations engine;
  EXPECT_TRUE(engine.same(inside_of(divided), whole));
  EXPECT_EQ(inside_of(divided).face_count(), 12U);
}

// The oracle counts crossings of vertical lines with all triangles of the crumpled mesh.
TEST(WindingSolid, of_crumpled_spheres_holds_the_places_with_its_winding_number) {
  for (std::uint64_t seed = 1; seed <= rounds(6U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    const TriangleMesh crumpled = mapped(geodesic_sphere(is_thorough() ? 4 : 3), [&](const Vec3& p) {
      const Vec3 push{chance.unit(), chance.unit(), chance.unit()};
      const Vec3 moved = p + (seed % 3 == 0 ? 1.5 : 0.4) * push;
      if (seed % 2 == 0) return moved;
      // On a coarse grid, where corners fall on edges and faces, and triangles on each other.
      return Vec3{std::round(3 * moved.x), std::round(3 * moved.y), std::round(3 * moved.z)};
    });
    const TriangleMesh welded = together({&crumpled});
    const TriangleMesh positive = inside_of(welded);
    const TriangleMesh twofold = solid_of(welded, [](int winding) { return winding == 2; });
    for (int i = 0; i < (is_thorough() ? 60 : 30); ++i) {
      const ExactPoint point(Vec3{4 * chance.unit(), 4 * chance.unit(), 4 * chance.unit()});
      const int winding = winding_about(welded, point);
      EXPECT_EQ(winding_about(positive, point), static_cast<int>(winding > 0));
      EXPECT_EQ(winding_about(twofold, point), static_cast<int>(winding == 2));
    }
  }
}

}  // namespace
}  // namespace algebra3d::solids
