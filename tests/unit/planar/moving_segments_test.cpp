// Moving segments against sampling: what is asked at a single time is decided by another method, by solving for the
// common point with rationals.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/planar/detail/moving_segments.h"
#include "support/rounds.h"

namespace algebra3d::moving_segments_tests {
namespace {

struct FlatPoint {
  Rational x, y;
  friend bool operator==(const FlatPoint&, const FlatPoint&) = default;
};
FlatPoint operator-(const FlatPoint& a, const FlatPoint& b) {
  return {a.x - b.x, a.y - b.y};
}
Rational determinant(const FlatPoint& a, const FlatPoint& b) {
  return a.x * b.y - a.y * b.x;
}

MovingPoint moving(double x1, double y1, double x2, double y2) {
  return {Vec3{x1, y1, 0}, Vec3{x2, y2, 0}};
}
FlatPoint position(const MovingPoint& point, const Rational& s) {
  const auto coordinate = [&](std::size_t axis) {
    const Rational start = point.start.coordinate(axis);
    return start + (point.end.coordinate(axis) - start) * s;
  };
  return {coordinate(0), coordinate(1)};
}

// The common points are p + t (q - p) for t in [low, high].
SegmentIntersection intersection_at(const MovingSegment& ab, const MovingSegment& cd, const Rational& s) {
  const FlatPoint p = position(ab.from, s);
  const FlatPoint u = position(ab.to, s) - p;
  const FlatPoint q = position(cd.from, s);
  const FlatPoint v = position(cd.to, s) - q;
  const Rational turn = determinant(u, v);
  if (turn.sign() != 0) {
    const Rational t = determinant(q - p, v) / turn;
    const Rational w = determinant(q - p, u) / turn;
    if (t < 0 || t > 1 || w < 0 || w > 1) return SegmentIntersection::none;
    return t > 0 && t < 1 && w > 0 && w < 1 ? SegmentIntersection::crossing : SegmentIntersection::touching;
  }
  if (determinant(q - p, u).sign() != 0) return SegmentIntersection::none;
  const auto parameter = [&](const FlatPoint& r) { return u.x.sign() != 0 ? (r - p).x / u.x : (r - p).y / u.y; };
  const Rational first = parameter(q);
  const Rational second = parameter(position(cd.to, s));
  const Rational low = std::max<Rational>(0, std::min(first, second));
  const Rational high = std::min<Rational>(1, std::max(first, second));
  return low > high    ? SegmentIntersection::none
         : low == high ? SegmentIntersection::touching
                       : SegmentIntersection::overlap;
}

bool vanishes_at(const MovingSegment& segment, const Rational& s) {
  return position(segment.from, s) == position(segment.to, s);
}

bool is_forbidden(SegmentIntersection intersection, bool may_touch) {
  return intersection != SegmentIntersection::none && (intersection != SegmentIntersection::touching || !may_touch);
}

MovingSegment segment(const std::array<double, 8>& c) {
  return {moving(c[0], c[1], c[2], c[3]), moving(c[4], c[5], c[6], c[7])};
}

double distance_at(const MovingSegment& ab, const MovingSegment& cd, double s) {
  const auto place = [&](const MovingPoint& p) { return (1 - s) * p.start.approx + s * p.end.approx; };
  const auto to_segment = [](const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
    const Vec3 off = p - (a + t * d);
    return std::sqrt(dot(off, off));
  };
  const Vec3 a = place(ab.from), b = place(ab.to), c = place(cd.from), d = place(cd.to);
  return std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
}

constexpr int kSamples = 60;

void expect_right(const MovingSegment& ab, const MovingSegment& cd, bool may_touch) {
  const auto clash = first_clash(ab, cd, may_touch);
  const double s = clash ? clash->moment.s.approx() : 1;
  for (int i = 1; i < kSamples; ++i) {
    const double time = static_cast<double>(i) / kSamples;
    if (time > s - 1e-9) break;
    ASSERT_FALSE(is_forbidden(intersection_at(ab, cd, Rational(i, kSamples)), may_touch)) << time << " before " << s;
  }
  if (!clash) {
    return;
  }
  EXPECT_FALSE(surely_apart(ab, cd));
  if (clash->moment.is_right_after) {
    // Some time, short enough, in which nothing changes.
    EXPECT_TRUE(is_forbidden(intersection_at(ab, cd, Rational(s + 1e-9)), may_touch)) << s;
  } else {
    EXPECT_LT(distance_at(ab, cd, s), 1e-9);
    EXPECT_GT(s, 0);
    EXPECT_LT(s, 1);
  }
}

TEST(moving_segments, random_ones_meet_when_samples_say_so) {
  std::mt19937 random(5);
  int clashes = 0, apart = 0, for_an_instant = 0, overlaps = 0;
  for (int i = 0; i < rounds(5000); ++i) {
    const int range = 2 + i % 5;
    const auto any = [&] { return static_cast<double>(static_cast<int>(random() % (2 * range + 1)) - range); };
    const MovingSegment ab = segment({any(), any(), any(), any(), any(), any(), any(), any()});
    const MovingSegment cd = segment({any(), any(), any(), any(), any(), any(), any(), any()});
    if (vanishing(ab) || vanishing(cd)) continue;
    expect_right(ab, cd, false);
    expect_right(ab, cd, true);
    if (HasFatalFailure()) return;
    const auto clash = first_clash(ab, cd, false);
    (clash ? clashes : apart) += 1;
    for_an_instant += clash && !clash->moment.is_right_after ? 1 : 0;
    overlaps += clash && clash->intersection == SegmentIntersection::overlap ? 1 : 0;
    EXPECT_FALSE(clash && surely_apart(ab, cd));
  }
  EXPECT_GT(clashes, rounds(250));
  EXPECT_GT(apart, rounds(250));
  EXPECT_GT(for_an_instant, rounds(125));
  EXPECT_GT(overlaps, rounds(2));
}

TEST(moving_segments, vanish_when_samples_say_so) {
  std::mt19937 random(6);
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto any = [&] { return static_cast<double>(random() % 5); };
    const MovingSegment ab = segment({any(), any(), any(), any(), any(), any(), any(), any()});
    const auto moment = vanishing(ab);
    found += moment ? 1 : 0;
    // With such small numbers it can only be at a fraction of small terms.
    for (int q = 2; q <= 8; ++q)
      for (int p = 1; p < q; ++p) {
        EXPECT_TRUE(moment || !vanishes_at(ab, Rational(p, q)));
      }
    if (moment && !moment->is_right_after) {
      EXPECT_TRUE(vanishes_at(ab, moment->s.whole));
    }
  }
  EXPECT_GT(found, 100);
}

std::optional<double> clash_time(const std::array<double, 8>& ab, const std::array<double, 8>& cd, bool may_touch) {
  const auto clash = first_clash(segment(ab), segment(cd), may_touch);
  return clash ? std::optional(clash->moment.s.approx()) : std::nullopt;
}

TEST(moving_segments, a_corner_that_bounces_off_a_segment_touches_it) {
  // b = (2 4s - 2) and c = (1 + 2s, 4s - 2): orient(a, b, c) = 2 (4s - 2) - (4s - 2)(1 + 2s) = -2 (2s - 1)^2.
  const std::array<double, 8> ab{0, 0, 0, 0, 2, -2, 2, 2};
  const std::array<double, 8> cd{1, -2, 3, 2, 1, -9, 3, -9};
  EXPECT_EQ(clash_time(ab, cd, false), 0.5);
  EXPECT_EQ(clash_time(ab, cd, true), std::nullopt);
}

TEST(moving_segments, meet_at_an_irrational_time) {
  // a = (0 0), b = (4 4s), c = (2s 1): orient(a, b, c) = 4 (1 - 2 s^2). With b = (1 s) the segment is too short.
  const std::array<double, 8> ab{0, 0, 0, 0, 1, 0, 1, 1};
  const std::array<double, 8> longer{0, 0, 0, 0, 4, 0, 4, 4};
  const std::array<double, 8> cd{0, 1, 2, 1, 0, 9, 2, 9};
  EXPECT_EQ(clash_time(ab, cd, false), std::nullopt);
  ASSERT_TRUE(clash_time(longer, cd, false));
  EXPECT_NEAR(*clash_time(longer, cd, false), std::sqrt(0.5), 1e-12);
  const auto clash = first_clash(segment(longer), segment(cd), false);
  EXPECT_EQ(clash->moment.s.radicand.sign(), 1);
  EXPECT_EQ(clash->intersection, SegmentIntersection::touching);
  EXPECT_TRUE(first_clash(segment(longer), segment(cd), true)->moment.is_right_after);
}

TEST(moving_segments, overlap_at_an_irrational_instant_alone) {
  // Both lie on one line only when both c and d pass it, at s = sqrt(2)/2: ab from (0 0) to (4 4s), c = (2s 1) as
  // above, d = c + (2 2s) is then on the same line, for it has the direction of ab throughout.
  const std::array<double, 8> ab{0, 0, 0, 0, 4, 0, 4, 4};
  const std::array<double, 8> cd{0, 1, 2, 1, 2, 1, 4, 3};
  const auto clash = first_clash(segment(ab), segment(cd), true);
  ASSERT_TRUE(clash.has_value());
  EXPECT_EQ(clash->intersection, SegmentIntersection::overlap);
  EXPECT_FALSE(clash->moment.is_right_after);
  EXPECT_NEAR(clash->moment.s.approx(), std::sqrt(0.5), 1e-12);
  // Beyond the end of ab: nothing in common.
  const std::array<double, 8> beyond{10, 1, 12, 1, 12, 1, 14, 3};
  EXPECT_EQ(clash_time(ab, beyond, false), std::nullopt);
}

TEST(moving_segments, that_slide_on_one_line_meet_at_their_ends_or_overlap) {
  const std::array<double, 8> ab{0, 0, 0, 0, 2, 1, 2, 1};
  const std::array<double, 8> passing{4, 2, 1, 0.5, 6, 3, 3, 1.5};  // c reaches b at s = 2/3
  EXPECT_NEAR(clash_time(ab, passing, false).value(), 2.0 / 3, 1e-15);
  EXPECT_NEAR(clash_time(ab, passing, true).value(), 2.0 / 3, 1e-15);
  EXPECT_TRUE(first_clash(segment(ab), segment(passing), true)->moment.is_right_after);
  const std::array<double, 8> arriving{4, 2, 2, 1, 6, 3, 4, 2};  // c reaches b at s = 1
  EXPECT_EQ(clash_time(ab, arriving, false), std::nullopt);
  const std::array<double, 8> following{2, 1, 4, 2, 4, 2, 6, 3};  // c leaves b at s = 0
  EXPECT_EQ(clash_time(ab, following, false), std::nullopt);
  const std::array<double, 8> attached{2, 1, 2, 1, 4, 2, 6, 3};
  EXPECT_EQ(clash_time(ab, attached, false), 0);
  EXPECT_EQ(clash_time(ab, attached, true), std::nullopt);
}

TEST(moving_segments, that_turn_as_one_stay_collinear) {
  // Both turn about (0 0), on one line at all times; apart.
  const std::array<double, 8> ab{1, 0, 0, 1, 2, 0, 0, 2};
  const std::array<double, 8> cd{3, 0, 0, 3, 4, 0, 0, 4};
  EXPECT_EQ(clash_time(ab, cd, false), std::nullopt);
  const std::array<double, 8> overlapping{1.5, 0, 0, 1.5, 4, 0, 0, 4};
  EXPECT_EQ(clash_time(ab, overlapping, true), 0);
}

std::optional<double> fold_time(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b) {
  const auto moment = first_fold(a, corner, b);
  EXPECT_FALSE(moment && surely_unfolded(a, corner, b));
  return moment ? std::optional(moment->s.approx()) : std::nullopt;
}

TEST(moving_segments, neighbours_fold_or_stretch) {
  const MovingPoint corner = moving(0, 0, 0, 0);
  const MovingPoint a = moving(1, 0, 1, 0);
  EXPECT_EQ(fold_time(a, corner, moving(2, 1, 2, -1)), 0.5);
  EXPECT_EQ(fold_time(a, corner, moving(-2, 1, -2, -1)), std::nullopt);  // straight for an instant
  EXPECT_EQ(fold_time(a, corner, moving(-2, 0, -3, 0)), std::nullopt);   // straight throughout
  EXPECT_EQ(fold_time(a, corner, moving(2, 0, 3, 0)), 0);                // folded throughout
  EXPECT_EQ(fold_time(a, corner, moving(2, 1, 2, 0)), std::nullopt);     // folds at the end
  EXPECT_EQ(fold_time(a, corner, moving(2, 0, 2, 1)), std::nullopt);     // unfolds from the beginning
  EXPECT_EQ(fold_time(a, corner, moving(-1, 0, 3, 0)), 0.25);            // through the corner: vanishes there
  EXPECT_EQ(fold_time(moving(1, 0, 1, 0), corner, moving(1, 1, 1, 1)), std::nullopt);
}

TEST(quadratic, signs_at_roots_are_exact) {
  std::mt19937 random(8);
  int irrational = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto any = [&] { return Rational(static_cast<int>(random() % 41) - 20); };
    const Quadratic p{any(), any(), any()};
    const Quadratic q{any(), any(), any()};
    std::vector<Surd> roots;
    p.append_roots(roots);
    for (const Surd& root : roots) {
      irrational += root.radicand.sign() != 0 ? 1 : 0;
      EXPECT_EQ(p.sign_at({root}), 0);
      EXPECT_GT(root.approx(), 0);
      EXPECT_LT(root.approx(), 1);
      const double s = root.approx();
      const double value = (q.a.nearest_double() * s + q.b.nearest_double()) * s + q.c.nearest_double();
      // Two polynomials of such small numbers are equal at a common root, or differ by more than this.
      EXPECT_EQ(q.sign_at({root}), std::abs(value) < 1e-9 ? 0 : value > 0 ? 1 : -1);
      // Right after the root p has the sign that it has between the root and whatever is next.
      const Rational later(s + 1e-6);
      EXPECT_EQ(p.sign_at({root, true}), ((p.a * later + p.b) * later + p.c).sign());
    }
  }
  EXPECT_GT(irrational, 500);
}

}  // namespace
}  // namespace algebra3d::moving_segments_tests
