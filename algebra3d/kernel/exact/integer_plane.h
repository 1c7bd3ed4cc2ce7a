#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/intrusive_pointer.h"

namespace algebra3d {

namespace detail {
class HomogeneousView;
}

/// An oriented plane given by four integers: a x + b y + c z = d; the front is where the left side is larger. They may
/// have a common divisor, as long as they are short. Points are computed from them without fractions, and so without
/// greatest common divisors. Cheap to copy and to turn over: copies share the integers. Null by default.
class IntegerPlane {
 public:
  IntegerPlane() = default;
  /// The plane through the corners of a triangle that is not degenerate; from the front it turns counter-clockwise.
  /// Cost: some hundred nanoseconds for doubles, microseconds for other points.
  static IntegerPlane through(const TriangleRef& triangle);
  /// The plane through two different points and parallel to an axis (0: x, 1: y, 2: z), which their line must not be.
  static IntegerPlane along_axis(PointRef p, PointRef q, std::size_t axis);

  /// Converts an ExactPlane; same front.
  static IntegerPlane of(const ExactPlane& plane);

  /// Typical heap size of a plane.
  static constexpr std::size_t kTypicalBytes = 144;

  bool is_null() const { return form_.get() == nullptr; }
  /// The side on which the point lies: 1 in front, 0 in the plane, -1 behind. Exact: orient3d of three points in it.
  /// Cost: some nanoseconds if rounded numbers decide, else four products of integers.
  int side(const PointRef& point) const;
  /// The coefficients a, b, c, -d times one power of two and rounded, for detail::filter_rounded_side.
  std::array<double, 4> rounded() const;
  /// The plane with front and back exchanged.
  IntegerPlane flipped() const { return {form_, !is_flipped_}; }
  ExactPlane exact() const;
  /// a, b, c, -d. Valid as long as a copy of the plane lives.
  detail::HomogeneousView coefficients() const;

  /// Same plane, same front.
  friend bool operator==(const IntegerPlane& a, const IntegerPlane& b);

 private:
  struct Form;
  friend void add_owner(const Form& form) noexcept;
  friend void remove_owner(const Form& form) noexcept;
  /// An owner of the integers, or null; copies and the flipped plane share them.
  using SharedForm = IntrusivePointer<const Form>;

  IntegerPlane(SharedForm form, bool is_flipped) : form_(std::move(form)), is_flipped_(is_flipped) {}
  int side_by_integers(const PointRef& point) const;

  SharedForm form_;
  bool is_flipped_ = false;  // the integers of the form are those of this plane with the opposite signs
};

}  // namespace algebra3d
