#include "algebra3d/kernel/exact/affine_map.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmp.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/trigonometry.h"

namespace algebra3d {
namespace {

using Rows = std::array<RationalVec3, 3>;

class Real {
 public:
  Real() { mpfr_init2(value_, 2000); }
  explicit Real(const Rational& number) : Real() {
    mpq_t exact;
    mpq_init(exact);
    mpq_set_str(exact, number.text().c_str(), 10);
    mpfr_set_q(value_, exact, MPFR_RNDN);
    mpq_clear(exact);
  }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  ~Real() { mpfr_clear(value_); }
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

/// |angle of the rotation - the one asked for| in radians, modulo whole turns, by MPFR with 2000 bits: a rotation R by
/// t about the unit vector u has trace 1 + 2 cos t and antisymmetric part 2 sin t u, whose product with the axis is 2
/// sin t |axis|.
double angle_error(const AffineMap& map, const RationalVec3& axis, double angle_degrees) {
  const Rows& m = map.rows();
  const Rational cosine = (m[0].x + m[1].y + m[2].z - 1) / 2;
  const RationalVec3 twice(m[2].y - m[1].z, m[0].z - m[2].x, m[1].x - m[0].y);
  Real c(cosine), s(dot(twice, axis) / 2), length(dot(axis, axis)), wanted, pi;
  mpfr_sqrt(length.get(), length.get(), MPFR_RNDN);
  mpfr_div(s.get(), s.get(), length.get(), MPFR_RNDN);
  mpfr_atan2(s.get(), s.get(), c.get(), MPFR_RNDN);
  mpfr_const_pi(pi.get(), MPFR_RNDN);
  mpfr_set_d(wanted.get(), angle_degrees, MPFR_RNDN);
  mpfr_mul(wanted.get(), wanted.get(), pi.get(), MPFR_RNDN);
  mpfr_div_ui(wanted.get(), wanted.get(), 180, MPFR_RNDN);
  mpfr_sub(s.get(), s.get(), wanted.get(), MPFR_RNDN);
  mpfr_mul_ui(pi.get(), pi.get(), 2, MPFR_RNDN);
  mpfr_remainder(s.get(), s.get(), pi.get(), MPFR_RNDN);
  return std::abs(mpfr_get_d(s.get(), MPFR_RNDN));
}

void expect_true_rotation(const AffineMap& map, const RationalVec3& centre, const RationalVec3& axis) {
  const Rows& m = map.rows();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) ASSERT_EQ(dot(m[i], m[j]), Rational(i == j ? 1 : 0));
  }
  ASSERT_EQ(dot(m[0], cross(m[1], m[2])), Rational(1));
  ASSERT_EQ(map.apply(centre), centre);
  ASSERT_EQ(map.apply(centre + axis), centre + axis);
  ASSERT_EQ(map.orientation(), 1);
}

AffineMap turn(const RationalVec3& axis, double angle) {
  return *AffineMap::rotation({0, 0, 0}, axis, angle);
}

/// Random input of many magnitudes, short numbers and exact lattices among them.
class MapSource {
 public:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  double coordinate() {
    switch (below(8)) {
      case 0:
        return static_cast<double>(below(21)) - 10;
      case 1:
        return (static_cast<double>(below(2001)) - 1000) / 8;
      case 2:
        return std::ldexp(unit(), static_cast<int>(below(200)) - 100);
      case 3:
        return 9 * (static_cast<double>(below(1ULL << 50)) - 0x1p49);
      case 4:
        return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random_()) >> 11), -40);
      default:
        return 100 * unit();
    }
  }
  Vec3 point() { return {coordinate(), coordinate(), coordinate()}; }
  RationalVec3 rational() { return RationalVec3(point()); }
  RationalVec3 direction() {
    RationalVec3 result = rational();
    while (is_zero(result)) result = rational();
    return result;
  }
  Rational fraction() { return {static_cast<std::int64_t>(below(41)) - 20, static_cast<std::int64_t>(below(12)) + 1}; }

  AffineMap map() {
    switch (below(8)) {
      case 0:
        return AffineMap::translation(rational());
      case 1:
        return AffineMap::translation({fraction(), fraction(), fraction()});
      case 2:
        return AffineMap::scaling(rational(), {Rational(coordinate()), fraction(), Rational(0x1p-3)});
      case 3:
        return AffineMap::reflection({direction(), Rational(coordinate())});
      case 4:
        return AffineMap::reflection({{1, 2, 2}, fraction()});
      case 5:
        return *AffineMap::rotation(rational(), {0, 0, 1}, 90.0 * static_cast<double>(below(5)));
      case 6:
        return *AffineMap::rotation(rational(), {0, Rational(coordinate()) + Rational(1, 1000), 1}, 360 * unit());
      default:
        return *AffineMap::rotation(rational(), direction(), 1000 * unit());
    }
  }

 private:
  std::mt19937_64 random_{99};
};

