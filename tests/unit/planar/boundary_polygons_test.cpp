#include "algebra3d/kernel/planar/boundary_polygons.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/planar/checks.h"

namespace algebra3d {
namespace {

using namespace plane_shapes;

Polygons canonical(const Polygons& polygons) {
  const auto edges = noded(polygons.corners, plane_checks::edges_of(polygons));
  return boundary_polygons(polygons.corners, *edges).value();
}

TEST(BoundaryPolygons, is_canonical) {
  const Polygons expected =
      polygons_of({{box(0, 0, 9, 9), reversed(box(1, 1, 2, 2)), reversed(box(3, 1, 4, 4))}, {box(10, 0, 11, 1)}});
  Polygons same = polygons_of({{{{11, 0, 0}, {11, 1, 0}, {10, 1, 0}, {10, 0.5, 0}, {10, 0, 0}}},
                               {reversed(box(0, 0, 9, 9)), box(3, 1, 4, 4), box(1, 1, 2, 2)}});
  Polygons result = canonical(same);
  // Holes begin at their smallest corner and go clockwise.
  ASSERT_EQ(result.face_count(), 2U);
  EXPECT_EQ(result.corners[4].approx, (Vec3{1, 1, 0}));
  EXPECT_EQ(result.corners[5].approx, (Vec3{1, 2, 0}));
  EXPECT_EQ(result.corners[8].approx, (Vec3{3, 1, 0}));
  EXPECT_EQ(result, canonical(expected));
}

TEST(BoundaryPolygons, of_what_touches_itself) {
  // A hole that touches the outer cycle in a corner stays one; faces at a common corner are two.
  const Polygons touching =
      polygons_of({{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 0, 0}, {1, 2, 0}, {2, 1, 0}}},
                   {{{4, 4, 0}, {6, 4, 0}, {6, 6, 0}}}});
  EXPECT_EQ(canonical(touching), touching);
  // Holes in a chain part the face.
  const Polygons parted = canonical(polygons_of(
      {{box(0, 0, 8, 8), {{0, 4, 0}, {4, 3, 0}, {4, 5, 0}}, {{4, 4, 0}, {6, 3, 0}, {8, 4, 0}, {6, 5, 0}}}}));
  EXPECT_EQ(parted.face_count(), 2U);
  EXPECT_EQ(parted.cycle_count(), 2U);
}

TEST(BoundaryPolygons, refuses_edges_in_both_directions) {
  const PointArray points({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  const auto result =
      boundary_polygons(points, std::vector<DirectedEdge>{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {2, 0}});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::invalid_value);
}

/// Random cells of a grid: whatever is put together from them has the same boundary polygons as the same cells cut into
/// triangles along either diagonal; the number of faces is that of the components by sides.
TEST(BoundaryPolygons, of_random_cells) {
  constexpr std::uint32_t kSize = 12;
  std::mt19937_64 random(3);  // NOLINT(cert-msc51-cpp): the same in every run
  std::vector<Vec3> places;
  for (std::uint32_t i = 0; i < (kSize + 1) * (kSize + 1); ++i)
    places.push_back({static_cast<double>(i % (kSize + 1)), static_cast<double>(i / (kSize + 1)), 0});
  const PointArray points(places);
  for (const unsigned percent : {20U, 50U, 80U}) {
    std::vector<bool> is_in(kSize * kSize);
    std::vector<DirectedEdge> whole, cut;
    for (std::uint32_t cell = 0; cell < is_in.size(); ++cell) {
      if (random() % 100 >= percent) continue;
      is_in[cell] = true;
      const std::uint32_t a = cell / kSize * (kSize + 1) + cell % kSize, b = a + 1, d = a + kSize + 1, c = d + 1;
      whole.insert(whole.end(), {{a, b}, {b, c}, {c, d}, {d, a}});
      if (random() % 2 == 0)
        cut.insert(cut.end(), {{b, c}, {c, a}, {a, b}, {c, d}, {d, a}, {a, c}});
      else
        cut.insert(cut.end(), {{b, d}, {d, a}, {a, b}, {c, d}, {d, b}, {b, c}});
    }
    std::shuffle(cut.begin(), cut.end(), random);
    const Polygons result = boundary_polygons(points, noded(points, whole).value()).value();
    EXPECT_EQ(boundary_polygons(points, noded(points, cut).value()).value(), result);
    EXPECT_EQ(polygon_defect(result).value().value_or(""), "");

    std::size_t component_count = 0;
    std::vector<bool> is_seen = is_in;
    is_seen.flip();
    for (std::uint32_t start = 0; start < is_in.size(); ++start) {
      if (is_seen[start]) continue;
      ++component_count;
      std::vector<std::uint32_t> open{start};
      is_seen[start] = true;
      const auto go = [&](bool exists, std::uint32_t cell) {
        if (!exists || is_seen[cell]) return;
        is_seen[cell] = true;
        open.push_back(cell);
      };
      while (!open.empty()) {
        const std::uint32_t cell = open.back();
        open.pop_back();
        go(cell % kSize > 0, cell - 1);
        go(cell % kSize + 1 < kSize, cell + 1);
        go(cell >= kSize, cell - kSize);
        go(cell + kSize < is_in.size(), cell + kSize);
      }
    }
    EXPECT_EQ(result.face_count(), component_count);
    plane_checks::check(result);
  }
}

}  // namespace
}  // namespace algebra3d
