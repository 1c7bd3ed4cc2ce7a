#include "algebra3d/kernel/rounding/detail/feature_snapping.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/distance/farthest_point.h"
#include "algebra3d/kernel/rounding/detail/crossing_faces.h"
#include "algebra3d/kernel/rounding/detail/near_features.h"
#include "algebra3d/kernel/rounding/detail/snapped_faces.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/validity/validity.h"
#include "unit/arrangement/random_solids.h"
#include "unit/rounding/distances.h"

namespace algebra3d::solids {
namespace {

/// Both meshes as one, whether they cross or not.
TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  PointArray points;
  std::vector<IndexTriangle> triangles;
  for (const TriangleMesh* mesh : {&a, &b}) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec3& p : mesh->points().approx()) points.push_back(PointRef(p));
    for (std::size_t f = 0; f < mesh->face_count(); ++f) {
      const auto [i, j, k] = mesh->triangle(FaceId(f));
      triangles.push_back({first + i, first + j, first + k});
    }
  }
  return {std::move(points), triangles};
}

/// Along every edge as many triangles run one way as the other.
bool is_closed(const SnappedFaces& faces) {
  std::map<std::pair<PointId, PointId>, int> excess;
  for (const std::size_t f : faces.faces())
    for (std::size_t i = 0; i < 3; ++i) {
      const PointId from = faces.corners(f)[i], to = faces.corners(f)[(i + 1) % 3];
      excess[ordered(from, to)] += from < to ? 1 : -1;
    }
  return std::ranges::all_of(excess, [](const auto& edge) { return edge.second == 0; });
}

/// Every pair of faces, each decided by what the two closed triangles share.
std::vector<FacePair> crossings_by_brute_force(const SnappedFaces& faces) {
  const auto is_flat = [&](std::size_t face) {
    const auto [a, b, c] = faces.triangle(face);
    return collinear(a, b, c);
  };
  std::vector<FacePair> pairs;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t g = f + 1; g < faces.size(); ++g) {
      if (is_flat(f) || is_flat(g)) continue;
      const Contact contact = intersect_triangles(faces.triangle(f), faces.triangle(g));
      const auto& s = faces.corners(f);
      const auto shared =
          std::ranges::count_if(faces.corners(g), [&](PointId p) { return std::ranges::find(s, p) != s.end(); });
      const bool is_allowed = contact == Contact::none || contact == Contact::point ||
                              (contact == Contact::segment && shared == 2) || shared == 3;
      if (!is_allowed) pairs.emplace_back(f, g);
    }
  return pairs;
}

TEST(SnappedFaces, stay_closed_and_near_whatever_is_joined) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    SnappedFaces faces(geodesic_sphere(3));
    for (int round = 0; round < 3; ++round) {
      FeatureJoins joins;
      const std::vector<std::size_t> numbers = faces.faces();
      const auto any_face = [&] {
        return numbers[static_cast<std::size_t>(chance.below(static_cast<int>(numbers.size())))];
      };
      const auto any_point = [&] { return PointId(chance.below(static_cast<int>(faces.point_count()))); };
      joins.merged.push_back(ordered(any_point(), any_point()));
      for (int i = 0; i < 4; ++i) {
        const auto& corners = faces.corners(any_face());
        joins.led[ordered(corners[0], corners[1])].push_back(any_point());
        joins.divided.emplace(any_face(), any_point());
      }
      ASSERT_TRUE(faces.apply(std::move(joins)));
      EXPECT_TRUE(is_closed(faces));
      EXPECT_LE(faces.largest_displacement(), 2 * 1.01);  // the diameter
    }
  }
}

TEST(SnappedFaces, edges_are_led_through_points_in_their_order) {
  SnappedFaces faces(box({0, 0, 0}, {8, 8, 8}));
  const PointId from = faces.add_point({0, 0, 0}), to = faces.add_point({8, 0, 0});
  FeatureJoins joins;
  for (const double x : {6.0, 2.0, 4.0}) joins.led[ordered(from, to)].push_back(faces.add_point({x, -0.5, 0}));
  ASSERT_TRUE(faces.apply(std::move(joins)));
  EXPECT_EQ(faces.size(), 12U + 2 * 3);
  EXPECT_NEAR(faces.largest_displacement(), 0.5, 1e-9);
  EXPECT_EQ(CrossingSearch(faces).find(nullptr)->size(), 0U);
  EXPECT_TRUE(is_closed(faces));
}

