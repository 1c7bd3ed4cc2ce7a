#include "algebra3d/kernel/congruence/detail/boundary_cover.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/nearest_in_triangle.h"
#include "base/propagate.h"

namespace algebra3d::detail {
namespace {

using Corners = std::array<Vec3, 3>;
/// A convex polygon.
using Piece = std::vector<Vec3>;

Vec3 nearest_point(const Vec3& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const auto [first, second] = nearest_in_triangle(p - a, b - a, c - a);
  return a + first * (b - a) + second * (c - a);
}

template <typename Points>
bool are_near(const Points& points, const Corners& triangle, double tolerance) {
  return std::ranges::all_of(points,
                             [&](const Vec3& p) { return length(p - nearest_point(p, triangle)) <= tolerance; });
}

/// Divides a convex polygon by the plane through `base` with this normal.
struct Halves {
  Piece front, back;
};
Halves divide(const Piece& piece, const Vec3& base, const Vec3& normal) {
  Halves halves;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 &p = piece[i], &q = piece[(i + 1) % piece.size()];
    const double from = dot(p - base, normal), to = dot(q - base, normal);
    if (from >= 0) halves.front.push_back(p);
    if (from <= 0) halves.back.push_back(p);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const Vec3 cut = p + from / (from - to) * (q - p);
      halves.front.push_back(cut);
      halves.back.push_back(cut);
    }
  }
  return halves;
}

/// A plane by a point and the normal that points to what is kept.
struct Side {
  Vec3 base, normal;
};

/// The planes around the prism over a triangle: through its edges, and across its corners so that acute ones do not
/// stick out. All are moved outward by a margin far above rounding, so that prisms of neighbouring triangles overlap
/// and nothing is left between them.
std::vector<Side> sides_of_prism(const Corners& triangle, double margin) {
  const Vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  std::vector<Side> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 next = unit_vector(triangle[(i + 1) % 3] - triangle[i]);
    const Vec3 previous = unit_vector(triangle[(i + 2) % 3] - triangle[i]);
    for (const Vec3& inward : {unit_vector(cross(normal, next)), unit_vector(next + previous)})
      sides.push_back({triangle[i] - margin * inward, inward});
  }
  return sides;
}

/// The parts of a piece over a triangle and elsewhere.
struct Division {
  Piece over;
  std::vector<Piece> elsewhere;
};
Division divide(const Piece& piece, const std::vector<Side>& prism) {
  Division result{piece, {}};
  for (const Side& side : prism) {
    Halves halves = divide(result.over, side.base, side.normal);
    if (halves.back.size() > 2) result.elsewhere.push_back(std::move(halves.back));
    if (halves.front.size() < 3) return {};
    result.over = std::move(halves.front);
  }
  return result;
}

/// The share of the tolerance that the margin of prisms takes.
constexpr double kMargin = 0x1p-8;

/// True if a triangle is within the tolerance of some others together, and of none of them alone.
bool is_covered(const Corners& triangle, const std::vector<Corners>& others, double tolerance) {
  const auto is_near_one = [&](const auto& points) {
    return std::ranges::any_of(others, [&](const Corners& other) { return are_near(points, other, tolerance); });
  };
  std::vector<Piece> pieces{{triangle.begin(), triangle.end()}};
  for (const Corners& other : others) {
    const std::vector<Side> prism = sides_of_prism(other, kMargin * tolerance);
    std::vector<Piece> left;
    for (Piece& piece : pieces) {
      Division division = divide(piece, prism);
      if (division.over.empty() || !are_near(division.over, other, tolerance))
        left.push_back(std::move(piece));
      else
        std::ranges::move(division.elsewhere, std::back_inserter(left));
    }
    pieces = std::move(left);
  }
  return std::ranges::all_of(pieces, is_near_one);
}

Box3 enlarged_box(const Corners& corners, double margin) {
  const Box3 box = Box3::around(corners);
  const Vec3 all{margin, margin, margin};
  return {box.min - all, box.max + all};
}

}  // namespace

Result<bool> is_boundary_near(const CentredSolid& solid, const Rotation& rotation, const CentredSolid& other,
                              const FaceLookup& faces_of_other, double tolerance, const Monitor& monitor) {
  std::vector<Corners> others;
  for (std::size_t f = 0; f < solid.mesh().face_count(); ++f) {
    if (f % 1024 == 0) A3D_TRY(monitor.check());
    Corners corners = solid.triangle(FaceId(f));
    for (Vec3& corner : corners) corner = rotation(corner);
    if (faces_of_other.has_triangle_near(corners)) continue;
    others.clear();
    bool is_near_one = false;
    // Twice the tolerance: the centre of the other is rounded.
    other.for_each_meeting(enlarged_box(corners, 2 * tolerance), [&](FaceId face) {
      others.push_back(other.triangle(face));
      is_near_one = are_near(corners, others.back(), tolerance);
      return !is_near_one;
    });
    if (!is_near_one && !is_covered(corners, others, tolerance)) return false;
  }
  return true;
}

}  // namespace algebra3d::detail
