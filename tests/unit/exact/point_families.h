#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include "algebra3d/kernel/exact/predicates.h"
#include "support/rounds.h"

/// Points for tests of exact geometry, each in both worlds: ours and CGAL's over GMP rationals, which is the oracle.
namespace algebra3d::point_families {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Oracle = Kernel::Point_3;

/// A number in both worlds: `multiple` over `divisor`; the divisor is 1 for doubles.
struct Number {
  double multiple = 0;
  std::int64_t divisor = 1;

  CGAL::Gmpq oracle() const {
    CGAL::Gmpq value;
    mpq_set_d(value.mpq(), multiple);
    return value / CGAL::Gmpq(static_cast<int>(divisor));
  }
  Rational ours() const { return Rational(multiple) / Rational(divisor); }
};

inline Rational ours_of(const CGAL::Gmpq& value) {
  std::ostringstream text;
  text << value.numerator() << '/' << value.denominator();
  return *Rational::parse(text.str());
}

struct TestPoint {
  ExactPoint ours;
  Oracle oracle;

  TestPoint(const Number& x, const Number& y, const Number& z)
      : ours(RationalVec3(x.ours(), y.ours(), z.ours())), oracle(x.oracle(), y.oracle(), z.oracle()) {}
  explicit TestPoint(const Oracle& p) : ours(RationalVec3(ours_of(p.x()), ours_of(p.y()), ours_of(p.z()))), oracle(p) {}
  explicit TestPoint(const Vec3& v) : TestPoint(Number{v.x}, Number{v.y}, Number{v.z}) {}
};

using Random = std::mt19937_64;

inline int integer(Random& random, int from, int to) {
  return std::uniform_int_distribution<int>(from, to)(random);
}
inline double real(Random& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

/// Families of points; in each, four points are coplanar and three collinear often enough to matter.
enum class Family {
  uniform,
  grid,
  scaled_grid,
  near_plane,
  wide_plane,
  extreme,
  thirds,
  far_thirds,
  mixed_thirds,
  near_plane_thirds,
  scaled_thirds
};
inline constexpr std::array kFamilies{
    Family::uniform,      Family::grid,   Family::scaled_grid, Family::near_plane,   Family::wide_plane,
    Family::extreme,      Family::thirds, Family::far_thirds,  Family::mixed_thirds, Family::near_plane_thirds,
    Family::scaled_thirds};

inline double moved_by_ulps(double value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, 9);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -9);
  return value;
}

inline Vec3 grid_point(Random& random) {
  const auto coordinate = [&] { return static_cast<double>(integer(random, 0, 3)); };
  return {coordinate(), coordinate(), coordinate()};
}

/// Some roundings off a plane or a line, each coordinate divided.
inline std::vector<TestPoint> near_plane(Random& random, std::size_t count, std::int64_t divisor) {
  const Vec3 a{real(random), real(random), real(random)};
  const Vec3 u{real(random), real(random), real(random)};
  const Vec3 v{real(random), real(random), real(random)};
  const bool on_line = integer(random, 0, 3) == 0;
  std::vector<TestPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p = a + real(random) * u;
    if (!on_line) p = p + real(random) * v;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = moved_by_ulps(p[axis], integer(random, -2, 2));
    points.emplace_back(Number{p.x, divisor}, Number{p.y, divisor}, Number{p.z, divisor});
  }
  return points;
}

/// On z = x - y, each at its own scale: exactly coplanar, but the bits of the coordinates lie far apart. Some are moved
/// off by their last bit.
inline Vec3 wide_plane_point(Random& random, int exponent) {
  const Vec3 g = grid_point(random);
  const double scale = std::ldexp(1, exponent + integer(random, -90, 90));
  return {scale * g.x, scale * g.y, scale * moved_by_ulps(g.x - g.y, integer(random, 0, 3) == 0 ? 1 : 0)};
}

/// Any exponent that a double can have, subnormal ones included; zero now and then.
inline double extreme(Random& random) {
  if (integer(random, 0, 7) == 0) return integer(random, 0, 1) != 0 ? 0.0 : -0.0;
  return std::ldexp(real(random), integer(random, 0, 1) != 0 ? integer(random, -1074, 1023) : integer(random, 0, 3));
}

inline std::vector<TestPoint> make_points(Family family, Random& random, std::size_t count) {
  if (family == Family::near_plane) return near_plane(random, count, 1);
  if (family == Family::near_plane_thirds) return near_plane(random, count, 3);
  constexpr std::array kScales{-1074, -1073, -1022, -520, -330, -201, -30, 0, 40, 299, 310, 520, 1021};
  const auto scale = [&] { return kScales[static_cast<std::size_t>(integer(random, 0, kScales.size() - 1))]; };
  const std::array exponents{scale(), scale(), scale()};
  constexpr std::array kMiddles{0, 0, -960, -330, -240, 240, 330, 900};
  const int middle = kMiddles[static_cast<std::size_t>(integer(random, 0, kMiddles.size() - 1))];
  const double far = std::ldexp(1, integer(random, 0, 50));
  std::vector<TestPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 g = grid_point(random);
    const auto scaled = [&](std::size_t axis) { return std::ldexp(g[axis] - 1.5, exponents[axis]); };
    switch (family) {
      case Family::uniform:
        points.emplace_back(Vec3{real(random), real(random), real(random)});
        break;
      case Family::wide_plane:
        points.emplace_back(wide_plane_point(random, middle));
        break;
      case Family::grid:
        points.emplace_back(g);
        break;
      case Family::scaled_grid:
        points.emplace_back(Vec3{scaled(0), scaled(1), scaled(2)});
        break;
      case Family::extreme:
        points.emplace_back(Vec3{extreme(random), extreme(random), extreme(random)});
        break;
      case Family::thirds:
        points.emplace_back(Number{g.x, 3}, Number{g.y, 7}, Number{g.z, 3});
        break;
      case Family::scaled_thirds:
        points.emplace_back(Number{scaled(0), 3}, Number{scaled(1), 7}, Number{scaled(2), 3});
        break;
      case Family::far_thirds:
        points.emplace_back(Number{far + g.x, 3}, Number{g.y, 3}, Number{far - g.z, 5});
        break;
      default:
        points.emplace_back(Number{g.x, integer(random, 0, 1) != 0 ? 1 : 3}, Number{g.y}, Number{g.z, 2});
        break;
    }
  }
  return points;
}

/// The oracle's numbers are long where exponents are extreme.
inline int sample_count(Family family) {
  if (family == Family::extreme || family == Family::scaled_thirds) return rounds(100);
  return rounds(family == Family::grid ? 4000 : 600);  // in few samples of a grid all kinds of contact occur
}

inline int sign_of(CGAL::Sign sign) {
  return static_cast<int>(sign);
}

inline int oracle_orient2d(Projection plane, const Oracle& a, const Oracle& b, const Oracle& c) {
  const int i = static_cast<int>(first_axis(plane));
  const int j = static_cast<int>(second_axis(plane));
  using Point2 = Kernel::Point_2;
  return sign_of(CGAL::orientation(Point2(a[i], a[j]), Point2(b[i], b[j]), Point2(c[i], c[j])));
}

}  // namespace algebra3d::point_families