// Every corner of the upper face goes to one that is 8 away; so do the four sides, but only half of each.
TEST(SnappedFaces, distance_is_less_than_displacement_where_corners_move_along_the_mesh) {
  SnappedFaces faces(box({0, 0, 0}, {8, 8, 8}));
  const PointId from = faces.add_point({8, 8, 8}), to = faces.add_point({8, 0, 8});
  FeatureJoins joins;
  joins.merged = {ordered(from, to)};
  ASSERT_TRUE(faces.apply(std::move(joins)));
  EXPECT_NEAR(faces.largest_displacement(), 8, 1e-9);
  const TriangleMesh given = box({0, 0, 0}, {8, 8, 8}), changed = faces.mesh();
  const BoxHierarchy of_given(given), of_changed(changed);
  const double distance = farthest_point(std::array{FarthestSearch{{&changed, &of_changed}, {&given, &of_given}}})
                              ->value()
                              .squared_distance.nearest_root();
  EXPECT_LT(distance, 4.1);
  EXPECT_NEAR(*faces.largest_distance(1), distance, 1e-9);
  EXPECT_EQ(*faces.largest_distance(9), faces.largest_displacement());
}

TEST(SnappedFaces, changes_end_when_they_are_cancelled) {
  const std::atomic<bool> cancel = true;
  SnappedFaces faces(box({0, 0, 0}, {8, 8, 8}));
  FeatureJoins merging, leading, dividing;
  merging.merged = {ordered(faces.add_point({0, 0, 0}), faces.add_point({8, 0, 0}))};
  leading.led[ordered(faces.add_point({0, 0, 0}), faces.add_point({8, 0, 0}))] = {faces.add_point({4, 0, 0})};
  dividing.divided = {{0, faces.add_point({1, 2, 0})}};
  for (const FeatureJoins& joins : {merging, leading, dividing})
    EXPECT_EQ(faces.apply(joins, &cancel).error().code, ErrorCode::interrupted);
}

TEST(SnappedFaces, opposite_triangles_vanish) {
  SnappedFaces faces(box({0, 0, 0}, {1, 1, 1}));
  FeatureJoins joins;  // the upper side is pressed onto the lower one
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      joins.merged.push_back(ordered(faces.add_point({x, y, 0}), faces.add_point({x, y, 1})));
  ASSERT_TRUE(faces.apply(std::move(joins)));
  EXPECT_TRUE(is_closed(faces));
  EXPECT_LE(faces.size(), 4U);  // none, if both sides have the same diagonal
}

TEST(SnappedFaces, of_a_restored_cluster_are_those_that_were_given) {
  SnappedFaces faces(together(box({0, 0, 0}, {1, 1, 1}), box({4, 4, 4}, {5, 5, 5})));
  const auto corner = [&](double at) { return faces.add_point({at, at, at}); };
  FeatureJoins joins;  // a corner of each box goes
  joins.merged = {ordered(corner(0), faces.add_point({1, 0, 0})), ordered(corner(5), faces.add_point({4, 5, 5}))};
  ASSERT_TRUE(faces.apply(std::move(joins)));
  EXPECT_EQ(faces.size(), 20U);
  const std::vector<PointId> cluster = {faces.cluster_of(corner(0))};
  EXPECT_NE(faces.cluster_of(corner(5)), cluster[0]);
  faces.restore(cluster);
  EXPECT_EQ(faces.size(), 22U);
  EXPECT_TRUE(is_closed(faces));
  for (const std::size_t face : faces.changed_faces()) EXPECT_GE(faces.given_of(face), 12U);
  EXPECT_EQ(faces.cluster_of(corner(0)), faces.cluster_of(faces.add_point({1, 0, 0})));
  faces.untie(cluster);
  EXPECT_NE(faces.cluster_of(corner(0)), faces.cluster_of(faces.add_point({1, 0, 0})));
  EXPECT_EQ(faces.cluster_of(corner(5)), faces.cluster_of(faces.add_point({4, 5, 5})));
}

TEST(CrossingFaces, are_those_of_brute_force) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const Vec3 corner = chance.grid_point(4), size = chance.grid_point(3) + Vec3{1, 1, 1};
    const TriangleMesh a = geodesic_sphere(2), b = box(0.25 * corner, 0.25 * (corner + size));
    SnappedFaces faces(together(a, b));
    EXPECT_EQ(*CrossingSearch(faces).find(nullptr), crossings_by_brute_force(faces));
  }
}

