#include "algebra3d/kernel/validity/replacement.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/replaced_faces.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/validity/validity.h"
#include "sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;

/// The mesh with some vertices moved, and which faces these belong to.
struct Deformed {
  TriangleMesh mesh;
  std::vector<bool> is_moved;  // per face
  double movement = 0;
};

/// Moves the vertices in a few balls, each by a vector of its own.
Deformed deformed(const TriangleMesh& mesh, std::mt19937& random, double distance) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Vec3> points = mesh.points().approx();
  std::vector<bool> is_moved(points.size());
  Deformed result;
  for (int ball = 0; ball < 2; ++ball) {
    const Vec3 centre = points[random() % points.size()];
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (is_moved[v] || length(points[v] - centre) > 0.8) continue;
      const Vec3 way = distance * Vec3{unit(random), unit(random), unit(random)};
      points[v] = points[v] + way;
      is_moved[v] = true;
      result.movement = std::max(result.movement, 1.001 * length(way));
    }
  }
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    triangles.push_back(mesh.triangle(FaceId(f)));
    const auto [a, b, c] = triangles.back();
    result.is_moved.push_back(is_moved[a] || is_moved[b] || is_moved[c]);
  }
  result.mesh = {PointArray(std::move(points)), triangles};
  return result;
}

TriangleMesh flagged_faces(const TriangleMesh& mesh, const std::vector<bool>& flags) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (flags[f]) faces.emplace_back(f);
  return submesh(mesh, faces);
}

bool is_valid_replacement(const TriangleMesh& volume, const std::vector<bool>& is_removed, const TriangleMesh& added,
                          double movement) {
  return prove_replacement(volume, is_removed, added, movement)->is_valid;
}

TEST(Replacement, is_valid_if_the_whole_solid_is) {
  int valid = 0;
  const TriangleMesh torus = samples::torus(24, 10);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Deformed moved = deformed(torus, random, 0.05 * (1 + seed % 20));
    const bool is_valid =
        is_valid_replacement(torus, moved.is_moved, flagged_faces(moved.mesh, moved.is_moved), moved.movement);
    EXPECT_EQ(is_valid, prove_volume(moved.mesh)->is_valid());
    valid += static_cast<int>(is_valid);
  }
  EXPECT_GT(valid, 40);
  EXPECT_LT(valid, 160);
}

TEST(Replacement, may_touch_faces_that_stay) {
  // The tip of the second body comes to a face of the first one, goes through it, and stops short of it.
  const auto bodies = [](double tip) {
    return MeshMaker().box({0, 0, 0}, {4, 4, 4}).tetrahedron({2, 2, tip}, {1, 1, 8}, {3, 1, 8}, {2, 3, 8}).mesh();
  };
  const TriangleMesh before = bodies(6);
  std::vector<bool> is_removed(before.face_count());
  for (std::size_t f = 12; f < 16; ++f)
    for (const PointRef& corner : before.corners(FaceId(f)))
      if (corner.approx == Vec3{2, 2, 6}) is_removed[f] = true;
  const auto proof = [&](double tip) {
    return *prove_replacement(before, is_removed, flagged_faces(bodies(tip), is_removed), 6 - tip);
  };
  EXPECT_TRUE(proof(4.5).is_valid);
  EXPECT_EQ(proof(4.5).contact_vertices, 0U);
  EXPECT_TRUE(proof(4).is_valid);
  EXPECT_EQ(proof(4).contact_vertices, 1U);
  EXPECT_FALSE(proof(3.5).is_valid);
}

TEST(Replacement, that_turns_a_shell_inside_out_is_not_valid) {
  const TriangleMesh before =
      MeshMaker().box({0, 0, 0}, {9, 9, 9}).tetrahedron({20, 0, 0}, {21, 0, 0}, {20, 1, 0}, {20, 0, 1}).mesh();
  std::vector<bool> is_removed(before.face_count());
  for (std::size_t f = 12; f < 16; ++f) is_removed[f] = true;
  const TriangleMesh tetrahedron = flagged_faces(before, is_removed);
  EXPECT_TRUE(is_valid_replacement(before, is_removed, tetrahedron, 0));
  EXPECT_FALSE(is_valid_replacement(before, is_removed, flipped(tetrahedron), 2));
  // A shell may vanish.
  EXPECT_TRUE(is_valid_replacement(before, is_removed, TriangleMesh(), 2));
}

/// Two meshes as one.
TriangleMesh both(const TriangleMesh& first, const TriangleMesh& second) {
  std::vector<Vec3> points = first.points().approx();
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < first.face_count(); ++f) triangles.push_back(first.triangle(FaceId(f)));
  const auto shift = static_cast<std::uint32_t>(points.size());
  for (std::size_t f = 0; f < second.face_count(); ++f) {
    const auto [a, b, c] = second.triangle(FaceId(f));
    triangles.push_back({a + shift, b + shift, c + shift});
  }
  points.insert(points.end(), second.points().approx().begin(), second.points().approx().end());
  return {PointArray(std::move(points)), triangles};
}

TEST(Replacement, of_whole_shells_is_valid_if_the_whole_solid_is) {
  // Boxes within boxes and beside them, outward or inward, some of which are turned over.
  int valid = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int count = seed % 3 == 0 ? 40 : 6;
    TriangleMesh before = MeshMaker().box({-100, -100, -100}, {-90, -90, -90}).mesh(), after = before;
    for (int i = 0; i < count; ++i) {
      // In columns of three, each within the one before: a body, its cavity and a body in it.
      const double size = 3 - i % 3, x = 10 * (i / 3);
      const TriangleMesh box = MeshMaker().box({x - size, -size, -size}, {x + size, size, size}).mesh();
      const bool is_turned_over = random() % 50 == 0;
      before = both(before, i % 3 == 1 ? flipped(box) : box);
      after = both(after, (i % 3 == 1) != is_turned_over ? flipped(box) : box);
    }
    std::vector<bool> is_removed(before.face_count(), true);
    std::fill_n(is_removed.begin(), 12, false);
    const bool is_valid = is_valid_replacement(before, is_removed, flagged_faces(after, is_removed), 0);
    EXPECT_EQ(is_valid, prove_volume(after)->is_valid());
    valid += static_cast<int>(is_valid);
  }
  EXPECT_GT(valid, 100);
  EXPECT_LT(valid, 295);
}

TEST(Replacement, with_another_boundary_is_not_valid) {
  const TriangleMesh torus = samples::torus(8, 6);
  std::vector<bool> is_removed(torus.face_count());
  is_removed[3] = is_removed[10] = true;
  EXPECT_TRUE(is_valid_replacement(torus, is_removed, flagged_faces(torus, is_removed), 0));
  EXPECT_FALSE(is_valid_replacement(torus, is_removed, flipped(flagged_faces(torus, is_removed)), 0));
  std::vector<bool> one = is_removed;
  one[10] = false;
  EXPECT_FALSE(is_valid_replacement(torus, is_removed, flagged_faces(torus, one), 0));
  EXPECT_FALSE(is_valid_replacement(torus, is_removed, TriangleMesh(), 0));
}

TEST(Replacement, can_be_interrupted) {
  const TriangleMesh torus = samples::torus(8, 6);
  const std::vector<bool> is_removed(torus.face_count(), true);
  const std::atomic<bool> cancel = true;
  const auto result = prove_replacement(torus, is_removed, torus, 0, &cancel);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
