// Every way in which two small solids can lie to one another, with volumes and numbers of triangles that were worked
// out by hand. A facet with n corners (of all its boundaries; a slit counts both ways) and h holes takes n + 2h - 2
// triangles; a segment that two facets share has to be a whole edge of both, so where bodies touch along an edge each
// facet there has its ends for corners. Points at which bodies merely touch demand nothing.
#include <gtest/gtest.h>

#include <string>

#include "unit/arrangement/micro_cases.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

/// A case moved elsewhere: all maps are exact on its coordinates and multiply volumes by `factor`.
struct Placement {
  const char* name;
  Vec3 (*map)(const Vec3&);
  Rational factor;
};

const std::vector<Placement>& placements() {
  static const std::vector<Placement> all{
      {"as written", [](const Vec3& p) { return p; }, 1},
      {"axes permuted",
       [](const Vec3& p) {
         return Vec3{p.z, p.x, p.y};
       },
       1},
      {"half a turn",
       [](const Vec3& p) {
         return Vec3{-p.x, 1 - p.y, p.z};
       },
       1},
      {"moved by 2^30",
       [](const Vec3& p) {
         return p + Vec3{0x1p30, -0x1p30, 0x1p31};
       },
       1},
      {"scaled by 2^-30", [](const Vec3& p) { return 0x1p-30 * p; }, Rational(0x1p-90)},
      // Twice a turn by the angle whose tangent is 4/3, and five times as large each time.
      {"turned obliquely",
       [](const Vec3& p) {
         const Vec3 q{3 * p.x - 4 * p.y, 4 * p.x + 3 * p.y, 5 * p.z};
         return Vec3{5 * q.x, 3 * q.y - 4 * q.z, 4 * q.y + 3 * q.z};
       },
       15625},
  };
  return all;
}

class MicroCases : public testing::TestWithParam<MicroCase> {};
INSTANTIATE_TEST_SUITE_P(set_operations, MicroCases, testing::ValuesIn(micro_cases()),
                         [](const auto& each) { return std::string(each.param.name); });

void expect(const TriangleMesh& result, const Expected& expected, const Rational& factor, const char* what) {
  EXPECT_EQ(exact_volume_of(result), expected.volume * factor) << what;
  EXPECT_EQ(result.face_count(), expected.triangle_count) << what;
}

TEST_P(MicroCases, have_exact_volumes_and_as_few_triangles_as_possible) {
  const MicroCase& micro = GetParam();
  for (const Placement& placement : placements()) {
    SCOPED_TRACE(placement.name);
    const TriangleMesh a = mapped(micro.a, placement.map), b = mapped(micro.b, placement.map);
    ASSERT_TRUE(prove_volume(a)->is_valid() && prove_volume(b)->is_valid());
    SetOperations engine;
    expect(engine.unite(a, b), micro.united, placement.factor, "A + B");
    expect(engine.unite(b, a), micro.united, placement.factor, "B + A");
    expect(engine.intersect(a, b), micro.common, placement.factor, "A * B");
    expect(engine.intersect(b, a), micro.common, placement.factor, "B * A");
    expect(engine.subtract(a, b), micro.a_without_b, placement.factor, "A - B");
    expect(engine.subtract(b, a), micro.b_without_a, placement.factor, "B - A");
    EXPECT_EQ(engine.complaints(), "");
  }
}

TEST_P(MicroCases, give_back_their_operands) {
  const MicroCase& micro = GetParam();
  SetOperations engine;
  const TriangleMesh united = engine.unite(micro.a, micro.b), common = engine.intersect(micro.a, micro.b);
  const TriangleMesh a_rest = engine.subtract(micro.a, micro.b), b_rest = engine.subtract(micro.b, micro.a);
  const TriangleMesh a = engine.unite(a_rest, common);
  EXPECT_TRUE(engine.same(a, micro.a));
  EXPECT_LE(a.face_count(), micro.a.face_count());
  EXPECT_TRUE(engine.same(engine.unite(b_rest, common), micro.b));
  EXPECT_TRUE(engine.same(engine.unite_all({&a_rest, &common, &b_rest}), united));
  EXPECT_TRUE(engine.same(engine.difference_of_both(micro.a, micro.b), engine.unite(a_rest, b_rest)));
  EXPECT_EQ(engine.complaints(), "");
}