// On a coarse grid some faces have no area, and some the same corners as others.
TEST(CrossingFaces, of_flat_and_repeated_faces_are_those_of_brute_force) {
  std::size_t flat_count = 0, repeated_count = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const TriangleMesh coarse = mapped(geodesic_sphere(3), [&](const Vec3& p) {
      const Vec3 push{chance.unit(), chance.unit(), chance.unit()}, moved = 1.6 * (p + 0.5 * push);
      return Vec3{std::round(moved.x), std::round(moved.y), std::round(moved.z)};
    });
    const SnappedFaces faces(seed % 2 == 0 ? together(coarse, coarse) : coarse);
    const Crossings crossings = *find_crossings(faces.given_mesh());
    repeated_count += crossings.duplicates.size();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto [a, b, c] = faces.triangle(f);
      flat_count += collinear(a, b, c) ? 1 : 0;
    }
    EXPECT_EQ(*CrossingSearch(faces).find(nullptr), crossings_by_brute_force(faces));
  }
  EXPECT_GT(flat_count, 0U);
  EXPECT_GT(repeated_count, 0U);
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(find_crossings(geodesic_sphere(3), &cancel).error().code, ErrorCode::interrupted);
}

TEST(CrossingFaces, of_closed_faces_are_not_looked_for) {
  SnappedFaces faces(together(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})));
  const std::vector<FacePair> pairs = *CrossingSearch(faces).find(nullptr);
  ASSERT_FALSE(pairs.empty());
  faces.close_all_but({});
  EXPECT_TRUE(CrossingSearch(faces).find(nullptr)->empty());
  const std::vector<std::size_t> one = {pairs[0].first};
  faces.close_all_but({pairs[0].first});
  const std::vector<FacePair> some = *CrossingSearch(faces).find(nullptr);
  EXPECT_FALSE(some.empty());
  for (const FacePair& pair : some) EXPECT_TRUE(pair.first == one[0] || pair.second == one[0]);
}

/// Two triangles of a mesh, as joins see them; nothing else is there.
struct PairOfFaces {
  explicit PairOfFaces(std::array<Vec3, 6> places)
      : faces(TriangleMesh(points_of(places), std::vector<IndexTriangle>{{0, 1, 2}, {3, 4, 5}})) {}

  static PointArray points_of(const std::array<Vec3, 6>& places) {
    return PointArray(std::vector<Vec3>(places.begin(), places.end()));
  }
  FeatureJoins joins(double reach, const CoordinateGrid& grid = CoordinateGrid::multiples(0.125)) {
    FeatureJoins result;
    join_near_features(faces, 0, 1, reach, grid, result);
    return result;
  }

  SnappedFaces faces;
};

TEST(NearFeatures, near_vertices_become_one) {
  PairOfFaces pair({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0.25, 0, 0}, {-8, 0, 4}, {-8, 0, -4}}});
  const FeatureJoins joins = pair.joins(0.5);
  EXPECT_EQ(joins.merged, (std::vector<PointPair>{{PointId(0), PointId(3)}}));
  EXPECT_TRUE(joins.led.empty() && joins.divided.empty());
}

TEST(NearFeatures, an_edge_is_led_through_a_near_vertex) {
  PairOfFaces pair({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {4, 0.25, 0}, {4, -8, 4}, {4, -8, -4}}});
  const FeatureJoins joins = pair.joins(0.5);
  EXPECT_EQ(joins.led, (std::map<PointPair, std::vector<PointId>>{{{PointId(0), PointId(1)}, {PointId(3)}}}));
  EXPECT_TRUE(joins.merged.empty() && joins.divided.empty());
}

TEST(NearFeatures, two_edges_get_a_vertex_between_them_on_the_grid) {
  PairOfFaces pair({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {3, -4, 0.25}, {3, 4, 0.25}, {3, -4, -8}}});
  const FeatureJoins joins = pair.joins(0.5);
  const PointId middle(6);
  EXPECT_EQ(pair.faces.point(middle).approx, (Vec3{3, 0, 0.125}));
  EXPECT_TRUE(joins.led.at({PointId(0), PointId(1)}) == std::vector{middle});
  EXPECT_TRUE(joins.led.at({PointId(3), PointId(4)}) == std::vector{middle});
}

