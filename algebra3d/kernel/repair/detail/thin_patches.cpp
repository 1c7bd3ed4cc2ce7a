#include "algebra3d/kernel/repair/detail/thin_patches.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/repair/detail/surface_distance.h"
#include "algebra3d/kernel/repair/detail/triangle_parts.h"
#include "algebra3d/kernel/repair/detail/unmatched_triangles.h"

namespace algebra3d {
namespace {

Vec3 vector_area(const Triangle3& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

/// The direction in which the patch is seen largest; that of its largest triangle, if its triangles face all ways.
Vec3 main_normal(std::span<const Triangle3> patch) {
  Vec3 sum, largest;
  double whole = 0;
  for (const Triangle3& triangle : patch) {
    const Vec3 own = vector_area(triangle);
    sum = sum + own;
    whole += length(own);
    if (length(own) > length(largest)) largest = own;
  }
  const Vec3 normal = length(sum) > whole / 2 ? sum : largest;
  const double size = length(normal);
  return size > 0 ? (1 / size) * normal : Vec3{};
}

bool is_flat(std::span<const Triangle3> patch, double tolerance) {
  const Vec3 normal = main_normal(patch), origin = patch.front()[0];
  double low = 0, high = 0;
  for (const Triangle3& triangle : patch)
    for (const Vec3& corner : triangle) {
      const double height = dot(normal, corner - origin);
      low = std::min(low, height);
      high = std::max(high, height);
      if (high - low > tolerance) return false;
    }
  return true;
}

/// Tests whether triangles lie upon a surface.
class UponTest {
 public:
  UponTest(std::span<const Triangle3> surface, double tolerance)
      : tolerance_(tolerance), distance_({surface.begin(), surface.end()}) {
    for (const Triangle3& triangle : surface) surface_.add(triangle, 1);
    surface_.index(tolerance);
  }

  bool lies_upon(const Triangle3& triangle) const;

 private:
  double tolerance_;
  UnmatchedTriangles surface_;
  SurfaceDistance distance_;
};

/// The coplanar triangles of the surface are taken away from the triangle, and the distance of the rest is asked.
bool UponTest::lies_upon(const Triangle3& triangle) const {
  constexpr std::size_t kMostParts = 200;
  const MeasuredTriangle whole(triangle);
  TriangleParts parts(whole);
  for (const auto number : surface_.tree.window(box_of(triangle))) {
    const MeasuredTriangle& other = surface_.triangles[UnmatchedId(number)];
    if (are_coplanar(whole, other, tolerance_)) parts.subtract(other, tolerance_);
    if (parts.size() > kMostParts) return false;
  }
  const auto is_near = [&](const Triangle3& part) { return distance_.is_near(part, tolerance_); };
  return std::ranges::all_of(std::move(parts).polygons(), [&](const ConvexPolygon& part) {
    return part.area() <= tolerance_ * tolerance_ || std::ranges::all_of(part.triangles(), is_near);
  });
}

}  // namespace

bool is_thin(std::span<const Triangle3> patch, std::span<const Triangle3> covers, double tolerance) {
  if (patch.empty() || is_flat(patch, tolerance)) return true;
  if (covers.empty()) return false;
  const UponTest test(patch, tolerance);
  return std::ranges::all_of(covers, [&](const Triangle3& cover) { return test.lies_upon(cover); });
}

}  // namespace algebra3d
