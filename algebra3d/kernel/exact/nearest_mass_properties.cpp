#include "algebra3d/kernel/exact/nearest_mass_properties.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/moment_bounds.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::Bounds, detail::kFewLimbs, detail::kManyLimbs, detail::moment_bounds, detail::MomentBounds;

Bounds operator+(const Bounds& a, const Bounds& b) {
  return {a.lower + b.lower, a.upper + b.upper};
}
Bounds operator-(const Bounds& a, const Bounds& b) {
  return {a.lower - b.upper, a.upper - b.lower};
}
Bounds operator*(const Bounds& a, const Bounds& b) {
  const auto [lower, upper] = std::minmax({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
  return {lower, upper};
}

/// A number near the middle of bounds whose denominator is a short power of two, so that numbers computed from it stay
/// short; and how far the true number is from it at most.
struct ShortNumber {
  Rational value, error;

  explicit ShortNumber(const Bounds& bounds) {
    constexpr int kDoubles = 3;  // of 53 bits each
    for (int i = 0; i < kDoubles; ++i) {
      const double part = (bounds.lower - value).nearest_double();
      if (std::isfinite(part)) value += Rational(part);
    }
    error = std::max((bounds.lower - value).abs(), (bounds.upper - value).abs());
  }
};

/// Bounds of mass properties; the tensor about the centre as in MassProperties, in the order of kAxisPairs.
struct MassBounds {
  Bounds volume;
  std::array<Bounds, 3> centre;
  std::array<Bounds, 6> inertia;

  /// The volume must not have zero. By the parallel axis theorem.
  explicit MassBounds(const MomentBounds& moments) : volume(moments.volume) {
    for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = moments.first[axis] / volume;
    std::array<Bounds, 6> about;
    for (std::size_t pair = 0; pair < about.size(); ++pair) {
      const auto [i, j] = detail::kAxisPairs[pair];
      about[pair] = moments.second[pair] - centre[i] * moments.first[j];
    }
    const auto& [xx, yy, zz, yz, zx, xy] = about;
    const Bounds zero{Rational(0), Rational(0)};
    inertia = {yy + zz, zz + xx, xx + yy, zero - yz, zero - zx, zero - xy};
  }
};

SymmetricMatrix plus_multiple_of_identity(SymmetricMatrix m, const Rational& factor) {
  for (Rational* entry : {&m.xx, &m.yy, &m.zz}) *entry += factor;
  return m;
}

/// A tensor of short numbers, and how far its eigenvalues are from the true ones at most.
struct NearTensor {
  SymmetricMatrix matrix;
  Rational error;

  explicit NearTensor(const MassBounds& bounds) {
    std::array<Rational, 6> entries;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      ShortNumber number(bounds.inertia[i]);
      entries[i] = std::move(number.value);
      error = std::max(error, number.error);
    }
    // A symmetric matrix with entries of at most e has eigenvalues of at most 3 e.
    error = Rational(3) * error;
    auto& [xx, yy, zz, yz, zx, xy] = entries;
    matrix = {std::move(xx), std::move(yy), std::move(zz), std::move(yz), std::move(zx), std::move(xy)};
  }

  Rational trace() const { return matrix.xx + matrix.yy + matrix.zz; }
  /// True if all eigenvalues exceed `least`: by the leading minors (Sylvester's criterion).
  bool is_above(const Rational& least) const {
    const auto [xx, yy, zz, yz, zx, xy] = plus_multiple_of_identity(matrix, -least);
    const Rational minor = xx * yy - xy * xy;
    const Rational determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    return xx.sign() > 0 && minor.sign() > 0 && determinant.sign() > 0;
  }
};

/// The principal axes, if the bounds decide them: the values by those of the tensor moved by the error both ways, the
/// axes, which that leaves as they are, by the distances of the values.
std::optional<PrincipalAxes> principal_axes_within(const NearTensor& tensor) {
  if (!tensor.is_above(tensor.error)) return std::nullopt;
  PrincipalAxes lower = principal_axes(plus_multiple_of_identity(tensor.matrix, -tensor.error));
  if (lower.values != principal_axes(plus_multiple_of_identity(tensor.matrix, tensor.error)).values)
    return std::nullopt;
  // An axis turns by the error over the distance of its value from the next one.
  const Rational least_gap = Rational(0x1p60) * tensor.error;
  for (std::size_t i = 0; i < 2; ++i) {
    const double gap = lower.values[i + 1] - lower.values[i];
    if (!(gap > 0) || !std::isfinite(gap) || Rational(gap) <= least_gap) return std::nullopt;
  }
  return lower;
}

std::optional<NearestMassProperties> rounded_moments(const MomentBounds& moments) {
  if (moments.volume.has_zero()) return std::nullopt;
  const MassBounds bounds(moments);
  NearestMassProperties result;
  bool is_decided = true;
  const auto round = [&](double& number, const Bounds& its_bounds) {
    const std::optional<double> nearest = its_bounds.nearest_double();
    is_decided = is_decided && nearest;
    number = nearest.value_or(0);
  };
  round(result.volume, bounds.volume);
  for (std::size_t axis = 0; axis < 3; ++axis) round(result.centre[axis], bounds.centre[axis]);
  for (std::size_t i = 0; i < result.inertia.size(); ++i) round(result.inertia[i], bounds.inertia[i]);
  if (!is_decided) return std::nullopt;
  std::optional<PrincipalAxes> axes = principal_axes_within(NearTensor(bounds));
  if (!axes) return std::nullopt;
  result.principal = *std::move(axes);
  return result;
}

/// Nothing if the bounds are too wide.
std::optional<MassProperties> approximate(const MomentBounds& moments) {
  const Rational small(0x1p-80);
  const Bounds& volume = moments.volume;
  if (volume.has_zero() || volume.upper - volume.lower > small * volume.lower) return std::nullopt;
  const MassBounds bounds(moments);
  NearTensor tensor(bounds);
  if (tensor.error > small * tensor.trace() || !tensor.is_above(tensor.error)) return std::nullopt;
  // The trace is the integral of twice the squared distance from the centre: so the size of the solid is at least the
  // root of trace / (2 volume).
  const Rational squared_size = tensor.trace() / (Rational(2) * volume.upper);
  std::array<Rational, 3> centre;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ShortNumber number(bounds.centre[axis]);
    if (number.error * number.error > small * small * squared_size) return std::nullopt;
    centre[axis] = std::move(number.value);
  }
  auto& [x, y, z] = centre;
  return MassProperties{ShortNumber(volume).value, RationalVec3(std::move(x), std::move(y), std::move(z)),
                        std::move(tensor.matrix)};
}

