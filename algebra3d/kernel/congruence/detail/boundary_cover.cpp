#include "algebra3d/kernel/congruence/detail/boundary_cover.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/nearest_in_triangle.h"
#include "base/propagate.h"

namespace algebra3d::detail {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 nearest_point(const Vec3& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const auto [first, second] = nearest_in_triangle(p - a, b - a, c - a);
  return a + first * (b - a) + second * (c - a);
}

/// Solids are divided by a unit, so squares are within the range of doubles.
bool are_near(std::span<const Vec3> points, const Corners& triangle, double tolerance) {
  return std::ranges::all_of(points, [&](const Vec3& p) {
    const Vec3 way = p - nearest_point(p, triangle);
    return std::sqrt(dot(way, way)) <= tolerance;
  });
}

/// A plane by a point and the normal that points to what is kept.
struct Side {
  Vec3 base, normal;
};

/// Divides a convex polygon.
void divide(std::span<const Vec3> piece, const Side& side, std::vector<Vec3>& front, std::vector<Vec3>& back) {
  front.clear();
  back.clear();
  double from = dot(piece.front() - side.base, side.normal);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 &p = piece[i], &q = piece[i + 1 < piece.size() ? i + 1 : 0];
    const double to = dot(q - side.base, side.normal);
    if (from >= 0) front.push_back(p);
    if (from <= 0) back.push_back(p);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const Vec3 cut = p + from / (from - to) * (q - p);
      front.push_back(cut);
      back.push_back(cut);
    }
    from = to;
  }
}

/// The planes around the prism over a triangle: through its edges, and across its corners so that acute ones do not
/// stick out. All are moved outward by a margin far above rounding, so that prisms of neighbouring triangles overlap
/// and nothing is left between them.
std::array<Side, 6> sides_of_prism(const Corners& triangle, double margin) {
  const Vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const std::array<Vec3, 3> edges{unit_vector(triangle[1] - triangle[0]), unit_vector(triangle[2] - triangle[1]),
                                  unit_vector(triangle[0] - triangle[2])};
  std::array<Side, 6> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &next = edges[i], &before = edges[i > 0 ? i - 1 : 2];
    const Vec3 along_edge = unit_vector(cross(normal, next)), across_corner = unit_vector(next - before);
    sides[2 * i] = {triangle[i] - margin * along_edge, along_edge};
    sides[2 * i + 1] = {triangle[i] - margin * across_corner, across_corner};
  }
  return sides;
}

/// Tells triangles apart from one in its plane: along the directions across its edges.
class EdgeGaps {
 public:
  explicit EdgeGaps(const Corners& triangle) {
    const Vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      inward_[i] = unit_vector(cross(normal, triangle[i < 2 ? i + 1 : 0] - triangle[i]));
      low_[i] = std::min({dot(inward_[i], triangle[0]), dot(inward_[i], triangle[1]), dot(inward_[i], triangle[2])});
    }
  }

  /// True if no point of the other one is within the distance of the triangle.
  bool exceed(const Corners& other, double distance) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const double high = std::max({dot(inward_[i], other[0]), dot(inward_[i], other[1]), dot(inward_[i], other[2])});
      if (high < low_[i] - distance) return true;
    }
    return false;
  }

 private:
  std::array<Vec3, 3> inward_;
  std::array<double, 3> low_{};
};

/// Convex polygons, in one piece of memory.
class Pieces {
 public:
  std::size_t size() const { return ends_.size(); }
  std::span<const Vec3> operator[](std::size_t i) const {
    const std::size_t begin = i > 0 ? ends_[i - 1] : 0;
    return std::span(corners_).subspan(begin, ends_[i] - begin);
  }
  void add(std::span<const Vec3> corners) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    ends_.push_back(corners_.size());
  }
  /// Keeps only so many of the first ones.
  void shrink(std::size_t count) {
    ends_.resize(count);
    corners_.resize(count > 0 ? ends_.back() : 0);
  }

 private:
  std::vector<Vec3> corners_;
  std::vector<std::size_t> ends_;
};

/// The share of the tolerance that the margin of prisms takes.
constexpr double kMargin = 0x1p-8;

/// Finds out whether some triangles together cover another one, for one after the other: keeps its memory.
class Cover {
 public:
  explicit Cover(double tolerance) : tolerance_(tolerance) {}

  /// True if a triangle is within the tolerance of some others together, and of none of them alone.
  bool is_covered(const Corners& triangle, std::span<const Corners> others) {
    pieces_.shrink(0);
    pieces_.add(triangle);
    for (const Corners& other : others) {
      const std::array<Side, 6> prism = sides_of_prism(other, kMargin * tolerance_);
      left_.shrink(0);
      for (std::size_t i = 0; i < pieces_.size(); ++i) leave_beside(pieces_[i], other, prism);
      std::swap(pieces_, left_);
      if (pieces_.size() == 0) return true;
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (!std::ranges::any_of(others, [&](const Corners& other) { return are_near(pieces_[i], other, tolerance_); }))
        return false;
    return true;
  }

 private:
  /// Leaves what of a piece is not over a triangle and near it.
  void leave_beside(std::span<const Vec3> piece, const Corners& other, std::span<const Side, 6> prism) {
    const std::size_t before = left_.size();
    over_.assign(piece.begin(), piece.end());
    for (const Side& side : prism) {
      divide(over_, side, front_, back_);
      if (front_.size() < 3) {
        over_.clear();
        break;
      }
      if (back_.size() > 2) left_.add(back_);
      std::swap(over_, front_);
    }
    if (!over_.empty() && are_near(over_, other, tolerance_)) return;
    left_.shrink(before);
    left_.add(piece);
  }

  double tolerance_;
  Pieces pieces_, left_;
  std::vector<Vec3> over_, front_, back_;
};

Box3 enlarged_box(const Corners& corners, double margin) {
  const Box3 box = Box3::around(corners);
  const Vec3 all{margin, margin, margin};
  return {box.min - all, box.max + all};
}

}  // namespace

Result<bool> is_boundary_near(const CentredSolid& solid, const Rotation& rotation, const CentredSolid& other,
                              const FaceLookup& faces_of_other, double tolerance, const Monitor& monitor) {
  std::vector<Corners> others;
  Cover cover(tolerance);
  for (std::size_t f = 0; f < solid.mesh().face_count(); ++f) {
    if (f % 1024 == 0) A3D_TRY(monitor.check());
    Corners corners = solid.triangle(FaceId(f));
    for (Vec3& corner : corners) corner = rotation(corner);
    if (faces_of_other.has_triangle_near(corners)) continue;
    others.clear();
    bool is_near_one = false;
    const EdgeGaps gaps(corners);
    // Twice the tolerance: the centre of the other is rounded.
    other.for_each_meeting(enlarged_box(corners, 2 * tolerance), [&](FaceId face) {
      const Corners found = other.triangle(face);
      if (gaps.exceed(found, 2 * tolerance)) return true;
      others.push_back(found);
      is_near_one = are_near(corners, found, tolerance);
      return !is_near_one;
    });
    if (!is_near_one && !cover.is_covered(corners, others)) return false;
  }
  return true;
}

}  // namespace algebra3d::detail
