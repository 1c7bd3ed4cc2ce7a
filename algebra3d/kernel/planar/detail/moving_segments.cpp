#include "algebra3d/kernel/planar/detail/moving_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace algebra3d {
namespace {

/// A linear function of time: `start` at s = 0, `start + change` at s = 1.
struct Linear {
  Rational start, change;
};

Linear operator-(const Linear& p, const Linear& q) {
  return {p.start - q.start, p.change - q.change};
}

Quadratic operator*(const Linear& p, const Linear& q) {
  return {p.change * q.change, p.start * q.change + p.change * q.start, p.start * q.start};
}

bool is_within_unit(const Surd& s) {
  return s.sign() > 0 && Surd{s.whole - 1, s.factor, s.radicand}.sign() < 0;
}

void append_if_within_unit(Surd root, std::vector<Surd>& roots) {
  if (is_within_unit(root)) roots.push_back(std::move(root));
}

struct MovingVector {
  Linear x, y;
};

Linear moving_coordinate(const MovingPoint& point, std::size_t axis) {
  const Rational start = point.start.coordinate(axis);
  return {start, point.end.coordinate(axis) - start};
}

MovingVector moving_position(const MovingPoint& point) {
  return {moving_coordinate(point, 0), moving_coordinate(point, 1)};
}

MovingVector operator-(const MovingVector& a, const MovingVector& b) {
  return {a.x - b.x, a.y - b.y};
}

Quadratic cross(const MovingVector& a, const MovingVector& b) {
  return a.x * b.y - a.y * b.x;
}

Quadratic dot(const MovingVector& a, const MovingVector& b) {
  return a.x * b.x + a.y * b.y;
}

template <std::size_t n>
bool all_zero(const std::array<Quadratic, n>& polynomials) {
  return std::ranges::all_of(polynomials, &Quadratic::is_zero);
}

/// The moments at which signs of the polynomials can change, by time, and before them that right after the beginning:
/// right after one of these moments begins every span of time in which no sign changes.
template <std::size_t n>
std::vector<Surd> moments_of_change(const std::array<Quadratic, n>& polynomials) {
  std::vector<Surd> moments;
  for (const Quadratic& polynomial : polynomials) polynomial.append_roots(moments);
  // Only the message depends on the order, so roots that are close may change places.
  std::ranges::sort(moments, {}, &Surd::approx);
  return moments;
}

/// Two moving segments ab and cd, and the determinants that decide how they lie.
class SegmentPair {
 public:
  SegmentPair(const MovingSegment& ab, const MovingSegment& cd)
      : a_(moving_position(ab.from)),
        b_(moving_position(ab.to)),
        c_(moving_position(cd.from)),
        d_(moving_position(cd.to)),
        sides_{cross(b_ - a_, c_ - a_), cross(b_ - a_, d_ - a_), cross(d_ - c_, a_ - c_), cross(d_ - c_, b_ - c_)} {}

  std::vector<Surd> moments() {
    if (!all_zero(sides_)) return moments_of_change(sides_);
    make_places();
    return moments_of_change(places_);
  }

  SegmentIntersection intersection_at(const Moment& moment) {
    std::array<int, 4> side{};
    for (std::size_t i = 0; i < 4; ++i) side[i] = sides_[i].sign_at(moment);
    if (std::ranges::all_of(side, [](int sign) { return sign == 0; })) return intersection_on_line(moment);
    const int of_cd = side[0] * side[1];
    const int of_ab = side[2] * side[3];
    if (of_cd > 0 || of_ab > 0) return SegmentIntersection::none;
    return of_cd < 0 && of_ab < 0 ? SegmentIntersection::crossing : SegmentIntersection::touching;
  }

 private:
  /// Where c and d lie on the line through a and b, seen from a and from b; positive: on the side of b.
  void make_places() {
    if (has_places_) return;
    has_places_ = true;
    const MovingVector ab = b_ - a_;
    places_ = {dot(c_ - a_, ab), dot(d_ - a_, ab), dot(c_ - b_, ab), dot(d_ - b_, ab)};
  }
  SegmentIntersection intersection_on_line(const Moment& moment) {
    make_places();
    std::array<int, 4> place{};
    for (std::size_t i = 0; i < 4; ++i) place[i] = places_[i].sign_at(moment);
    if ((place[0] < 0 && place[1] < 0) || (place[2] > 0 && place[3] > 0)) return SegmentIntersection::none;
    if ((place[0] <= 0 && place[1] <= 0) || (place[2] >= 0 && place[3] >= 0)) return SegmentIntersection::touching;
    return SegmentIntersection::overlap;
  }

