#include "algebra3d/kernel/exact/principal_axes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "algebra3d/kernel/exact/plane.h"

namespace algebra3d {
namespace {

/// The characteristic polynomial t^3 + a t^2 + b t + c.
struct CharacteristicPolynomial {
  Rational a, b, c;

  explicit CharacteristicPolynomial(const SymmetricMatrix& m)
      : a(-(m.xx + m.yy + m.zz)),
        b(m.xx * m.yy + m.yy * m.zz + m.zz * m.xx - m.xy * m.xy - m.yz * m.yz - m.zx * m.zx),
        c(-(m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.zx) +
            m.zx * (m.xy * m.yz - m.yy * m.zx))) {}

  Rational discriminant() const {
    return Rational(18) * a * b * c - Rational(4) * a * a * a * c + a * a * b * b - Rational(4) * b * b * b -
           Rational(27) * c * c;
  }
};

/// Numbers of eigenvalues above a number and equal to it.
struct RootCount {
  int above = 0, equal = 0;
};

/// By the signs of the Taylor coefficients: all roots are real, so Descartes' rule gives their exact number.
RootCount count_roots(const CharacteristicPolynomial& p, const Rational& t) {
  const Rational half_second = Rational(3) * t + p.a;
  const Rational first = (half_second + p.a) * t + p.b;
  const Rational value = ((t + p.a) * t + p.b) * t + p.c;
  RootCount count;
  if (value.sign() == 0) count.equal = first.sign() != 0 ? 1 : half_second.sign() != 0 ? 2 : 3;
  int last = 1;
  for (const int sign : {half_second.sign(), first.sign(), value.sign()}) {
    if (sign == 0) continue;
    if (sign != last) ++count.above;
    last = sign;
  }
  return count;
}

/// The eigenvalue number `index`, ascending.
class Eigenvalue {
 public:
  Eigenvalue(const CharacteristicPolynomial& polynomial, int index, double estimate)
      : polynomial_(polynomial), count_(3 - index) {
    bracket(std::bit_cast<std::uint64_t>(std::clamp(estimate, 0.0, 0x1p1023)));
  }

  /// Nearest double, ties to even; infinite beyond the range of doubles.
  double rounded() const {
    if (is_huge_) return std::numeric_limits<double>::infinity();
    const auto low = std::bit_cast<double>(low_bits_), high = std::bit_cast<double>(low_bits_ + 1);
    const Rational middle = Rational(1, 2) * (Rational(low) + Rational(high));
    const RootCount count = count_roots(polynomial_, middle);
    if (count.above >= count_) return high;
    if (count.above + count.equal < count_) return low;
    return low_bits_ % 2 == 0 ? low : high;
  }

  /// An interval that contains the eigenvalue: low < value <= high.
  const Rational& low() const { return low_; }
  const Rational& high() const { return high_; }
  Rational width() const { return high_ - low_; }
  void halve() {
    Rational middle = Rational(1, 2) * (low_ + high_);
    (is_above(middle) ? low_ : high_) = std::move(middle);
  }

 private:
  static constexpr std::uint64_t kLargest = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::max());

  bool is_above(const Rational& t) const { return count_roots(polynomial_, t).above >= count_; }
  bool is_above(std::uint64_t bits) const { return is_above(Rational(std::bit_cast<double>(bits))); }

  /// The step after this one, which never wraps around to 0.
  static constexpr std::uint64_t longer(std::uint64_t step) { return step < kLargest / 4 ? 4 * step : kLargest; }

  /// Finds the double below the eigenvalue, near an estimate: steps of growing length, then halving. Positive doubles
  /// are ordered as their bits.
  void bracket(std::uint64_t estimate) {
    std::uint64_t low = estimate, high = estimate;
    for (std::uint64_t step = 1; low > 0 && !is_above(low); step = longer(step)) {
      high = low;
      low -= std::min(step, low);
    }
    if (high == low) high = low + 1;
    for (std::uint64_t step = 1; is_above(high); step = longer(step)) {
      if (high == kLargest) {
        set_huge();
        return;
      }
      low = high;
      high += std::min(step, kLargest - high);
    }
    while (high - low > 1) {
      const std::uint64_t middle = low + (high - low) / 2;
      (is_above(middle) ? low : high) = middle;
    }
    low_bits_ = low;
    low_ = Rational(std::bit_cast<double>(low));
    high_ = Rational(std::bit_cast<double>(high));
  }
  /// The trace is above all eigenvalues of a positive definite matrix.
  void set_huge() {
    is_huge_ = true;
    low_ = Rational(std::numeric_limits<double>::max());
    high_ = -polynomial_.a;
  }

  const CharacteristicPolynomial& polynomial_;
  int count_;  // of eigenvalues from this one on
  std::uint64_t low_bits_ = 0;
  bool is_huge_ = false;
  Rational low_, high_;
};