TEST(NearFeatures, a_face_is_divided_at_a_near_vertex_and_where_it_is_pierced) {
  PairOfFaces near({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {2, 2, -0.25}, {2, 2, 8}, {3, 2, 8}}});
  EXPECT_EQ(near.joins(0.5).divided, (std::map<std::size_t, PointId>{{0, PointId(3)}}));
  PairOfFaces pierced({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {2, 2, -8}, {2, 2, 8}, {20, 20, 0}}});
  const FeatureJoins joins = pierced.joins(0.01);
  EXPECT_EQ(pierced.faces.point(PointId(6)).approx, (Vec3{2, 2, 0}));
  EXPECT_EQ(joins.divided.at(0), PointId(6));
  EXPECT_TRUE(joins.led.at({PointId(3), PointId(4)}) == std::vector{PointId(6)});
}

TEST(NearFeatures, a_needle_is_divided_where_it_is_pierced_and_nowhere_else) {
  // Edges that go along needles, nearly in their planes: long doubles do not tell the normal of these well enough.
  Chance chance(1);
  const auto random = [&] { return Vec3{chance.unit(), chance.unit(), chance.unit()}; };
  std::size_t pierced = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 a = random(), along = random(), across = 0x1p-46 * random();
    const Vec3 inside = a + 0.5 * along + 0.25 * across;
    const Vec3 direction = 0.25 * along + 1e-3 * 0x1p46 * across + 1e-8 * random();
    const std::array<Vec3, 6> places{
        a, a + along, a + 0.5 * along + across, inside + direction, inside - direction, random()};
    PairOfFaces pair(places);
    const FeatureJoins joins = pair.joins(0x1p-56, CoordinateGrid::doubles());
    if (joins.divided.count(0) == 0 || joins.divided.at(0) < PointId(6)) continue;
    ++pierced;
    const Vec3 place = pair.faces.point(joins.divided.at(0)).approx;
    EXPECT_LE(distance_to_segment(wide(place), wide(a), wide(a + along)), 0x1p-44);
  }
  EXPECT_GE(pierced, 100);
}

TEST(NearFeatures, a_face_without_area_has_its_longest_edge_led_through_its_corner) {
  const PairOfFaces flat({{{0, 0, 0}, {8, 0, 0}, {2, 0, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}}});
  FeatureJoins joins;
  join_collinear_corners(flat.faces, 0, joins);
  EXPECT_EQ(joins.led, (std::map<PointPair, std::vector<PointId>>{{{PointId(0), PointId(1)}, {PointId(2)}}}));
}

TEST(FeatureSnapping, of_a_mesh_without_crossings_is_the_mesh) {
  const TriangleMesh sphere = geodesic_sphere(4);
  const auto snapped = snap_features(sphere, CoordinateGrid::doubles(), 0x1p-52, {16}, nullptr);
  ASSERT_TRUE(snapped.ok());
  EXPECT_EQ(triangles_of(*snapped->mesh), triangles_of(sphere));
  EXPECT_EQ(snapped->largest_distance, 0);
  EXPECT_EQ(snapped->crossing_pairs, 0U);
}

TEST(FeatureSnapping, leaves_no_crossings_between_boxes_that_overlap_by_a_hair) {
  const TriangleMesh boxes = together(box({0, 0, 0}, {4, 4, 4}), box({4 - 0x1p-20, 1, 1}, {8, 3, 3}));
  const auto snapped = snap_features(boxes, CoordinateGrid::multiples(0x1p-20), 0x1p-20, {16}, nullptr);
  ASSERT_TRUE(snapped.ok());
  EXPECT_EQ(snapped->crossing_pairs, 0U);
  EXPECT_LE(snapped->largest_distance, 0x1p-18);
}

TEST(FeatureSnapping, of_a_mesh_with_too_many_crossings_is_given_up) {
  const TriangleMesh boxes = together(box({0, 0, 0}, {4, 4, 4}), box({1, 1, 1}, {8, 3, 3}));
  const std::size_t crossings = CrossingSearch(SnappedFaces(boxes)).find(nullptr)->size();
  const auto snapped = snap_features(boxes, CoordinateGrid::doubles(), 0x1p-52, {16, crossings - 1}, nullptr);
  ASSERT_TRUE(snapped.ok());
  EXPECT_FALSE(snapped->mesh);
  EXPECT_EQ(snapped->crossings_before, crossings);
  EXPECT_EQ(snapped->crossing_pairs, crossings);
}

TEST(FeatureSnapping, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const auto snapped = snap_features(geodesic_sphere(4), CoordinateGrid::doubles(), 0x1p-52, {16}, &cancel);
  ASSERT_FALSE(snapped.ok());
  EXPECT_EQ(snapped.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::solids