  MovingVector a_, b_, c_, d_;
  std::array<Quadratic, 4> sides_;  // of c and d by ab, of a and b by cd
  std::array<Quadratic, 4> places_;
  bool has_places_ = false;
};

bool is_forbidden(SegmentIntersection intersection, bool may_touch) {
  return intersection == SegmentIntersection::crossing || intersection == SegmentIntersection::overlap ||
         (intersection == SegmentIntersection::touching && !may_touch);
}

}  // namespace

int Surd::sign() const {
  const int of_whole = whole.sign();
  const int of_root = radicand.sign() == 0 ? 0 : factor.sign();
  if (of_root == 0 || of_whole == of_root) return of_whole;
  if (of_whole == 0) return of_root;
  // Two terms of different signs: the one with the larger square decides.
  const auto order = whole * whole <=> factor * factor * radicand;
  return order > 0 ? of_whole : order < 0 ? of_root : 0;
}

double Surd::approx() const {
  return whole.nearest_double() + factor.nearest_double() * std::sqrt(radicand.nearest_double());
}

Surd Quadratic::at(const Surd& s) const {
  if (s.factor.sign() == 0 || s.radicand.sign() == 0) return {(a * s.whole + b) * s.whole + c};
  return {a * (s.whole * s.whole + s.factor * s.factor * s.radicand) + b * s.whole + c,
          (2 * a * s.whole + b) * s.factor, s.radicand};
}

int Quadratic::sign_at(const Moment& moment) const {
  const int sign = at(moment.s).sign();
  if (sign != 0 || !moment.is_right_after) return sign;
  const int slope = Quadratic{0, 2 * a, b}.at(moment.s).sign();
  return slope != 0 ? slope : a.sign();
}

void Quadratic::append_roots(std::vector<Surd>& roots) const {
  if (a.sign() == 0) {
    if (b.sign() != 0) append_if_within_unit({-c / b}, roots);
    return;
  }
  const Rational discriminant = b * b - 4 * a * c;
  if (discriminant.sign() < 0) return;
  const Rational half = 1 / (2 * a);
  if (discriminant.sign() == 0) return append_if_within_unit({-b * half}, roots);
  append_if_within_unit({-b * half, half, discriminant}, roots);
  append_if_within_unit({-b * half, -half, discriminant}, roots);
}

Quadratic operator+(const Quadratic& p, const Quadratic& q) {
  return {p.a + q.a, p.b + q.b, p.c + q.c};
}

Quadratic operator-(const Quadratic& p, const Quadratic& q) {
  return {p.a - q.a, p.b - q.b, p.c - q.c};
}

std::optional<Moment> vanishing(const MovingSegment& segment) {
  const MovingVector vector = moving_position(segment.to) - moving_position(segment.from);
  const auto is_at_rest = [](const Linear& number) { return number.change.sign() == 0; };
  const Linear& moving = is_at_rest(vector.x) ? vector.y : vector.x;
  if (is_at_rest(moving)) {
    const bool is_point = vector.x.start.sign() == 0 && vector.y.start.sign() == 0;
    return is_point ? std::optional(Moment{{0}, true}) : std::nullopt;
  }
  const Rational s = -moving.start / moving.change;
  const bool is_point =
      (vector.x.start + s * vector.x.change).sign() == 0 && (vector.y.start + s * vector.y.change).sign() == 0;
  return is_point && s > 0 && s < 1 ? std::optional(Moment{{s}}) : std::nullopt;
}

std::optional<SegmentClash> first_clash(const MovingSegment& ab, const MovingSegment& cd, bool may_touch) {
  SegmentPair pair(ab, cd);
  const auto clash_at = [&](const Moment& moment) -> std::optional<SegmentClash> {
    const SegmentIntersection intersection = pair.intersection_at(moment);
    return is_forbidden(intersection, may_touch) ? std::optional(SegmentClash{intersection, moment}) : std::nullopt;
  };
  const std::vector<Surd> moments = pair.moments();
  if (auto clash = clash_at({{0}, true})) return clash;
  for (const Surd& s : moments) {
    if (auto clash = clash_at({s, false})) return clash;
    if (auto clash = clash_at({s, true})) return clash;
  }
  return std::nullopt;
}

std::optional<Moment> first_fold(const MovingPoint& a, const MovingPoint& corner, const MovingPoint& b) {
  const MovingVector to_a = moving_position(a) - moving_position(corner);
  const MovingVector to_b = moving_position(b) - moving_position(corner);
  const std::array turn = {cross(to_a, to_b)};
  const std::array direction = {dot(to_a, to_b)};
  const bool is_straight = turn[0].is_zero();
  for (const Surd& s : moments_of_change(is_straight ? direction : turn)) {
    if (direction[0].sign_at({s, false}) > 0) return Moment{s, false};
    if (is_straight && direction[0].sign_at({s, true}) > 0) return Moment{s, true};
  }
  if (is_straight && direction[0].sign_at({{0}, true}) > 0) return Moment{{0}, true};
  return std::nullopt;
}

}  // namespace algebra3d