TEST(AffineMap, simple_maps_do_what_their_names_say) {
  const RationalVec3 p(1, 2, 3);
  EXPECT_EQ(AffineMap::translation({Rational(1, 3), 0, -1}).apply(p), RationalVec3(Rational(4, 3), 2, 2));
  EXPECT_EQ(AffineMap::scaling({1, 1, 1}, {2, 3, Rational(1, 2)}).apply(p), RationalVec3(1, 4, 2));
  EXPECT_EQ(AffineMap::reflection({{0, 0, 2}, 8}).apply(p), RationalVec3(1, 2, 5));
  EXPECT_EQ(AffineMap::reflection({{1, 1, 0}, 0}).apply(p), RationalVec3(-2, -1, 3));
  EXPECT_EQ(AffineMap::translation(p).orientation(), 1);
  EXPECT_EQ(AffineMap::reflection({{1, 2, 3}, 4}).orientation(), -1);
  EXPECT_EQ(AffineMap::scaling(p, {-1, -1, -1}).orientation(), -1);
  EXPECT_EQ(AffineMap::scaling(p, {1, 0, 1}).orientation(), 0);
}

TEST(AffineMap, quarter_turns_about_coordinate_axes_are_exact_and_right_handed) {
  const RationalVec3 p(1, 2, 3);
  EXPECT_EQ(turn({0, 0, 1}, 90).apply(p), RationalVec3(-2, 1, 3));
  EXPECT_EQ(turn({0, 0, 5}, 180).apply(p), RationalVec3(-1, -2, 3));
  EXPECT_EQ(turn({0, 0, Rational(1, 7)}, 270).apply(p), RationalVec3(2, -1, 3));
  EXPECT_EQ(turn({1, 0, 0}, 90).apply(p), RationalVec3(1, -3, 2));
  EXPECT_EQ(turn({0, 1, 0}, 90).apply(p), RationalVec3(3, 2, -1));
  EXPECT_EQ(turn({0, 0, -1}, 90).apply(p), RationalVec3(2, -1, 3));
  EXPECT_EQ(turn({0, 0, 1}, -90).apply(p), RationalVec3(2, -1, 3));
  EXPECT_EQ(turn({0, 0, 1}, -270).apply(p), RationalVec3(-2, 1, 3));
  EXPECT_EQ(turn({0, 0, 1}, -180).apply(p), RationalVec3(-1, -2, 3));
  EXPECT_EQ(turn({3, 1, 4}, 360).apply(p), p);
  EXPECT_EQ(turn({3, 1, 4}, -720).apply(p), p);
  EXPECT_EQ(turn({3, 1, 4}, -0.0).apply(p), p);
  EXPECT_EQ(turn({0, 0, 1}, 360e13 + 90).apply(p), RationalVec3(-2, 1, 3));  // the sum is a double
  EXPECT_EQ(AffineMap::rotation({1, 1, 0}, {0, 0, 1}, 90)->apply(RationalVec3(2, 1, 0)), RationalVec3(1, 2, 0));
}

TEST(AffineMap, turns_with_short_rational_matrices_are_exact) {
  EXPECT_EQ(turn({1, 1, 1}, 120).apply(RationalVec3(1, 2, 3)), RationalVec3(3, 1, 2));
  EXPECT_EQ(turn(RationalVec3(Vec3{0.1, 0.1, 0.1}), -120).apply(RationalVec3(1, 2, 3)), RationalVec3(2, 3, 1));
  EXPECT_EQ(turn({1, 1, 0}, 180).apply(RationalVec3(1, 2, 3)), RationalVec3(2, 1, -3));
  EXPECT_EQ(turn({1, 2, 2}, 180).apply(RationalVec3(9, 0, 0)), RationalVec3(-7, 4, 4));
  // A quarter turn about (3, 4, 0): its length is an integer.
  EXPECT_EQ(turn({3, 4, 0}, 90).apply(RationalVec3(0, 0, 5)), RationalVec3(4, -3, 0));
  // A sixth turn about the diagonal: 1/3 (2 -1 2; 2 2 -1; -1 2 2).
  EXPECT_EQ(turn({1, 1, 1}, 60).apply(RationalVec3(3, 0, 0)), RationalVec3(2, 2, -1));
}

