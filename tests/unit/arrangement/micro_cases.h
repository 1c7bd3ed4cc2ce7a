#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/kernel/exact/rational.h"
#include "unit/arrangement/solids.h"

namespace algebra3d::solids {

/// What an operation has to give, worked out by hand.
struct Expected {
  Rational volume;
  std::size_t triangle_count;
};

/// Two solids, and what each operation makes of them.
struct MicroCase {
  const char* name;
  TriangleMesh a, b;
  Expected united, common, a_without_b, b_without_a;
};

/// One mesh of several whose insides do not overlap; those in `cavities` are turned inside out.
inline TriangleMesh joined(const std::vector<TriangleMesh>& bodies, const std::vector<TriangleMesh>& cavities = {}) {
  Maker maker;
  const auto add = [&](const TriangleMesh& mesh, bool is_turned) {
    const auto& p = mesh.points().approx();
    for (const auto& [a, b, c] : triangles_of(mesh))
      is_turned ? maker.triangle(p[a], p[c], p[b]) : maker.triangle(p[a], p[b], p[c]);
  };
  for (const TriangleMesh& mesh : bodies) add(mesh, false);
  for (const TriangleMesh& mesh : cavities) add(mesh, true);
  return maker.mesh();
}

/// Most begin with the cube of side 4: volume 64, 12 triangles.
inline std::vector<MicroCase> touching_cases() {
  const TriangleMesh a = cube(0, 4);
  const Expected whole{64, 12}, nothing{0, 0};
  const auto touching = [&](const char* name, const TriangleMesh& b, const Expected& united, const Expected& same_b) {
    return MicroCase{name, a, b, united, nothing, whole, same_b};
  };
  // An edge below, its ends at x = low and high.
  const auto wedge = [](double low, double high) {
    return with_axes_permuted(prism(std::vector<Corner>{{2, 4}, {3, 5}, {1, 5}}, low, high), 1);
  };
  return {
      touching("disjoint", cube(5, 6), {65, 24}, {1, 12}),
      touching("whole_face", box({4, 0, 0}, {8, 4, 4}), {128, 12}, {64, 12}),
      // The side with a hole: 8 corners.
      touching("face_within_a_face", box({4, 1, 1}, {6, 3, 3}), {72, 10 + 8 + 10}, {8, 12}),
      // Three sides of six corners, of which two are merged from both.
      touching("face_at_the_corner_of_a_face", box({4, 0, 0}, {6, 2, 2}), {72, 3 * 4 + 6 * 2}, {8, 12}),
      // Of each: one side of six corners, two with a corner of the other on their edge.
      touching("part_of_each_face", box({4, 2, 2}, {8, 6, 6}), {128, 2 * (4 + 2 * 3 + 3 * 2)}, {64, 12}),
      touching("whole_edge", box({4, 4, 0}, {8, 8, 4}), {128, 24}, {64, 12}),
      touching("edge_within_an_edge", box({4, 4, 1}, {6, 6, 3}), {72, (8 + 2 * 4) + 12}, {8, 12}),
      touching("part_of_each_edge", box({4, 4, 2}, {8, 8, 6}), {128, 2 * (8 + 2 * 3)}, {64, 12}),
      // The top with a slit: six corners, one hole.
      touching("edge_within_a_face", wedge(1, 3), {66, (10 + 6) + 8}, {2, 8}),
      // The top in two, two sides of five corners; two sides of the wedge have six.
      touching("edge_across_a_face", wedge(-1, 5), {70, (4 + 2 * 3 + 3 * 2) + (2 * 4 + 2 + 2)}, {6, 8}),
      // The top has seven corners, the side beneath five.
      touching("edge_from_the_border_of_a_face", wedge(0, 3), {67, (5 + 3 + 4 * 2) + 8}, {3, 8}),
      touching("corner_to_corner", cube(4, 8), {128, 24}, {64, 12}),
      touching("corner_on_an_edge", tetrahedron({4, 4, 2}, {6, 5, 1}, {6, 5, 3}, {5, 7, 2}), {{197, 3}, 16},
               {{5, 3}, 4}),
      touching("corner_on_a_face", tetrahedron({2, 2, 4}, {3, 2, 6}, {1, 3, 6}, {1, 1, 6}), {{196, 3}, 16},
               {{4, 3}, 4}),
      touching("edges_cross_in_a_point", tetrahedron({2, 3, 5}, {2, 5, 3}, {1, 6, 6}, {3, 6, 6}), {{200, 3}, 16},
               {{8, 3}, 4}),
      {"two_tetrahedra_on_an_edge",
       tetrahedron({0, 0, 0}, {0, 0, 2}, {2, 0, 1}, {2, 2, 1}),
       tetrahedron({0, 0, 0}, {0, 0, 2}, {-2, 0, 1}, {-2, -2, 1}),
       {{8, 3}, 8},
       nothing,
       {{4, 3}, 4},
       {{4, 3}, 4}},
  };
}

inline std::vector<MicroCase> nested_cases() {
  const TriangleMesh a = cube(0, 4);
  const Expected whole{64, 12}, nothing{0, 0};
  const auto nested = [&](const char* name, const TriangleMesh& b, const Expected& same_b, const Expected& rest) {
    return MicroCase{name, a, b, whole, same_b, rest, nothing};
  };
  const TriangleMesh ridge = with_axes_permuted(prism(std::vector<Corner>{{2, 4}, {1, 3}, {3, 3}}, 1, 3), 1);
  const TriangleMesh octahedron = mapped(geodesic_sphere(1), [](const Vec3& p) { return 2 * (p + Vec3{1, 1, 1}); });
  return {
      {"identical", a, a, whole, whole, nothing, nothing},
      nested("nested", cube(1, 3), {8, 12}, {56, 24}),
      nested("nested_face_within_a_face", box({1, 1, 2}, {3, 3, 4}), {8, 12}, {56, 10 + 8 + 10}),
      // Two sides of eight corners.
      nested("nested_edge_within_an_edge", box({2, 2, 1}, {4, 4, 3}), {8, 12}, {56, 2 * 6 + 4 * 2 + 4 * 2}),
      nested("nested_in_a_corner", cube(2, 4), {8, 12}, {56, 3 * 4 + 6 * 2}),
      nested("nested_edge_within_a_face", ridge, {2, 8}, {62, (10 + 6) + 8}),
      nested("nested_corner_in_a_corner", tetrahedron({4, 4, 4}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}), {{4, 3}, 4},
             {{188, 3}, 16}),
      nested("nested_corners_within_faces", octahedron, {{32, 3}, 8}, {{160, 3}, 20}),
      nested("half", box({0, 0, 0}, {4, 4, 2}), {32, 12}, {32, 12}),
      nested("two_quarters_on_an_edge", joined({box({0, 0, 0}, {2, 2, 4}), box({2, 2, 0}, {4, 4, 4})}), {32, 24},
             {32, 24}),
      nested("tunnel", box({0, 1, 1}, {4, 3, 3}), {16, 12}, {48, 4 * 2 + 2 * 8 + 4 * 2}),
      nested("blind_hole", box({2, 1, 1}, {4, 3, 3}), {8, 12}, {56, 10 + 8 + 10}),
  };
}

