// Normals and angles of batches of faces against long doubles, and one instruction set against another.
#include "algebra3d/kernel/halfedge/detail/corner_weights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

namespace algebra3d::detail {
namespace {

constexpr std::size_t kFaces = CornerWeights::kMaxFaces;

/// Faces of one degree without common points.
struct SingleFaces {
  std::uint32_t degree;
  std::vector<Vec3> points;
  std::vector<std::uint32_t> corners, begins;

  explicit SingleFaces(std::uint32_t its_degree) : degree(its_degree), points(kFaces * its_degree) {
    for (std::uint32_t i = 0; i < points.size(); ++i) corners.push_back(i);
    for (std::uint32_t i = 0; i < kFaces; ++i) begins.push_back(i * degree);
  }
  FaceBatch batch(std::size_t count = kFaces) const { return {points.data(), corners.data(), begins.data(), count}; }
  Vec3& corner(std::size_t face, std::uint32_t i) { return points[face * degree + i % degree]; }
  CornerWeights weights(const CornerWeightKernels& kernels, std::size_t count = kFaces) const {
    CornerWeights result{};
    const bool are_all =
        degree == 3 ? kernels.of_triangles(batch(count), result) : kernels.of_quadrilaterals(batch(count), result);
    bool expected = true;
    for (std::size_t i = 0; i < count; ++i) expected &= result.are_reliable[i] != 0;
    EXPECT_EQ(are_all, expected);
    return result;
  }
};

using Long = std::array<long double, 3>;

Long difference(const Vec3& a, const Vec3& b) {
  return {static_cast<long double>(a.x) - b.x, static_cast<long double>(a.y) - b.y,
          static_cast<long double>(a.z) - b.z};
}
long double product(const Long& a, const Long& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Long cross_product(const Long& a, const Long& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// By long doubles: the normal, of length 1, the angles, and the sine of the angle at the first corner of a triangle,
/// or between the diagonals.
struct Expected {
  Long normal;
  std::array<long double, 4> angles;
  long double sine;
};

Expected expected_of(SingleFaces& faces, std::size_t face) {
  Expected result{};
  const std::uint32_t n = faces.degree;
  const Vec3 &a = faces.corner(face, 0), &b = faces.corner(face, 1), &c = faces.corner(face, 2);
  const Long first = n == 3 ? difference(b, a) : difference(c, a),
             second = n == 3 ? difference(c, a) : difference(faces.corner(face, 3), b);
  const Long normal = cross_product(first, second);
  const long double size = std::sqrt(product(normal, normal));
  for (std::size_t axis = 0; axis < 3; ++axis) result.normal[axis] = normal[axis] / size;
  result.sine = size / std::sqrt(product(first, first) * product(second, second));
  for (std::uint32_t i = 0; i < n; ++i) {
    const Long u = difference(faces.corner(face, i + 1), faces.corner(face, i)),
               v = difference(faces.corner(face, i + n - 1), faces.corner(face, i));
    const Long turn = cross_product(u, v);
    long double angle = std::atan2(std::sqrt(product(turn, turn)), product(u, v));
    if (n == 4 && product(turn, normal) < 0) angle = 2 * std::numbers::pi_v<long double> - angle;
    result.angles[i] = angle;
  }
  return result;
}

double number(std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

/// Faces of all sizes in reach, in boxes that are thin in two directions.
SingleFaces random_faces(std::uint32_t degree, double thickness, std::mt19937_64& random) {
  SingleFaces faces(degree);
  for (std::size_t face = 0; face < kFaces; ++face) {
    const double scale = std::ldexp(1, static_cast<int>(random() % 200) - 100);
    for (std::uint32_t i = 0; i < degree; ++i)
      faces.corner(face, i) = {scale * number(random), scale * thickness * number(random),
                               scale * thickness * number(random)};
  }
  return faces;
}

constexpr double kThicknesses[] = {1, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6};

/// The errors that corner_weights.h promises, of at least a hundred thousand faces each.
TEST(CornerWeights, are_within_the_bound) {
  std::mt19937_64 random(1);
  for (const std::uint32_t degree : {3, 4}) {
    int count = 0;
    long double of_normals = 0, of_angles = 0;
    for (const double thickness : kThicknesses) {
      for (int round = 0; round < 150; ++round) {
        SingleFaces faces = random_faces(degree, thickness, random);
        const CornerWeights found = faces.weights(corner_weight_kernels());
        for (std::size_t i = 0; i < kFaces; ++i) {
          if (found.are_reliable[i] == 0) continue;
          ++count;
          const Expected expected = expected_of(faces, i);
          for (std::size_t axis = 0; axis < 3; ++axis)
            of_normals = std::max(of_normals, expected.sine * std::abs(found.normals[axis][i] - expected.normal[axis]));
          for (std::size_t corner = 0; corner < degree; ++corner)
            of_angles = std::max(of_angles, (degree == 3 ? expected.sine : 1) *
                                                std::abs(found.angles[corner][i] - expected.angles[corner]));
        }
      }
    }
    EXPECT_GT(count, 100'000);
    EXPECT_LT(of_normals, 0x1p-50L);
    EXPECT_LT(of_angles, 0x1p-49L);
  }
}

TEST(CornerWeights, have_the_same_bits_with_all_instructions) {
  std::mt19937_64 random(2);
  const auto all = available_corner_weight_kernels();
  for (const std::uint32_t degree : {3, 4}) {
    for (std::size_t count = 1; count <= kFaces; ++count) {
      SingleFaces faces = random_faces(degree, kThicknesses[count % std::size(kThicknesses)], random);
      // Corners of other faces, so that faces share vertices, and padding by repetition.
      for (std::uint32_t& corner : faces.corners) corner = static_cast<std::uint32_t>(random() % faces.points.size());
      for (std::size_t i = count; i < kFaces; ++i) faces.begins[i] = faces.begins[count - 1];
      std::vector<std::vector<WeightedSum>> sums;
      CornerWeights first{};
      for (const CornerWeightKernels* kernels : all) {
        const CornerWeights found = faces.weights(*kernels, count);
        if (sums.empty()) first = found;
        ASSERT_EQ(std::memcmp(found.are_reliable, first.are_reliable, count * sizeof(std::int64_t)), 0);
        CornerWeights clean = found;
        for (std::size_t i = 0; i < count; ++i)
          if (found.are_reliable[i] == 0)
            for (std::size_t axis = 0; axis < 3; ++axis) clean.normals[axis][i] = 0, clean.angles[axis][i] = 1;
        clean.angles[3][0] = 1;
        auto& found_sums = sums.emplace_back(101);
        kernels->add(faces.batch(count), degree, clean, {20, 100, found_sums.data()});
        ASSERT_EQ(std::memcmp(found_sums.data(), sums.front().data(), 100 * sizeof(WeightedSum)), 0);
      }
    }
  }
}

/// By hand: the sums of two triangles and a quadrilateral.
TEST(CornerWeights, are_added_to_the_vertices_of_the_block_only) {
  CornerWeights weights{};
  for (std::size_t i = 0; i < 2; ++i) {
    weights.normals[0][i] = 1;
    weights.normals[2][i] = static_cast<double>(i);
    for (std::size_t corner = 0; corner < 4; ++corner)
      weights.angles[corner][i] = static_cast<double>(10 * i + corner + 1);
  }
  const std::vector<std::uint32_t> corners{7, 8, 9, 2, 9, 8, 7, 1}, triangles{0, 4}, quadrilaterals{0};
  for (const CornerWeightKernels* kernels : available_corner_weight_kernels()) {
    std::vector<WeightedSum> sums(3);
    kernels->add({nullptr, corners.data(), triangles.data(), 2}, 3, weights, {8, 2, sums.data()});
    EXPECT_EQ(sums[0].angles, 2 + 12);
    EXPECT_EQ(sums[0].x, 2 + 12);
    EXPECT_EQ(sums[0].z, 12);
    EXPECT_EQ(sums[1].angles, 3 + 11);
    kernels->add({nullptr, corners.data(), quadrilaterals.data(), 1}, 4, weights, {8, 2, sums.data()});
    EXPECT_EQ(sums[0].angles, 2 + 12 + 2);
    EXPECT_EQ(sums[1].angles, 3 + 11 + 3);
  }
}

TEST(CornerWeights, of_slivers_and_of_huge_and_tiny_faces_are_not_reliable) {
  for (const CornerWeightKernels* kernels : available_corner_weight_kernels()) {
    for (const std::uint32_t degree : {3, 4}) {
      SingleFaces faces(degree);
      for (std::size_t face = 0; face < kFaces; ++face) {
        // A good face, one without area, a sliver, a tiny and a huge one, and one with two equal corners.
        const double height = face % 6 == 1 ? 0 : face % 6 == 2 ? 1e-7 : 1;
        const double scale = face % 6 == 3 ? 1e-150 : face % 6 == 4 ? 1e160 : 1;
        const Vec3 corners[4] = {{0, 0, 0}, {1, -height, 0}, {2, height, 0}, {1.5, 2 * height, 0}};
        for (std::uint32_t i = 0; i < degree; ++i) faces.corner(face, i) = scale * corners[i];
        if (face % 6 == 5) faces.corner(face, 1) = faces.corner(face, 0);
      }
      const CornerWeights found = faces.weights(*kernels);
      for (std::size_t face = 0; face < kFaces; ++face) EXPECT_EQ(found.are_reliable[face] != 0, face % 6 == 0);
    }
  }
}

}  // namespace
}  // namespace algebra3d::detail