/// The cube of the micro-cases with a wedge that stands on its top with the sharp edge: four faces on that edge, two of
/// them in one plane.
TriangleMesh cube_under_wedge(SetOperations& engine) {
  return engine.unite(cube(0, 4), with_axes_permuted(prism(std::vector<Corner>{{2, 4}, {3, 5}, {1, 5}}, 1, 3), 1));
}

// An operand touched itself along an edge within one of its facets, and lost that edge when another operand touched
// the same facet elsewhere.
TEST(SetOperations, an_edge_within_a_facet_stays_when_another_solid_touches_the_facet) {
  SetOperations engine;
  const TriangleMesh a = cube_under_wedge(engine);
  const TriangleMesh united = engine.unite(a, box({0, 0, 4}, {0.5, 0.5, 5}));
  EXPECT_EQ(exact_volume_of(united), Rational(265, 4));
  EXPECT_EQ(united.face_count(), 36U);
  const TriangleMesh rest = engine.subtract(a, box({0, 0, 3}, {0.5, 0.5, 5}));
  EXPECT_EQ(exact_volume_of(rest), Rational(263, 4));
  EXPECT_EQ(rest.face_count(), 36U);
  EXPECT_EQ(engine.complaints(), "");
}

TEST(SetOperations, an_edge_within_a_facet_goes_with_what_stood_on_it) {
  SetOperations engine;
  const TriangleMesh rest = engine.subtract(cube_under_wedge(engine), box({0, 0, 4}, {4, 4, 5}));
  EXPECT_EQ(exact_volume_of(rest), Rational(64));
  EXPECT_EQ(rest.face_count(), 12U);
  const TriangleMesh buried = engine.unite(cube_under_wedge(engine), box({0, 0, 4}, {4, 4, 5}));
  EXPECT_EQ(exact_volume_of(buried), Rational(80));
  EXPECT_EQ(buried.face_count(), 12U);
  EXPECT_EQ(engine.complaints(), "");
}

TEST(SetOperations, touching_cubes_in_one_union_are_one_cube) {
  SetOperations engine;
  std::vector<TriangleMesh> cubes;
  for (int i = 0; i < 27; ++i) {
    const int row = i / 3, layer = i / 9;
    const Vec3 low{double(i % 3), double(row % 3), double(layer)};
    cubes.push_back(box(low, low + Vec3{1, 1, 1}));
  }
  Solids all;
  for (const TriangleMesh& mesh : cubes) all.push_back(&mesh);
  EXPECT_EQ(engine.unite_all(all).face_count(), 12U);
  EXPECT_TRUE(engine.intersect_all(all).is_empty());
  // Every second cube, touching in edges and corners alone: nothing is merged, no edge is cut.
  Solids chequered;
  for (std::size_t i = 0; i < cubes.size(); i += 2) chequered.push_back(&cubes[i]);
  const TriangleMesh united = engine.unite_all(chequered);
  EXPECT_EQ(united.face_count(), 14U * 12);
  EXPECT_EQ(exact_volume_of(united), Rational(14));
  EXPECT_EQ(engine.complaints(), "");
}

TEST(SetOperations, a_sponge_has_no_triangle_too_many) {
  SetOperations engine;
  TriangleMesh sponge = cube(0, 3);
  for (int axis = 0; axis < 3; ++axis)
    sponge = engine.subtract(sponge, with_axes_permuted(box({1, 1, -1}, {2, 2, 4}), axis));
  EXPECT_EQ(exact_volume_of(sponge), Rational(20));
  // Six sides with a hole of 8 triangles each; six shafts of four walls.
  EXPECT_EQ(sponge.face_count(), 6U * 8 + 6 * 4 * 2);
  EXPECT_EQ(engine.complaints(), "");
}

TEST(SetOperations, nothing_and_one_operand_are_operands_too) {
  SetOperations engine;
  const TriangleMesh nothing, a = cube(0, 4);
  EXPECT_TRUE(engine.unite_all({}).is_empty());
  EXPECT_TRUE(engine.unite(nothing, nothing).is_empty());
  EXPECT_TRUE(engine.intersect(a, nothing).is_empty());
  EXPECT_TRUE(engine.subtract(nothing, a).is_empty());
  EXPECT_TRUE(engine.same(engine.subtract(a, nothing), a));
  EXPECT_TRUE(engine.same(engine.unite_all({&a}), a));
  EXPECT_TRUE(engine.same(engine.intersect_all({&a}), a));
  EXPECT_EQ(engine.complaints(), "");
}

}  // namespace
}  // namespace algebra3d::solids
