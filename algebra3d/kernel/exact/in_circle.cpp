#include "algebra3d/kernel/exact/in_circle.h"

#include <array>
#include <cstdint>

#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/detail/predicates_integers.h"
#include "algebra3d/kernel/exact/expansion.h"
#include "algebra3d/kernel/exact/interval.h"

namespace algebra3d::detail {
namespace {

/// Sum of products of 123 bits, kept as three numbers of 64 bits with capacity for carries.
class ProductSum {
 public:
  /// `square` is not negative; both are below 2^123.
  void add(Int128 square, Int128 minor) {
    const auto square_low = static_cast<std::uint64_t>(square), minor_low = static_cast<std::uint64_t>(minor);
    const Int128 square_high = square >> 64, minor_high = minor >> 64;
    const UInt128 low = UInt128{square_low} * minor_low;
    high_ += square_high * minor_high;
    middle_ += square_high * minor_low + minor_high * square_low + static_cast<Int128>(low >> 64U);
    low_ += static_cast<Int128>(static_cast<std::uint64_t>(low));
  }
  int sign() const {
    const Int128 middle = middle_ + (low_ >> 64);
    const Int128 high = high_ + (middle >> 64);
    if (high != 0) return high > 0 ? 1 : -1;
    return static_cast<std::uint64_t>(middle) != 0 || static_cast<std::uint64_t>(low_) != 0 ? 1 : 0;
  }

 private:
  Int128 high_ = 0, middle_ = 0, low_ = 0;
};

/// Coordinates x and y in turn, integers below 2^60, of a, b, c, d.
int in_circle_sign(const std::array<std::int64_t, 8>& coordinates) {
  std::array<Int128, 3> x{}, y{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = coordinates[2 * i] - coordinates[6];
    y[i] = coordinates[2 * i + 1] - coordinates[7];
  }
  ProductSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add(x[i] * x[i] + y[i] * y[i], x[j] * y[k] - x[k] * y[j]);
  }
  return sum.sign();
}

/// Products of four differences neither overflow nor lose a bit: all parts are multiples of 2^(4 * (-200 - 52)) and
/// smaller than 2^(4 * 201 + 4).
bool is_safe_for_squares(const Vec3& v) {
  const auto is_small = [](double c) { return std::abs(c) <= 0x1p200; };
  return is_safe(v.x) && is_safe(v.y) && is_small(v.x) && is_small(v.y);
}

int in_circle_by_expansions(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto adx = difference(a.x, d.x), ady = difference(a.y, d.y);
  const auto bdx = difference(b.x, d.x), bdy = difference(b.y, d.y);
  const auto cdx = difference(c.x, d.x), cdy = difference(c.y, d.y);
  const auto with_square = [](const Expansion<16>& minor, const Expansion<2>& x, const Expansion<2>& y) {
    return minor * x * x + minor * y * y;
  };
  const auto from_a = with_square(bdx * cdy - cdx * bdy, adx, ady);
  const auto from_b = with_square(cdx * ady - adx * cdy, bdx, bdy);
  const auto from_c = with_square(adx * bdy - bdx * ady, cdx, cdy);
  return (from_a + from_b + from_c).sign();
}

/// Differences from d with a common divisor per point: (x, y) = (X, Y) / W.
struct IntegerDifference {
  mpz_class x, y, w, square;

  void set(const HomogeneousView& p, const HomogeneousView& d) {
    set_difference(x, p, d, 0);
    set_difference(y, p, d, 1);
    mpz_mul(w.get_mpz_t(), p[3], d[3]);
    square = x * x;
    mpz_addmul(square.get_mpz_t(), y.get_mpz_t(), y.get_mpz_t());
  }

 private:
  static void set_difference(mpz_class& result, const HomogeneousView& p, const HomogeneousView& d, std::size_t axis) {
    mpz_mul(result.get_mpz_t(), p[axis], d[3]);
    mpz_submul(result.get_mpz_t(), d[axis], p[3]);
  }
};

/// The determinant of rows (x w, y w, x^2 + y^2), which are the true ones times w^2.
int in_circle_by_integers(const std::array<const PointRef*, 4>& points) {
  thread_local HomogeneousPoint buffer, buffer_of_d;
  thread_local std::array<IntegerDifference, 3> rows;
  thread_local mpz_class minor, term, sum;
  count_big_fallback();
  const HomogeneousView d(*points[3], buffer_of_d);
  for (std::size_t i = 0; i < 3; ++i) rows[i].set(HomogeneousView(*points[i], buffer), d);
  sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const IntegerDifference &u = rows[i], &v = rows[(i + 1) % 3], &w = rows[(i + 2) % 3];
    minor = v.x * w.y;
    mpz_submul(minor.get_mpz_t(), w.x.get_mpz_t(), v.y.get_mpz_t());
    term = v.w * w.w;
    term *= u.square;
    mpz_addmul(sum.get_mpz_t(), term.get_mpz_t(), minor.get_mpz_t());
  }
  return sgn(sum);
}

int in_circle_by_intervals(const std::array<const PointRef*, 4>& points) {
  std::array<Interval, 3> x, y;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = interval_of(*points[i], 0) - interval_of(*points[3], 0);
    y[i] = interval_of(*points[i], 1) - interval_of(*points[3], 1);
  }
  Interval sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum = sum + (x[i] * x[i] + y[i] * y[i]) * (x[j] * y[k] - x[k] * y[j]);
  }
  return sum.sign();
}

}  // namespace

int decide_in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  count_filter_failure();
  if (const auto scaled = scale_to_integers<8>({a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y}))
    return in_circle_sign(scaled->integers);
  if (is_safe_for_squares(a) && is_safe_for_squares(b) && is_safe_for_squares(c) && is_safe_for_squares(d))
    return in_circle_by_expansions(a, b, c, d);
  const PointRef pa = a, pb = b, pc = c, pd = d;
  return in_circle_by_integers({&pa, &pb, &pc, &pd});
}

int in_circle_of_rationals(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d) {
  const std::array<const PointRef*, 4> points{&a, &b, &c, &d};
  const int sign = in_circle_by_intervals(points);
  if (sign != kUndecided) return sign;
  count_filter_failure();
  return in_circle_by_integers(points);
}

}  // namespace algebra3d::detail