TEST(AffineMap, a_zero_axis_gives_no_rotation) {
  EXPECT_FALSE(AffineMap::rotation({1, 2, 3}, {0, 0, 0}, 90));
}

TEST(AffineMap, rotations_are_orthogonal_fix_their_axis_and_turn_by_the_angle) {
  MapSource source;
  double worst = 0;
  for (int round = 0; round < 1'500; ++round) {
    const RationalVec3 centre = source.rational();
    const RationalVec3 axis = source.direction();
    const double angle = round % 3 == 0   ? std::ldexp(source.unit(), static_cast<int>(source.below(1000)) - 500)
                         : round % 3 == 1 ? 180 * source.unit()
                                          : 45 * static_cast<double>(source.below(17)) - 360 + 0x1p-30 * source.unit();
    const auto map = AffineMap::rotation(centre, axis, angle);
    ASSERT_TRUE(map);
    expect_true_rotation(*map, centre, axis);
    const double error = angle_error(*map, axis, std::fmod(angle, 360));
    ASSERT_LT(error, 0x1p-50) << angle;
    worst = std::max(worst, error);
  }
  EXPECT_GT(worst, 0x1p-60) << "the oracle sees an error at all";
}

TEST(AffineMap, tiny_angles_and_angles_next_to_a_half_turn_are_kept) {
  for (const double angle : {5e-324, -1e-300, 1e-20, 180 - 0x1p-45, std::nextafter(180.0, 0.0), -180 + 0x1p-45}) {
    const AffineMap map = turn({1, 2, 3}, angle);
    const Rows& m = map.rows();
    expect_true_rotation(map, {0, 0, 0}, {1, 2, 3});
    EXPECT_LT(angle_error(map, {1, 2, 3}, angle), 0x1p-50) << angle;
    EXPECT_EQ((m[1].x - m[0].y).sign(), angle > 0 ? 1 : -1) << angle;  // the sign of the sine
  }
}

TEST(AffineMap, axes_of_extreme_length_turn_like_short_ones) {
  const AffineMap expected = turn({1, 2, 0}, 30);
  for (const RationalVec3& axis : {RationalVec3(Vec3{0x1p1000, 0x1p1001, 0}), RationalVec3(Vec3{5e-324, 1e-323, 0})}) {
    EXPECT_EQ(turn(axis, 30).rows(), expected.rows());
  }
  const RationalVec3 skew(Vec3{1e300, 1e-300, 5e-324});
  const AffineMap map = turn(skew, 77);
  expect_true_rotation(map, {0, 0, 0}, skew);
}

TEST(AffineMap, entries_of_a_rotation_stay_short) {
  const AffineMap map = turn({0, 0, 1}, 33.3);
  for (const RationalVec3& row : map.rows()) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_TRUE(row[j].is_small()) << row[j].text();
  }
}

TEST(AffineMap, simplest_fraction_is_the_first_in_order_of_denominators) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 3'000; ++round) {
    const Rational low(static_cast<std::int64_t>(random() % 500) + 1, static_cast<std::int64_t>(random() % 200) + 1);
    const Rational high =
        low + Rational(static_cast<std::int64_t>(random() % 3), static_cast<std::int64_t>(random() % 300) + 1);
    std::string expected;
    for (std::int64_t q = 1; expected.empty(); ++q) {
      const auto first = static_cast<std::int64_t>(std::ceil((low * q).lower_double() - 1e-9));
      for (std::int64_t p = std::max<std::int64_t>(1, first); Rational(p, q) <= high; ++p) {
        if (Rational(p, q) >= low) {
          expected = Rational(p, q).text();
          break;
        }
      }
    }
    ASSERT_EQ(simplest_between(low, high).text(), expected) << low.text() << " " << high.text();
  }
}

