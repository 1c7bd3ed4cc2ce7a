#pragma once

#include <array>
#include <limits>
#include <vector>

#include "algebra3d/kernel/congruence/congruence.h"
#include "algebra3d/kernel/exact/principal_axes.h"

namespace algebra3d::detail {

/// A solid in doubles, moved so that its centre of mass is the origin, and divided by a unit, a power of two, so that
/// fifth powers of its size are within the range of doubles.
class CentredSolid {
 public:
  static Result<CentredSolid> make(const CongruenceOperand& operand, double unit, const Monitor& monitor);

  const TriangleMesh& mesh() const { return *operand_.mesh; }
  double volume() const { return volume_; }
  /// Principal moments and axes.
  const PrincipalAxes& axes() const { return axes_; }
  /// The centre of mass of the solid as it was given, rounded.
  const Vec3& centre() const { return centre_; }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  /// The distance of the farthest vertex from the centre.
  double radius() const { return radius_; }
  std::array<Vec3, 3> triangle(FaceId face) const {
    const auto [a, b, c] = mesh().triangle(face);
    return {vertices_[a], vertices_[b], vertices_[c]};
  }
  /// Calls visit(face) for each face whose box meets the box, but for rounding, until it returns false.
  template <typename Visit>
  void for_each_meeting(const Box3& box, const Visit& visit) const {
    operand_.hierarchy->for_each_meeting({unit_ * box.min + centre_ - kSlack, unit_ * box.max + centre_ + kSlack},
                                         [&](std::uint32_t face) { return visit(FaceId(face)); });
  }

 private:
  /// A margin of windows, above the roundings of the centre and of a window in the subnormal range.
  static constexpr double kLeast = 4 * std::numeric_limits<double>::denorm_min();
  static constexpr Vec3 kSlack{kLeast, kLeast, kLeast};

  CentredSolid() = default;

  CongruenceOperand operand_;
  double unit_ = 1, volume_ = 0;
  PrincipalAxes axes_;
  Vec3 centre_;
  std::vector<Vec3> vertices_;
  double radius_ = 0;
};

}  // namespace algebra3d::detail
