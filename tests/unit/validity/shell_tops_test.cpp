#include "algebra3d/kernel/validity/shell_tops.h"

#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/validity/detail/winding.h"
#include "algebra3d/kernel/validity/validity.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;

/// Boxes in boxes, and the winding number in front of each, which follows from how they are nested.
struct Nest {
  MeshMaker maker;
  std::vector<int> fronts;

  /// A box that looks outward or inward, where the winding number is `outside` without it. Gives that within it.
  int box(const Vec3& low, const Vec3& high, bool is_outward, int outside) {
    maker.box(low, high, !is_outward);
    // Going in through the front of an outward box adds one; an inward one has its front within.
    fronts.push_back(is_outward ? outside : outside - 1);
    return is_outward ? outside + 1 : outside - 1;
  }
};

/// One or two boxes, each with more within.
void fill(Nest& nest, const Vec3& low, double size, int outside, int depth, std::mt19937& random) {
  const int count = 1 + static_cast<int>(random() % 2);
  for (int i = 0; i < count; ++i) {
    const double inner = size / 4;
    const double at = i * size / 2 + size / 8;
    const Vec3 from = low + Vec3{at, at, at};
    const Vec3 to = from + Vec3{inner, inner, inner};
    const int within = nest.box(from, to, random() % 2 == 0, outside);
    if (depth > 0) fill(nest, from, inner, within, depth - 1, random);
  }
}

/// A map that leaves nothing parallel to an axis; with thirds, so that no corner is a double, or with halves.
AffineMap slanted(bool has_thirds) {
  const auto map = AffineMap::rotation(RationalVec3(), RationalVec3(1, 2, 3), 37);
  const Rational shift(1, has_thirds ? 3 : 2);
  return map->then(AffineMap::translation(RationalVec3(shift, shift, shift)));
}

TriangleMesh rounded(const TriangleMesh& mesh, const AffineMap& map) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < mesh.points().size(); ++i) points.push_back(map.apply_rounded(mesh.points()[i]));
  return {PointArray(std::move(points)), image_triangles(map, mesh)};
}

TEST(ShellTops, windings_follow_from_how_shells_are_nested) {
  std::mt19937 random(3);  // NOLINT(cert-msc51-cpp): the same numbers each time
  for (int round = 0; round < 12; ++round) {
    Nest nest;
    for (int i = 0; i < 24; ++i) fill(nest, {64.0 * i, 0, 0}, 64, 0, 4, random);
    ASSERT_GT(nest.fronts.size(), 64U);
    const TriangleMesh mesh = nest.maker.mesh();
    EXPECT_EQ(find_shell_windings(mesh)->fronts, nest.fronts);
    EXPECT_EQ(find_shell_windings(rounded(mesh, slanted(false)))->fronts, nest.fronts);
    if (round > 0) continue;
    EXPECT_EQ(find_shell_windings(**exact_image(slanted(true), mesh))->fronts, nest.fronts);
  }
}

TEST(ShellTops, shells_that_touch_at_their_tops_are_told_apart) {
  // Chains of boxes that touch in corners; in every second one a box that looks inward and touches its wall from within
  // in the middle of an edge, in a corner of its own.
  Nest nest;
  for (int i = 0; i < 40; ++i) {
    const double k = 8 * i;
    const int within = nest.box({k, k, k}, {k + 8, k + 8, k + 8}, true, 0);
    nest.maker.tetrahedron({k + 2, k + 2, k + 2}, {k + 4, k + 2, k + 2}, {k + 2, k + 4, k + 2}, {k + 8, k + 4, k + 8});
    nest.fronts.push_back(within);
  }
  for (const bool is_slanted : {false, true}) {
    const TriangleMesh mesh = is_slanted ? **exact_image(slanted(true), nest.maker.mesh()) : nest.maker.mesh();
    EXPECT_EQ(find_shell_windings(mesh)->fronts, nest.fronts);
  }
}