TEST(AffineMap, circle_points_are_rounded_once_and_exact_at_quarters) {
  for (const std::uint32_t count : {4U, 8U, 400U}) {
    EXPECT_EQ(circle_point(count / 4, count).cosine, 0);
    EXPECT_EQ(circle_point(count / 4, count).sine, 1);
    EXPECT_EQ(circle_point(count / 2, count).cosine, -1);
    EXPECT_FALSE(std::signbit(circle_point(count / 2, count).sine));
    EXPECT_EQ(circle_point(3 * (count / 4), count).sine, -1);
  }
  EXPECT_EQ(circle_point(1, 6).cosine, 0.5);
  Real angle, value;
  for (std::uint32_t index = 0; index < 1000; ++index) {
    mpfr_const_pi(angle.get(), MPFR_RNDN);
    mpfr_mul_ui(angle.get(), angle.get(), 2UL * index, MPFR_RNDN);
    mpfr_div_ui(angle.get(), angle.get(), 997, MPFR_RNDN);
    mpfr_cos(value.get(), angle.get(), MPFR_RNDN);
    ASSERT_EQ(circle_point(index, 997).cosine, mpfr_get_d(value.get(), MPFR_RNDN));
    if (index % 997 == 0) continue;
    mpfr_sin(value.get(), angle.get(), MPFR_RNDN);
    ASSERT_EQ(circle_point(index, 997).sine, mpfr_get_d(value.get(), MPFR_RNDN));
  }
}

/// Nearest double by MPFR, infinity beyond the range; the numbers of these tests are not subnormals unless `exact`.
double rounded_by_mpfr(const Rational& exact) {
  Real number(exact);
  return mpfr_get_d(number.get(), MPFR_RNDN);
}

void expect_image_rounded(const AffineMap& map, const Vec3& point) {
  const RationalVec3 image = map.apply(RationalVec3(point));
  const Vec3 rounded = map.apply_rounded(point);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(rounded[axis], image[axis].nearest_double()) << point.x << " " << point.y << " " << point.z;
    ASSERT_FALSE(rounded[axis] == 0 && std::signbit(rounded[axis]));
  }
  if (!is_finite(rounded)) return;
  ASSERT_EQ(map.image_is_double(point, rounded), image == RationalVec3(rounded));
  Vec3 other = rounded;
  other.y = std::nextafter(other.y, 1e308);
  ASSERT_FALSE(map.image_is_double(point, other));
}

TEST(AffineMap, apply_rounded_is_the_exact_image_rounded_and_rarely_needs_rationals) {
  MapSource source;
  std::uint64_t fallbacks = 0;
  std::uint64_t images = 0;
  for (int round = 0; round < 2'000; ++round) {
    const AffineMap map = source.map();
    for (int i = 0; i < 50; ++i, ++images) {
      const Vec3 point = source.point();
      reset_exact_counters();
      static_cast<void>(map.apply_rounded(point));
      fallbacks += exact_counters().big_fallbacks;
      expect_image_rounded(map, point);
    }
  }
  // The source is full of ties that no finite precision decides: multiples of a ninth, sums of far magnitudes.
  RecordProperty("coordinates_rounded_by_rationals", static_cast<int>(fallbacks));
  EXPECT_LT(fallbacks, 3 * images / 500);
}

TEST(AffineMap, the_rounding_agrees_with_mpfr) {
  MapSource source;
  for (int round = 0; round < 300; ++round) {
    const AffineMap map = source.map();
    for (int i = 0; i < 5; ++i) {
      const Vec3 point = source.point();
      const RationalVec3 image = map.apply(RationalVec3(point));
      const Vec3 rounded = map.apply_rounded(point);
      for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(rounded[axis], rounded_by_mpfr(image[axis]));
    }
  }
}