inline std::vector<MicroCase> crossing_cases() {
  const TriangleMesh a = cube(0, 4), hollow = joined({a}, {cube(1, 3)});
  const Expected nothing{0, 0};
  const std::vector<Corner> hexagon{{2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}};  // area 12
  const TriangleMesh cone = pyramid(hexagon, 0, {0, 0, 3});
  return {
      {"cavity_filled", hollow, cube(1, 3), {64, 12}, nothing, {56, 24}, {8, 12}},
      {"cavity_half_filled", hollow, box({1, 1, 1}, {3, 3, 2}), {60, 24}, nothing, {56, 24}, {4, 12}},
      {"cavity_with_a_body", hollow, cube(1.5, 2.5), {57, 36}, nothing, {56, 24}, {1, 12}},
      {"cavity_and_the_whole", hollow, a, {64, 12}, {56, 24}, nothing, {8, 12}},
      {"cavity_opened", hollow, box({1, 1, 2}, {3, 3, 4}), {60, 24}, {4, 12}, {52, 10 + 8 + 10}, {4, 12}},
      {"cone_tips_touch", cone, pyramid(hexagon, 6, {0, 0, 3}), {24, 20}, nothing, {12, 10}, {12, 10}},
      // They meet in a hexagon a seventh as large, at z = 18/7.
      {"cone_tips_overlap",
       cone,
       pyramid(hexagon, 6, {0, 0, 2}),
       {{1368, 49}, 2 * (4 + 6 * 2)},
       {{4, 49}, 12},
       {{584, 49}, 4 + 6 * 2 + 6},
       {{780, 49}, 4 + 6 * 2 + 6}},
      {"bar_through_a_cube",
       a,
       box({-1, 1, 1}, {5, 3, 3}),
       {72, 4 * 2 + 2 * 8 + 2 * 10},
       {16, 12},
       {48, 4 * 2 + 2 * 8 + 4 * 2},
       {8, 24}},
      {"corner_in_a_corner",
       a,
       cube(2, 6),
       {120, 2 * (3 * 2 + 3 * 4)},
       {8, 12},
       {56, 3 * 2 + 3 * 4 + 3 * 2},
       {56, 3 * 2 + 3 * 4 + 3 * 2}},
      {"slab_in_line", box({0, 0, 0}, {4, 4, 2}), box({2, 0, 0}, {6, 4, 2}), {48, 12}, {16, 12}, {16, 12}, {16, 12}},
      // A plus of twelve corners, twice, and twelve walls.
      {"crossed_bars",
       box({0, 1, 0}, {3, 2, 1}),
       box({1, 0, 0}, {2, 3, 1}),
       {5, 2 * 10 + 12 * 2},
       {1, 12},
       {2, 24},
       {2, 24}},
  };
}

inline std::vector<MicroCase> micro_cases() {
  std::vector<MicroCase> all = touching_cases();
  for (const auto& more : {nested_cases(), crossing_cases()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace algebra3d::solids