/// Eigenvalues of the matrix, rounded, ascending: estimates by the trigonometric formula.
std::array<double, 3> estimates(const CharacteristicPolynomial& p) {
  const Rational trace = -p.a;
  // The polynomial t^3 - q t - r is that of the matrix divided by its trace, less a third of the identity.
  const double b = (p.b / (trace * trace)).nearest_double(), c = (p.c / (trace * trace * trace)).nearest_double();
  const double q = std::max(0.0, 1.0 / 3 - b), r = 2.0 / 27 - b / 3 - c;
  const double size = 2 * std::sqrt(q / 3);
  const double cosine = q == 0 ? 1 : std::clamp(1.5 * r / q * std::sqrt(3 / q), -1.0, 1.0);
  const double angle = std::acos(cosine) / 3;
  std::array<double, 3> values{};
  for (int i = 0; i < 3; ++i) {
    const double t = 1.0 / 3 + size * std::cos(angle - 2.0943951023931957 * i);
    values[static_cast<std::size_t>(i)] = (trace * Rational(t)).nearest_double();
  }
  std::ranges::sort(values);
  return values;
}

/// The unit vector in the direction of v or in the opposite one, by the rule of the header.
Vec3 unit(const RationalVec3& v) {
  const Rational largest = std::max({v.x.abs(), v.y.abs(), v.z.abs()});
  const RationalVec3 scaled = Rational(1) / largest * v;
  const Vec3 rounded{scaled.x.nearest_double(), scaled.y.nearest_double(), scaled.z.nearest_double()};
  const Vec3 result = 1 / length(rounded) * rounded;
  constexpr double kClear = 0.57;  // below 3^-1/2, so that a component exceeds it
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(result[axis]) > kClear) return (result[axis] < 0 ? -1 : 1) * result + Vec3{};
  return result;
}

std::array<RationalVec3, 3> rows_minus(const SymmetricMatrix& m, const Rational& t) {
  return {RationalVec3{m.xx - t, m.xy, m.zx}, RationalVec3{m.xy, m.yy - t, m.yz}, RationalVec3{m.zx, m.yz, m.zz - t}};
}

Rational squared_length(const RationalVec3& v) {
  return dot(v, v);
}

const RationalVec3& longest(const std::array<RationalVec3, 3>& vectors) {
  return *std::ranges::max_element(vectors, {}, squared_length);
}

/// The eigenvector of an eigenvalue that is known nearly: the columns of the adjugate are its multiples.
RationalVec3 simple_eigenvector(const SymmetricMatrix& m, const Rational& value) {
  const auto [x, y, z] = rows_minus(m, value);
  return longest({cross(y, z), cross(z, x), cross(x, y)});
}

/// Axes for a double eigenvalue, exactly. All columns of the matrix less that value are multiples of the other
/// eigenvector.
struct DoubleAxes {
  RationalVec3 single, first, second;
};
DoubleAxes double_axes(const SymmetricMatrix& m, const Rational& double_value) {
  const RationalVec3 u = primitive_direction(longest(rows_minus(m, double_value)));
  const std::array<Rational, 3> sizes{u.x.abs(), u.y.abs(), u.z.abs()};
  const auto axis = static_cast<std::size_t>(std::ranges::min_element(sizes) - sizes.begin());
  const RationalVec3 coordinate_axis(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
  const RationalVec3 first = squared_length(u) * coordinate_axis - u[axis] * u;
  return {u, first, cross(u, first)};
}

/// Narrows the intervals until their widths are small beside the gaps between them.
void separate(std::array<Eigenvalue, 3>& values) {
  const Rational small(1, std::int64_t{1} << 56);
  for (std::size_t i = 0; i < 2; ++i) {
    Eigenvalue &below = values[i], &above = values[i + 1];
    while (small * (above.low() - below.high()) <= below.width() + above.width()) {
      below.halve();
      above.halve();
    }
  }
}

void make_right_handed(std::array<Vec3, 3>& axes) {
  if (dot(cross(axes[0], axes[1]), axes[2]) < 0) axes[2] = -1 * axes[2] + Vec3{};
}

}  // namespace

PrincipalAxes principal_axes(const SymmetricMatrix& matrix) {
  const CharacteristicPolynomial p(matrix);
  const std::array<double, 3> guess = estimates(p);
  std::array<Eigenvalue, 3> values{Eigenvalue(p, 0, guess[0]), Eigenvalue(p, 1, guess[1]), Eigenvalue(p, 2, guess[2])};
  PrincipalAxes result;
  for (std::size_t i = 0; i < 3; ++i) result.values[i] = values[i].rounded();
  const Rational spread = p.a * p.a - Rational(3) * p.b;  // 0 if all are equal
  if (spread.sign() == 0) {
    result.are_equal = {true, true};
    result.axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    return result;
  }
  if (p.discriminant().sign() == 0) {
    const Rational double_value = (Rational(9) * p.c - p.a * p.b) / (Rational(2) * spread);
    const auto [single, first, second] = double_axes(matrix, double_value);
    const bool is_lowest = count_roots(p, double_value).above == 1;
    result.are_equal = {is_lowest, !is_lowest};
    if (is_lowest)
      result.axes = {unit(first), unit(second), unit(single)};
    else
      result.axes = {unit(single), unit(first), unit(second)};
  } else {
    separate(values);
    for (std::size_t i = 0; i < 3; ++i) result.axes[i] = unit(simple_eigenvector(matrix, values[i].high()));
  }
  make_right_handed(result.axes);
  return result;
}

}  // namespace algebra3d
