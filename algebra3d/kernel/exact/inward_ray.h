#pragma once

#include <array>
#include <optional>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/detail/pair_coordinates.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

/// The ray from the centroid of a triangle straight against its normal, and where it meets other triangles: in pairs of
/// doubles, and integers where these do not decide. Refers to the triangle's coordinates.
class InwardRay {
 public:
  /// Where the line of the ray meets the plane of a triangle. The triangle lies on both sides of the line, or has it in
  /// an edge, if no two signs are opposite.
  struct Meeting {
    /// Of each edge, from corner i to the next one, on which side the line passes: 1, 0, or -1.
    std::array<int, 3> sides{};
    /// The place on the ray is over / under, in units of a third of the normal; under is positive.
    detail::BoundedPair over, under;

    bool is_met() const;
    /// 1 if it is ahead of the centroid, 0, or -1; nothing if that is not known.
    std::optional<int> direction() const;
  };

  /// Nothing if pairs of doubles do not do for a triangle: with coordinates beyond 2^60 or below 2^-40, or too thin.
  static std::optional<InwardRay> from(const TriangleRef& triangle);

  /// The centroid, off by at most 2^-50 of the largest coordinate of the triangle.
  const Vec3& origin() const { return origin_; }
  /// Of length 1, off by at most 2^-50.
  const Vec3& direction() const { return direction_; }

  /// Nothing if a sign is not known, or the line lies in the plane. Exact. Cost: a microsecond.
  std::optional<Meeting> meeting(const TriangleRef& triangle) const;
  /// The distance of the centroid from the place, rounded to nearest; nothing if that is not known.
  std::optional<double> distance(const Meeting& meeting) const;

 private:
  using Triple = std::array<detail::BoundedPair, 3>;

  explicit InwardRay(const TriangleRef& triangle) : triangle_(triangle) {}
  Triple thrice_from_origin(const PointRef& point) const;

  TriangleRef triangle_;
  Vec3 origin_, direction_;
  Triple normal_;               // against that of the triangle
  detail::BoundedPair length_;  // of the normal
};

/// The order of two places on a ray: -1, 0, or 1; nothing if pairs of doubles do not decide it.
std::optional<int> order_on_ray(const InwardRay::Meeting& a, const InwardRay::Meeting& b);

}  // namespace algebra3d
