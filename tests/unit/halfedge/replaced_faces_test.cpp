#include "algebra3d/kernel/halfedge/replaced_faces.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/topology.h"
#include "mesh_samples.h"
#include "same_mesh.h"

namespace algebra3d {
namespace {

using Places = std::array<Vec3, 3>;

/// The faces by the places of their corners, the least first.
std::multiset<Places> faces_of(const TriangleMesh& mesh) {
  std::multiset<Places> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    Places places{t[0].approx, t[1].approx, t[2].approx};
    std::ranges::rotate(places, std::ranges::min_element(places));
    faces.insert(places);
  }
  return faces;
}

/// The faces that stay, then the new ones, linked from nothing; points in the order of their first use.
TriangleMesh linked_anew(const TriangleMesh& mesh, const std::vector<bool>& is_removed, const TriangleMesh& added) {
  std::vector<Vec3> points;
  std::map<Vec3, std::uint32_t> numbers;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto add = [&](const TriangleRef& corners) {
    TriangleMesh::Triangle& triangle = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [entry, is_new] = numbers.emplace(corners[i].approx, points.size());
      if (is_new) points.push_back(corners[i].approx);
      triangle[i] = entry->second;
    }
  };
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (!is_removed[f]) add(mesh.corners(FaceId(f)));
  for (std::size_t f = 0; f < added.face_count(); ++f) add(added.corners(FaceId(f)));
  return {PointArray(points), triangles};
}

TEST(ReplacedFaces, are_those_of_the_mesh_linked_from_nothing) {
  const TriangleMesh mesh(samples::torus_points(12, 8), samples::torus(12, 8));
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<bool> is_removed;
    std::vector<FaceId> removed;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      is_removed.push_back(random() % 4 == 0);
      if (is_removed.back()) removed.emplace_back(f);
    }
    // The removed faces again, or only some of them.
    if (seed % 2 == 0) removed.resize(removed.size() / 2);
    const TriangleMesh added = submesh(mesh, removed);
    const TriangleMesh result = with_replaced_faces(mesh, is_removed, added);
    samples::expect_same_mesh(result, linked_anew(mesh, is_removed, added));
    if (seed % 2 != 0) {
      EXPECT_EQ(faces_of(result), faces_of(mesh));
    }
  }
}

TEST(ReplacedFaces, of_all_faces_are_the_new_ones) {
  const TriangleMesh mesh(samples::torus_points(4, 4), samples::torus(4, 4));
  const TriangleMesh other(samples::torus_points(5, 3), samples::torus(5, 3));
  const TriangleMesh result = with_replaced_faces(mesh, std::vector<bool>(mesh.face_count(), true), other);
  EXPECT_EQ(faces_of(result), faces_of(other));
  const TriangleMesh none = with_replaced_faces(mesh, std::vector<bool>(mesh.face_count(), true), TriangleMesh());
  EXPECT_TRUE(none.is_empty());
  EXPECT_EQ(none.vertex_count(), 0U);
}

}  // namespace
}  // namespace algebra3d
