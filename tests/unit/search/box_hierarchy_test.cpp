// Oracle: brute force over all pairs of exact boxes.
#include "algebra3d/kernel/search/box_hierarchy.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

namespace algebra3d {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

/// Separate triangles of side length up to `size` at `offset` + [0, 1]^3.
TriangleMesh random_triangles(std::size_t count, double size, double offset) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 base{offset + unit(random), offset + unit(random), offset + unit(random)};
    for (int k = 0; k < 3; ++k) points.push_back(base + size * Vec3{unit(random), unit(random), unit(random)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {PointArray(std::move(points)), triangles};
}

Box3 box_of_face(const TriangleMesh& mesh, std::uint32_t face) {
  Box3 box;
  for (const PointRef& corner : mesh.corners(FaceId(face))) box.extend(box_of(corner));
  return box;
}

std::set<Pair> pairs_by_brute_force(const TriangleMesh& mesh) {
  std::set<Pair> pairs;
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i)
    for (std::uint32_t j = i + 1; j < mesh.face_count(); ++j)
      if (box_of_face(mesh, i).intersects(box_of_face(mesh, j))) pairs.insert({i, j});
  return pairs;
}

std::set<Pair> pairs_of(const BoxHierarchy& hierarchy) {
  std::set<Pair> pairs;
  hierarchy.for_each_pair(
      [&](std::uint32_t f, std::uint32_t g) {
        EXPECT_NE(f, g);
        EXPECT_TRUE(pairs.insert(std::minmax(f, g)).second) << "named twice";
        return true;
      },
      [] { return true; });
  return pairs;
}

TEST(box_hierarchy, names_each_pair_of_meeting_boxes_once_and_few_others) {
  for (const std::size_t count : {1U, 2U, 7U, 8U, 9U, 17U, 100U, 1000U}) {
    for (const double offset : {0.0, -0.5, 1e6}) {
      const TriangleMesh mesh = random_triangles(count, 0.2, offset);
      const std::set<Pair> expected = pairs_by_brute_force(mesh);
      const std::set<Pair> found = pairs_of(BoxHierarchy(mesh, all_faces(mesh)));
      EXPECT_TRUE(std::ranges::includes(found, expected));
      EXPECT_LE(found.size(), expected.size() + expected.size() / 100);
    }
  }
}

/// Faces of the first mesh with faces of the second.
std::set<Pair> cross_pairs_by_brute_force(const TriangleMesh& first, const TriangleMesh& second) {
  std::set<Pair> pairs;
  for (std::uint32_t i = 0; i < first.face_count(); ++i)
    for (std::uint32_t j = 0; j < second.face_count(); ++j)
      if (box_of_face(first, i).intersects(box_of_face(second, j))) pairs.insert({i, j});
  return pairs;
}

std::set<Pair> cross_pairs_of(const BoxHierarchy& first, const BoxHierarchy& second, std::uint32_t shares) {
  std::set<Pair> pairs;
  for (std::uint32_t share = 0; share < shares; ++share)
    first.for_each_pair_with(
        second,
        [&](std::uint32_t f, std::uint32_t g) {
          EXPECT_TRUE(pairs.insert({f, g}).second) << "named twice";
          return true;
        },
        [] { return true; }, {share, shares});
  return pairs;
}

// Hierarchies of equal and of different heights, in frames of their own.
TEST(box_hierarchy, names_each_pair_with_another_one_once_and_few_others) {
  for (const std::size_t count : {1U, 8U, 9U, 100U, 700U})
    for (const std::size_t other_count : {1U, 7U, 17U, 130U, 1000U})
      for (const std::uint32_t shares : {1U, 3U}) {
        const TriangleMesh mesh = random_triangles(count, 0.2, 0), other = random_triangles(other_count, 0.1, 0.05);
        const std::set<Pair> expected = cross_pairs_by_brute_force(mesh, other);
        const std::set<Pair> found = cross_pairs_of(BoxHierarchy(mesh), BoxHierarchy(other), shares);
        EXPECT_TRUE(std::ranges::includes(found, expected));
        EXPECT_LE(found.size(), expected.size() + expected.size() / 50 + 1);
      }
}

TEST(box_hierarchy, is_right_for_extreme_coordinates) {
  for (const double scale : {5e-324, 1e-300, 1e-9, 1e300, 8e307}) {
    const double far = scale < 1e-310 ? 2 * scale : 2.2 * scale;
    std::vector<Vec3> points;
    for (const double x : {0.0, scale, far})
      for (const Vec3& p : {Vec3{x - scale, 0, 0}, Vec3{x, -scale, 0}, Vec3{x, 0, scale}}) points.push_back(p);
    const TriangleMesh mesh(PointArray(points), std::vector<TriangleMesh::Triangle>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
    EXPECT_TRUE(std::ranges::includes(pairs_of(BoxHierarchy(mesh, all_faces(mesh))), pairs_by_brute_force(mesh)));
  }
}

TEST(box_hierarchy, of_no_faces_names_nothing) {
  const TriangleMesh mesh;
  BoxHierarchy hierarchy(mesh, {});
  hierarchy.set_groups({});
  EXPECT_TRUE(pairs_of(hierarchy).empty());
}

TEST(box_hierarchy, holds_the_given_faces_only) {
  const TriangleMesh mesh = random_triangles(50, 0.5, 0);
  for (const auto& [f, g] : pairs_of(BoxHierarchy(mesh, {3, 5, 9, 11}))) {
    EXPECT_TRUE(f == 3 || f == 5 || f == 9);
    EXPECT_TRUE(g == 5 || g == 9 || g == 11);
  }
}

TEST(box_hierarchy, leaves_out_pairs_within_a_group_and_no_others) {
  const TriangleMesh mesh = random_triangles(300, 0.4, 0);
  BoxHierarchy hierarchy(mesh, all_faces(mesh));
  const std::set<Pair> all = pairs_of(hierarchy);
  std::vector<std::uint32_t> groups(hierarchy.leaf_count()), group_of_face(mesh.face_count());
  for (std::uint32_t leaf = 0; leaf < groups.size(); ++leaf) {
    groups[leaf] = leaf < 20 ? 1 : leaf % 3 == 0 ? 2 : kNone;
    for (const std::uint32_t face : hierarchy.leaf_faces(leaf)) group_of_face[face] = groups[leaf];
  }
  hierarchy.set_groups(groups);
  std::set<Pair> expected;
  for (const auto& [f, g] : all)
    if (group_of_face[f] != group_of_face[g] || group_of_face[f] == kNone) expected.insert({f, g});
  EXPECT_EQ(pairs_of(hierarchy), expected);
}

TEST(box_hierarchy, ends_when_the_visitor_or_the_pause_says_so) {
  const TriangleMesh mesh = random_triangles(2000, 0.5, 0);
  const BoxHierarchy hierarchy(mesh, all_faces(mesh));
  int visited = 0;
  hierarchy.for_each_pair([&](auto, auto) { return ++visited < 5; }, [] { return true; });
  EXPECT_EQ(visited, 5);
  int pauses = 0;
  hierarchy.for_each_pair([](auto, auto) { return true; }, [&] { return ++pauses < 2; });
  EXPECT_EQ(pauses, 2);
}

TEST(box_hierarchy, parts_of_the_search_give_its_pairs_in_its_order) {
  for (const std::size_t count : {1U, 9U, 200U, 3000U}) {
    const TriangleMesh mesh = random_triangles(count, 0.1, 0);
    const BoxHierarchy hierarchy(mesh);
    std::vector<Pair> whole, in_parts;
    const auto into = [](std::vector<Pair>& pairs) {
      return [&pairs](std::uint32_t f, std::uint32_t g) {
        pairs.emplace_back(f, g);
        return true;
      };
    };
    hierarchy.for_each_pair(into(whole), [] { return true; });
    const auto parts = hierarchy.parts_of_search(40);
    if (count == 3000U) {
      EXPECT_GE(parts.size(), 40U);
    }
    for (const BoxHierarchy::NodePair& part : parts) hierarchy.for_each_pair(part, into(in_parts), [] { return true; });
    EXPECT_EQ(in_parts, whole);
  }
  EXPECT_TRUE(BoxHierarchy(TriangleMesh()).parts_of_search(40).empty());
}

TEST(box_hierarchy, a_window_meets_its_boxes_until_the_visitor_ends_it) {
  const TriangleMesh mesh = random_triangles(500, 0.2, 3);
  const BoxHierarchy hierarchy(mesh);
  const Box3 window{{3.2, 3.4, 3.1}, {3.5, 3.5, 3.6}};
  std::set<std::uint32_t> expected, found;
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i)
    if (box_of_face(mesh, i).intersects(window)) expected.insert(i);
  hierarchy.for_each_meeting(window, [&](std::uint32_t face) {
    EXPECT_TRUE(found.insert(face).second) << "named twice";
    return true;
  });
  EXPECT_GT(expected.size(), 2U);
  EXPECT_TRUE(std::ranges::includes(found, expected));
  EXPECT_LE(found.size(), expected.size() + 2);
  int visits = 0;
  hierarchy.for_each_meeting(window, [&](std::uint32_t) { return ++visits < 2; });
  EXPECT_EQ(visits, 2);
}

TEST(box_hierarchy, a_vertical_ray_meets_the_boxes_above_or_below) {
  const TriangleMesh mesh = random_triangles(500, 0.3, 100);
  const BoxHierarchy hierarchy(mesh, all_faces(mesh));
  for (std::uint32_t source = 0; source < 500; source += 7) {
    const Vec3 p = mesh.corners(FaceId(source))[1].approx;
    for (const int upward : {1, -1}) {
      std::set<std::uint32_t> found;
      hierarchy.for_each_on_vertical_ray(Box3::of(p), upward, [&](std::uint32_t f) { found.insert(f); });
      for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        Box3 box = box_of_face(mesh, f);
        (upward > 0 ? box.min : box.max).z = p.z;
        if (upward > 0 ? box_of_face(mesh, f).max.z < p.z : box_of_face(mesh, f).min.z > p.z) continue;
        if (box.contains(p) || (box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y)) {
          EXPECT_TRUE(found.contains(f));
        }
      }
      EXPECT_LT(found.size(), mesh.face_count() / 2);
    }
  }
}

}  // namespace
}  // namespace algebra3d
