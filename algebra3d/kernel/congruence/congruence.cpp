#include "algebra3d/kernel/congruence/congruence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra3d/kernel/congruence/detail/boundary_cover.h"
#include "algebra3d/kernel/congruence/detail/centred_solid.h"
#include "algebra3d/kernel/congruence/detail/face_lookup.h"
#include "algebra3d/kernel/congruence/detail/motion_candidates.h"
#include "algebra3d/kernel/exact/predicates_filter.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::CentredSolid;
using detail::Rotation;

/// False if the boxes show that the diameters differ by more than the tolerance allows: a diameter is at most the
/// square root of 3 times the longest side of its box.
bool may_have_one_diameter(const Box3& a, const Box3& b, double tolerance) {
  const double size_a = detail::largest(0.5 * a.max - 0.5 * a.min), size_b = detail::largest(0.5 * b.max - 0.5 * b.min);
  return std::max(size_a, size_b) / 2 <= std::min(size_a, size_b) + tolerance;
}

/// The tolerance in a unit, raised to the smallest one that the rounded check can decide.
double effective_tolerance(const CentredSolid& a, const CentredSolid& b, double tolerance, double unit) {
  const double size = std::max(a.radius(), b.radius());
  const double coordinates = std::max(detail::largest(a.centre()), detail::largest(b.centre())) / unit + size;
  return std::max({tolerance / unit, 0x1p-36 * size, 0x1p-48 * coordinates});
}

/// An upper bound of the volume of all points within the tolerance of the boundary, which contains the symmetric
/// difference with every solid whose boundary is within the tolerance.
double volume_near_boundary(const CentredSolid& solid, double tolerance) {
  double area = 0, edges = 0, corners = 0;
  for (std::size_t f = 0; f < solid.mesh().face_count(); ++f) {
    const auto [a, b, c] = solid.triangle(FaceId(f));
    area += length(cross(b - a, c - a)) / 2;
    edges += length(b - a) + length(c - b) + length(a - c);
    corners += 3;
  }
  constexpr double kPi = std::numbers::pi, kMargin = 1 + 0x1p-20;  // for roundings
  return kMargin * tolerance * (2 * area + kPi * tolerance * (edges + 4.0 / 3 * tolerance * corners));
}

/// False if invariants show that no motion can carry one onto the other.
bool may_be_congruent(const CentredSolid& a, const CentredSolid& b, double tolerance) {
  if (std::abs(a.radius() - b.radius()) > 2 * tolerance) return false;
  const double difference = volume_near_boundary(a, tolerance);
  if (std::abs(a.volume() - b.volume()) > difference + 0x1p-50 * a.volume()) return false;
  // No moment changes by more than the integral of the squared distance over what is different.
  const double reach = a.radius() + 2 * tolerance;
  for (std::size_t i = 0; i < 3; ++i) {
    const double change = std::abs(a.axes().values[i] - b.axes().values[i]);
    if (change > 2 * difference * reach * reach + 0x1p-50 * a.axes().values[i]) return false;
  }
  return true;
}

RigidMotion motion_of(const CentredSolid& a, const CentredSolid& b, Rotation rotation) {
  RigidMotion motion;
  motion.centre = a.centre();
  motion.translation = b.centre() - a.centre();
  motion.is_mirrored = rotation.is_mirrored();
  if (motion.is_mirrored)
    for (Vec3& row : rotation.rows) row = -1 * row;
  const auto [axis, angle] = detail::axis_angle(rotation);
  motion.axis = axis;
  motion.angle_degrees = angle;
  return motion;
}

/// Finds out whether rotations carry the boundary of a solid onto that of another.
class MotionCheck {
 public:
  MotionCheck(const CentredSolid& a, const CentredSolid& b, double tolerance, const Monitor& monitor)
      : a_(a), b_(b), tolerance_(tolerance), monitor_(monitor), faces_of_a_(a, tolerance), faces_of_b_(b, tolerance) {}

  Result<bool> carries(const Rotation& rotation) const {
    A3D_ASSIGN(const bool is_there, detail::is_boundary_near(a_, rotation, b_, faces_of_b_, tolerance_, monitor_));
    if (!is_there) return false;
    return detail::is_boundary_near(b_, rotation.inverse(), a_, faces_of_a_, tolerance_, monitor_);
  }

 private:
  const CentredSolid &a_, &b_;
  double tolerance_;
  const Monitor& monitor_;
  detail::FaceLookup faces_of_a_, faces_of_b_;
};

}  // namespace

Result<std::optional<RigidMotion>> find_congruence(const CongruenceOperand& first, const CongruenceOperand& second,
                                                   double tolerance, const Monitor& monitor) {
  using Found = std::optional<RigidMotion>;
  if (tolerance < 0 || first.mesh->is_empty() || second.mesh->is_empty()) return Found();
  // Boxes of the hierarchies are coarse where coordinates are subnormal.
  const Box3 box = Box3::around(first.mesh->points().approx());
  if (!may_have_one_diameter(box, Box3::around(second.mesh->points().approx()), tolerance)) return Found();
  const double unit = length_unit(box);
  A3D_ASSIGN(const CentredSolid a, CentredSolid::make(first, unit, monitor));
  A3D_ASSIGN(const CentredSolid b, CentredSolid::make(second, unit, monitor));
  const double reach = effective_tolerance(a, b, tolerance, unit);
  if (!may_be_congruent(a, b, reach)) return Found();
  const MotionCheck check(a, b, reach, monitor);
  // The smallest angle, and what copies ask for.
  const Rotation none{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  A3D_ASSIGN(const bool is_moved_only, check.carries(none));
  if (is_moved_only) return Found(motion_of(a, b, none));
  A3D_ASSIGN(const auto rotations, detail::candidate_rotations(a, b, reach, monitor));
  for (const Rotation& rotation : rotations) {
    A3D_ASSIGN(const bool is_found, check.carries(rotation));
    if (is_found) return Found(motion_of(a, b, rotation));
  }
  return Found();
}

}  // namespace algebra3d