TEST(AffineMap, lossless_maps_never_need_rationals) {
  MapSource source;
  const std::vector<AffineMap> maps = {
      AffineMap::translation(RationalVec3(Vec3{0.1, 1e10, -3})),
      AffineMap::scaling({1, Rational(1, 2), -7}, {2, Rational(1, 4), 1024}),
      AffineMap::reflection({{1, 0, 0}, Rational(0.3)}),
      AffineMap::reflection({{1, -1, 0}, 0}),
      *AffineMap::rotation({Rational(1, 2), Rational(1, 4), 0}, {0, 0, 1}, 90),
      AffineMap::scaling({0, 0, 0}, {Rational(0.1), Rational(0.7), Rational(1e10)}),
  };
  reset_exact_counters();
  for (const AffineMap& map : maps) {
    for (int i = 0; i < 2'000; ++i) static_cast<void>(map.apply_rounded(source.point()));
  }
  EXPECT_EQ(exact_counters().big_fallbacks, 0U);
  EXPECT_EQ(exact_counters().heap_rationals, 0U);
}

TEST(AffineMap, general_rotations_of_general_points_need_no_rationals) {
  MapSource source;
  const auto coordinate = [&] { return 1000 * source.unit(); };
  std::vector<AffineMap> maps;
  for (int i = 0; i < 50; ++i) {
    const auto centre = RationalVec3(Vec3{coordinate(), coordinate(), coordinate()});
    maps.push_back(*AffineMap::rotation(centre, source.direction(), 180 * source.unit()));
  }
  reset_exact_counters();
  for (int i = 0; i < 100'000; ++i) {
    static_cast<void>(
        maps[static_cast<std::size_t>(i) % 50].apply_rounded(Vec3{coordinate(), coordinate(), coordinate()}));
  }
  EXPECT_EQ(exact_counters().big_fallbacks, 0U);
}

TEST(AffineMap, ties_go_to_even) {
  const AffineMap by_doubles = AffineMap::translation(RationalVec3(Vec3{0x1p-53, 0x1p-53, -0x1p-54}));
  EXPECT_EQ(by_doubles.apply_rounded(Vec3{1, 1 + 0x1p-52, 1}), (Vec3{1, 1 + 0x1p-51, 1}));
  // 9 times a ninth: the entries are not doubles, so the filter cannot see that the image is a tie.
  const AffineMap ninths = AffineMap::scaling({0, 0, 0}, {Rational(1, 9), Rational(1, 9), Rational(1, 9)});
  const AffineMap map = ninths.then(by_doubles);
  reset_exact_counters();
  EXPECT_EQ(map.apply_rounded(Vec3{9, 9 * (1 + 0x1p-48), 9}), (Vec3{1, 1 + 0x1p-48, 1}));
  EXPECT_EQ(exact_counters().big_fallbacks, 3U);
}

TEST(AffineMap, extreme_magnitudes_are_right) {
  MapSource source;
  const std::vector<double> extremes = {1e300,  -1e300,   1e-300,  5e-324,  -2.5e-310, 1.7976931348623157e308,
                                        1e-160, 0x1p-200, 0x1p300, 0x1p301, -1.0,      0.0};
  const std::vector<AffineMap> maps = {
      turn({1, 2, 3}, 33),
      *AffineMap::rotation(RationalVec3(Vec3{1e300, 1, 1e-300}), {0, 0, 1}, 45),
      AffineMap::translation(RationalVec3(Vec3{1e-300, 1e300, 5e-324})),
      AffineMap::translation({Rational(1, 3) * Rational(5e-324), Rational(1e308), Rational(1, 3)}),
      AffineMap::scaling({0, 0, 0}, {Rational(1e-200), Rational(1e200), Rational(1, 3) * Rational(1e-150)}),
      AffineMap::scaling({0, 0, 0}, {Rational(1) + Rational(0x1p-600), Rational(1) + Rational(0x1p-70), 1}),
      AffineMap::reflection({RationalVec3(Vec3{1e300, 1e-300, 5e-324}), 1}),
      AffineMap::scaling({0, 0, 0}, {0, Rational(1e308) * Rational(1e308), 1}),
  };
  for (const AffineMap& map : maps) {
    for (int i = 0; i < 300; ++i) {
      const auto pick = [&] {
        return source.below(3) == 0 ? source.coordinate() : extremes[source.below(extremes.size())];
      };
      expect_image_rounded(map, {pick(), pick(), pick()});
    }
  }
}

TEST(AffineMap, points_that_are_no_doubles_are_mapped_exactly) {
  const ExactPoint third(RationalVec3(Rational(1, 3), 1, 2));
  const auto moved = AffineMap::scaling({0, 0, 0}, {3, 1, 1}).apply(third);
  ASSERT_TRUE(moved);
  EXPECT_TRUE(moved->is_double());
  EXPECT_EQ(moved->approx(), (Vec3{1, 1, 2}));
  const auto shifted = AffineMap::translation({1, 0, 0}).apply(third);
  ASSERT_TRUE(shifted);
  EXPECT_EQ(shifted->rational(), RationalVec3(Rational(4, 3), 1, 2));
  EXPECT_EQ(AffineMap::translation({1, 0, 0}).apply_rounded(third), (Vec3{4.0 / 3, 1, 2}));
  EXPECT_FALSE(AffineMap::scaling({0, 0, 0}, {1, 1, Rational(1e300)}).apply(ExactPoint(Vec3{1, 1, 1e10})));
}

TEST(AffineMap, composition_and_image_of_planes_agree_with_images_of_points) {
  MapSource source;
  for (int round = 0; round < 500; ++round) {
    const AffineMap first = source.map();
    const AffineMap second = source.map();
    const AffineMap both = first.then(second);
    const RationalVec3 p = source.rational();
    ASSERT_EQ(both.apply(p), second.apply(first.apply(p)));
    ASSERT_EQ(both.orientation(), first.orientation() * second.orientation());
    if (first.orientation() == 0) continue;
    const ExactPlane plane{source.direction(), source.fraction()};
    const ExactPlane image = first.apply(plane);
    ASSERT_EQ(image.evaluate(first.apply(p)).sign(), plane.evaluate(p).sign());
    const RationalVec3 foot = p - (plane.evaluate(p) / dot(plane.normal, plane.normal)) * plane.normal;
    ASSERT_EQ(image.evaluate(first.apply(foot)), Rational(0));
  }
}

TEST(affine_map, dyadic_matrices_are_those_of_translations_dyadic_scales_and_turns_of_the_axes) {
  const RationalVec3 centre(Rational(1, 3), 2, -5);
  const auto turn = [&](const RationalVec3& axis, double degrees) {
    return AffineMap::rotation(centre, axis, degrees)->has_dyadic_matrix();
  };
  const auto mirror = [&](const RationalVec3& normal) {
    return AffineMap::reflection(*ExactPlane::through(centre, normal)).has_dyadic_matrix();
  };
  EXPECT_TRUE(AffineMap::translation(RationalVec3(Rational(1, 3), 0, 0)).has_dyadic_matrix());
  EXPECT_TRUE(AffineMap::scaling(centre, RationalVec3(Vec3{0.1, -2, 1e-300})).has_dyadic_matrix());
  EXPECT_FALSE(AffineMap::scaling(centre, RationalVec3(1, 1, Rational(1, 3))).has_dyadic_matrix());
  for (const double degrees : {90.0, -90.0, 180.0, 270.0, 360.0, 450.0}) EXPECT_TRUE(turn({0, -7, 0}, degrees));
  EXPECT_TRUE(turn({1, 1, 0}, 180));
  EXPECT_FALSE(turn({1, 1, 1}, 180));
  EXPECT_FALSE(turn({1, 2, 0}, 180));
  EXPECT_FALSE(turn({0, 0, 1}, 45));
  EXPECT_FALSE(turn({0, 0, 1}, 37));
  EXPECT_FALSE(turn({1, 1, 0}, 90));
  EXPECT_TRUE(mirror({0, 0, 4}) && mirror({0, -3, 3}) && mirror({1, 0, 1}));
  EXPECT_FALSE(mirror({1, 1, 1}) || mirror({1, 2, 0}) || mirror({0, 3, 4}));
}

TEST(affine_map, least_stretch_is_a_bound_on_how_near_images_come) {
  MapSource source;
  for (int round = 0; round < 500; ++round) {
    const AffineMap map = source.map();
    const Rational stretch(map.least_stretch());
    EXPECT_EQ(stretch.sign() > 0, map.orientation() != 0);
    const RationalVec3 from = source.rational(), to = source.rational();
    const RationalVec3 before = to - from, after = map.apply(to) - map.apply(from);
    EXPECT_GE(dot(after, after), stretch * stretch * dot(before, before));
  }
  const auto turn = AffineMap::rotation({1, 2, 3}, {1, 2, 3}, 37);
  EXPECT_GT(turn->least_stretch(), 0.57);  // 1 over the root of 3
  EXPECT_EQ(AffineMap::scaling({}, RationalVec3(Vec3{1e300, 1e300, 1e300})).least_stretch(), 0);
}

}  // namespace
}  // namespace algebra3d