TEST(ShellTops, touching_tops_are_not_known) {
  const TriangleMesh mesh = MeshMaker()
                                .box({0, 0, 0}, {8, 8, 8})
                                .tetrahedron({2, 2, 2}, {4, 2, 2}, {2, 4, 2}, {8, 4, 8})
                                .tetrahedron({2.5, 2.75, 1}, {3, 2.75, 0.5}, {2.5, 3, 0.5}, {2.75, 2.8125, 0.25})
                                .mesh();
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  const BoxHierarchy hierarchy(mesh, faces);
  const ShellWindings shells = *find_shell_windings(mesh);
  const ShellTops tops(mesh, hierarchy, shells.shell_of_face, 3);
  EXPECT_FALSE(tops.overhead(0).face.is_valid());
  EXPECT_FALSE(tops.overhead(1).is_known);
  EXPECT_TRUE(tops.overhead(2).is_known);
  EXPECT_EQ(shell_orientations(mesh, shells.shell_of_face, 3), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(tops.from_highest(), (std::vector<std::uint32_t>{0, 1, 2}));
}

/// Cubes within each other, in turn bodies and cavities.
TriangleMesh nested_cubes(int count) {
  MeshMaker maker;
  for (int i = 0; i < count; ++i) {
    const double low = i, high = 3.0 * count - i;
    maker.box({low, low, low}, {high, high, high}, i % 2 == 1);
  }
  return maker.mesh();
}

std::uint64_t questions_of_proof(const TriangleMesh& mesh) {
  reset_exact_counters();
  EXPECT_TRUE(prove_volume(mesh)->is_valid());
  return exact_counters().calls;
}

TEST(ShellTops, proving_nested_shells_asks_few_questions_for_each) {
  // A ray through all that lies around each shell would ask some 2 n^2.
  const std::uint64_t few = questions_of_proof(nested_cubes(200)), many = questions_of_proof(nested_cubes(800));
  EXPECT_LT(many, 6 * few);
  EXPECT_LT(many, 100U * 12 * 800);
}

TEST(ShellTops, proving_slanted_nested_shells_needs_no_rationals) {
  const TriangleMesh mesh = rounded(nested_cubes(200), slanted(false));
  reset_exact_counters();
  EXPECT_TRUE(prove_volume(mesh)->is_valid());
  EXPECT_LT(exact_counters().big_fallbacks, mesh.face_count());
}

/// What a proof of the rounded image says with the help of the mesh, and without.
struct Verdicts {
  bool with, without;
};

Verdicts verdicts(const AffineMap& map, const TriangleMesh& mesh) {
  const TriangleMesh image = rounded(mesh, map);
  const Preimage preimage = preimage_of(map, mesh, image.points().approx());
  EXPECT_NE(preimage.mesh, nullptr);
  return {prove_volume(image, {.preimage = preimage})->is_valid(), prove_volume(image)->is_valid()};
}

TEST(Preimage, a_proof_with_its_help_finds_what_rounding_broke) {
  // Thin walls, turned about a centre far away, where doubles are farther apart.
  int broken = 0;
  for (int steps = 1; steps < 60; ++steps) {
    const double thin = steps * 0x1p-46;
    const TriangleMesh mesh = MeshMaker()
                                  .box({1, 1, 1}, {3, 3, 3})
                                  .box({1 + thin, 1 + thin, 1 + thin}, {3 - thin, 3 - thin, 3 - thin}, true)
                                  .mesh();
    for (int degrees = 1; degrees < 30; degrees += 4) {
      const AffineMap map = *AffineMap::rotation({3000, 1000, 2000}, RationalVec3(1, 2, 3), degrees);
      const auto [with, without] = verdicts(map, mesh);
      EXPECT_EQ(with, without) << steps << " steps, " << degrees << " degrees";
      if (!without) ++broken;
    }
  }
  EXPECT_GT(broken, 20);
  EXPECT_LT(broken, 59 * 8 - 20);
}

TEST(Preimage, windings_of_shells_far_from_others_are_taken_over) {
  // Nested boxes, some of which touch others in corners, and one turned over as no rounding does.
  MeshMaker maker;
  for (int i = 0; i < 40; ++i) {
    const double k = 8 * i;
    maker.box({k, k, k}, {k + 8, k + 8, k + 8}).box({k + 1, k + 1, k + 1}, {k + 7, k + 7, k + 7}, true);
  }
  for (int i = 0; i < 40; ++i) maker.box({16.0 * i, -9, 0}, {16.0 * i + 3, -2, 5});
  const TriangleMesh mesh = maker.mesh();
  auto triangles = image_triangles(slanted(false), mesh);
  for (std::size_t f = 95UL * 12; f < 96UL * 12; ++f) std::swap(triangles[f][1], triangles[f][2]);
  const TriangleMesh image(PointArray(rounded(mesh, slanted(false)).points().approx()), triangles);
  const Preimage preimage = preimage_of(slanted(false), mesh, image.points().approx());
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  const BoxHierarchy near(mesh, faces, preimage.reach / 2);
  std::vector<int> fronts(120, 0);
  fronts[95] = -1;
  EXPECT_EQ(find_shell_windings(image)->fronts, fronts);
  EXPECT_EQ(find_shell_windings(image, HeightFields(image), preimage, near)->fronts, fronts);
}

TEST(Preimage, spares_a_proof_the_pairs_of_slanted_boxes) {
  const AffineMap map = *AffineMap::rotation({}, RationalVec3(1, 2, 3), 37);
  const auto questions = [&](int count, bool helps) {
    const TriangleMesh mesh = nested_cubes(count), image = rounded(mesh, map);
    const Preimage preimage = helps ? preimage_of(map, mesh, image.points().approx()) : Preimage{};
    reset_exact_counters();
    EXPECT_TRUE(prove_volume(image, {.preimage = preimage})->is_valid());
    return exact_counters().calls;
  };
  EXPECT_LT(questions(200, true), 6 * questions(50, true));
  EXPECT_GT(questions(200, false), 12 * questions(50, false));
}

}  // namespace
}  // namespace algebra3d