NearestMassProperties nearest(const MassProperties& mass) {
  const auto& [xx, yy, zz, yz, zx, xy] = mass.inertia;
  const RationalVec3& c = mass.centre;
  return {mass.volume.nearest_double(),
          {c.x.nearest_double(), c.y.nearest_double(), c.z.nearest_double()},
          {xx.nearest_double(), yy.nearest_double(), zz.nearest_double(), yz.nearest_double(), zx.nearest_double(),
           xy.nearest_double()},
          principal_axes(mass.inertia)};
}

/// The result of `attempt` for bounds by few limbs, or else by many. Nothing if neither is enough, and for doubles,
/// whose exact sums are fast.
template <typename T, typename Attempt>
Result<std::optional<T>> by_bounds(const PointArray& points, IndexTriangles triangles, const std::atomic<bool>* cancel,
                                   const Attempt& attempt) {
  if (points.exact_count() == 0) return std::optional<T>();
  A3D_ASSIGN(const MomentBounds few, (moment_bounds<2, kFewLimbs>(points, triangles, cancel)));
  std::optional<T> result = attempt(few);
  if (result) return result;
  A3D_ASSIGN(const MomentBounds many, (moment_bounds<2, kManyLimbs>(points, triangles, cancel)));
  result = attempt(many);
  if (!result) detail::count_filter_failure();
  return result;
}

}  // namespace

Result<NearestMassProperties> nearest_mass_properties(const PointArray& points, IndexTriangles triangles,
                                                      const std::atomic<bool>* cancel) {
  A3D_ASSIGN(std::optional<NearestMassProperties> bounded,
             by_bounds<NearestMassProperties>(points, triangles, cancel, rounded_moments));
  if (bounded) return *std::move(bounded);
  A3D_ASSIGN(const MassProperties mass, mass_properties(points, triangles, cancel));
  return nearest(mass);
}

Result<MassProperties> approximate_mass_properties(const PointArray& points, IndexTriangles triangles,
                                                   const std::atomic<bool>* cancel) {
  A3D_ASSIGN(std::optional<MassProperties> bounded, by_bounds<MassProperties>(points, triangles, cancel, approximate));
  if (bounded) return *std::move(bounded);
  return mass_properties(points, triangles, cancel);
}

}  // namespace algebra3d
