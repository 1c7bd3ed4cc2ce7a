// Oriented boxes beside brute force over the corners, and how many of them hold a point where there are needles.
#include "algebra3d/kernel/search/oriented_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "algebra3d/kernel/search/slab_gaps.h"
#include "base/nearest_in_triangle.h"
#include "unit/search/needles.h"
#include "unit/search/slab_samples.h"

namespace algebra3d {
namespace {

template <typename Visit>
void visit_nodes(const BoxHierarchy& hierarchy, const Visit& visit) {
  for (std::uint32_t level = 0; level < hierarchy.level_count(); ++level)
    for (std::uint32_t index = 0; index < hierarchy.node_count(level); ++index) visit(BoxHierarchy::Node{level, index});
}

double distance_of(const Vec3& point, const TriangleMesh& mesh, FaceId face) {
  const auto [a, b, c] = mesh.triangle(face);
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3 from = point - points[a], u = points[b] - points[a], v = points[c] - points[a];
  const auto [first, second] = nearest_in_triangle(from, u, v);
  return length(from - (first * u + second * v));
}

Vec3 middle_of_face(const TriangleMesh& mesh, FaceId face) {
  const auto [a, b, c] = mesh.triangle(face);
  const std::vector<Vec3>& points = mesh.points().approx();
  return (1.0 / 3) * (points[a] + points[b] + points[c]);
}

TEST(OrientedBoxes, AreMadeWhereThereAreNeedles) {
  for (const TriangleMesh& mesh : {needle_prism(2000), needle_cone(2000)}) {
    const BoxHierarchy hierarchy(mesh);
    EXPECT_NE(hierarchy.oriented_boxes(mesh), nullptr);
  }
  const TriangleMesh round = round_mesh(40, 1, {3, 4, 5});
  EXPECT_EQ(BoxHierarchy(round).oriented_boxes(round), nullptr);
}

TEST(OrientedBoxes, ContainTheCornersOfTheirFaces) {
  for (const auto& [scale, offset] : {std::pair(1.0, 0.0), {1.0, 1e9}, {1e-300, 0.0}, {1e300, 0.0}})
    for (const TriangleMesh& mesh : {needle_prism(1000, scale, offset), needle_cone(2000, scale, offset)}) {
      const BoxHierarchy hierarchy(mesh);
      const OrientedBoxes* boxes = hierarchy.oriented_boxes(mesh);
      ASSERT_NE(boxes, nullptr);
      const double rounding = 0x1p-48 * (3 * scale + offset) / 2 * hierarchy.frame().scale;
      visit_nodes(hierarchy, [&](BoxHierarchy::Node node) {
        const Vec3 middle = hierarchy.place(node).middle;
        const OrientedBoxes::Box& box = boxes->box(node);
        for (const std::uint32_t face : hierarchy.faces_of(node))
          for (const std::uint32_t corner : mesh.triangle(FaceId(face))) {
            const Vec3 place = hierarchy.frame().place_of(mesh.points().approx()[corner]) - middle;
            ASSERT_LE(std::sqrt(box.squared_gap(place)), rounding) << scale << " " << offset;
            for (const Vec3& direction :
                 {Vec3{1, 0, 0}, Vec3{-0.6, 0.8, 0}, Vec3{0, -0.6, 0.8}, Vec3{0.48, 0.6, -0.64}})
              ASSERT_LE(dot(direction, place), box.reach(direction) + rounding) << scale << " " << offset;
          }
      });
    }
}

TEST(OrientedBoxes, GapsAreLowerBounds) {
  for (const TriangleMesh& mesh : {needle_prism(1000), needle_cone(2000)}) {
    const BoxHierarchy hierarchy(mesh);
    for (const Vec3& place :
         {Vec3{1, 2, 3}, Vec3{0.3, 0.1, 0.2}, Vec3{-2, 0.4, 0.9}, middle_of_face(mesh, FaceId(7))}) {
      const OrientedGaps gaps(hierarchy, hierarchy.oriented_boxes(mesh), place);
      visit_nodes(hierarchy, [&](BoxHierarchy::Node node) {
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t face : hierarchy.faces_of(node))
          least = std::min(least, distance_of(place, mesh, FaceId(face)));
        ASSERT_LE(gaps(node), least);
      });
    }
  }
}

/// Faces that a search for what is nearest to a place beside a face looks at, on average.
double faces_looked_at(const TriangleMesh& mesh, bool uses_boxes) {
  const BoxHierarchy hierarchy(mesh);
  std::size_t count = 0, searches = 0;
  for (std::size_t face = 0; face < mesh.face_count(); face += 37, ++searches) {
    const Vec3 place = middle_of_face(mesh, FaceId(face)) + Vec3{1e-4, 2e-4, 3e-4};
    double least = std::numeric_limits<double>::infinity();
    const OrientedGaps gaps(hierarchy, uses_boxes ? hierarchy.oriented_boxes(mesh) : nullptr, place);
    hierarchy.for_each_near(Box3::of(place), least, gaps, [&](std::uint32_t other) {
      ++count;
      return least = std::min(least, distance_of(place, mesh, FaceId(other)));
    });
  }
  return static_cast<double>(count) / static_cast<double>(searches);
}

TEST(OrientedBoxes, WorkHardlyGrowsWithNeedles) {
  for (const auto make :
       {+[](std::uint32_t n) { return needle_prism(n); }, +[](std::uint32_t n) { return needle_cone(n); }}) {
    const double few = faces_looked_at(make(2000), true), many = faces_looked_at(make(16000), true);
    EXPECT_LT(few, 100);
    EXPECT_LT(many, 2.5 * few);
    EXPECT_GT(faces_looked_at(make(16000), false), 10 * many);
  }
}

TriangleMesh shifted_needles(const TriangleMesh& mesh, const Vec3& by) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const Vec3& point : mesh.points().approx()) points.push_back(point + by);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(FaceId(f)));
  return {PointArray(std::move(points)), triangles};
}

/// Pairs of faces of a cone and its moved copy that a search visits, for each face.
double pairs_per_face(std::uint32_t n, bool uses_gaps) {
  const TriangleMesh first = needle_cone(n), second = shifted_needles(first, {0.04, 0.02, 0.015});
  const BoxHierarchy of_first(first), of_second(second);
  of_first.slabs(first);
  of_second.slabs(second);
  SlabGaps gaps(first, of_first, second, of_second);
  std::size_t count = 0;
  of_first.for_each_pair_with(
      of_second,
      [&](std::uint32_t, std::uint32_t) {
        ++count;
        return true;
      },
      [&](BoxHierarchy::Node m, BoxHierarchy::Node k) { return uses_gaps && gaps.exceed(m, k, 0); },
      [] { return true; }, {0, 1});
  return static_cast<double>(count) / n;
}

TEST(SlabGaps, FansOfNeedlesAreToldApart) {
  const double few = pairs_per_face(2000, true), many = pairs_per_face(8000, true);
  EXPECT_LT(few, 60);
  EXPECT_LT(many, 1.3 * few);
  EXPECT_GT(pairs_per_face(2000, false), 10 * few);
}

}  // namespace
}  // namespace algebra3d
