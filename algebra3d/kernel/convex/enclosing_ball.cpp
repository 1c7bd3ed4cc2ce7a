#include "algebra3d/kernel/convex/enclosing_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/kernel/convex/detail/ball_filter.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates_filter.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using detail::CentreDistances;

/// Up to five points of which some hold the ball.
using Support = std::vector<RationalVec3>;

/// The smallest ball through all the points, with its centre in their affine hull; nothing if they are affinely
/// dependent. At most four points.
std::optional<ExactBall> circumscribed_ball(const Support& points) {
  const std::size_t n = points.size() - 1;
  // The linear equations for the centre a + sum of f_j (p_j - a): in each row, sum of 2 f_j u_i.u_j = u_i.u_i.
  std::array<std::array<Rational, 4>, 3> rows;
  for (std::size_t i = 0; i < n; ++i) {
    const RationalVec3 u = points[i + 1] - points[0];
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = Rational(2) * dot(u, points[j + 1] - points[0]);
    rows[i][n] = dot(u, u);
  }
  // The matrix of the products is positive semidefinite, so elimination needs no exchange of rows.
  for (std::size_t k = 0; k < n; ++k) {
    if (rows[k][k].sign() == 0) return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Rational factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  RationalVec3 offset;
  for (std::size_t i = 0; i < n; ++i) offset = offset + rows[i][n] / rows[i][i] * (points[i + 1] - points[0]);
  return ExactBall{points[0] + offset, dot(offset, offset)};
}

bool contains(const ExactBall& ball, const Support& points) {
  return std::ranges::all_of(points, [&](const RationalVec3& p) {
    const RationalVec3 d = p - ball.centre;
    return dot(d, d) <= ball.squared_radius;
  });
}

/// The smallest ball around at most five points, the last of which is on its boundary; keeps those that hold it.
ExactBall pivot(Support& support) {
  std::optional<ExactBall> best;
  Support best_support;
  const RationalVec3 last = support.back();
  for (unsigned chosen = 0; chosen < 1U << (support.size() - 1); ++chosen) {
    Support subset{last};
    for (std::size_t i = 0; i + 1 < support.size(); ++i)
      if ((chosen >> i & 1U) != 0) subset.push_back(support[i]);
    if (subset.size() > 4) continue;
    auto ball = circumscribed_ball(subset);
    if (!ball || (best && best->squared_radius <= ball->squared_radius) || !contains(*ball, support)) continue;
    best = std::move(ball);
    best_support = std::move(subset);
  }
  support = std::move(best_support);
  return *std::move(best);
}

/// A point outside of the ball: the farthest one, but for rounding, or any other; nothing if there is none.
std::optional<std::size_t> point_outside(const ExactBall& ball, const PointArray& points) {
  const CentreDistances distances(ball.centre);
  const CentreDistances::Estimate limit = detail::estimate_of(ball.squared_radius);
  std::vector<std::size_t> undecided;
  std::optional<std::size_t> farthest;
  double greatest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    const CentreDistances::Estimate rough = distances.rough(points[i]);
    int side = detail::compare(rough, limit);
    if (side == detail::kUndecided && !farthest) side = detail::compare(distances.fine(points[i]), limit);
    if (side == detail::kUndecided) undecided.push_back(i);
    if (side != 1 || (farthest && !(rough.value > greatest))) continue;
    farthest = i;
    greatest = rough.value;
  }
  if (farthest) return farthest;
  for (const std::size_t i : undecided)
    if (ball.squared_radius < distances.exact(points[i])) return i;
  return std::nullopt;
}

/// The smallest double whose square is at least the number.
double root_above(const Rational& square) {
  const double root = square.nearest_root();
  if (!std::isfinite(root) || square <= Rational(root) * Rational(root)) return root;
  return std::nextafter(root, std::numeric_limits<double>::infinity());
}

}  // namespace

Result<std::optional<ExactBall>> smallest_enclosing_ball(const PointArray& points, const Monitor& monitor) {
  if (points.size() == 0) return std::optional<ExactBall>();
  Support support{points[0].rational()};
  ExactBall ball{support[0], 0};
  // Each ball is larger than the one before, and there are finitely many.
  while (const auto outside = point_outside(ball, points)) {
    A3D_TRY(monitor.check());
    support.push_back(points[*outside].rational());
    ball = pivot(support);
  }
  return std::optional(std::move(ball));
}

RoundedBall rounded_ball(const ExactBall& ball, const PointArray& points) {
  const RationalVec3& c = ball.centre;
  const Vec3 centre{c.x.nearest_double(), c.y.nearest_double(), c.z.nearest_double()};
  const CentreDistances distances{RationalVec3(centre)};
  Rational greatest;
  CentreDistances::Estimate limit = detail::estimate_of(greatest);
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    if (detail::compare(distances.rough(points[i]), limit) == -1) continue;
    if (detail::compare(distances.fine(points[i]), limit) == -1) continue;
    Rational square = distances.exact(points[i]);
    if (square <= greatest) continue;
    greatest = std::move(square);
    limit = detail::estimate_of(greatest);
  }
  return {centre, root_above(greatest)};
}

}  // namespace algebra3d
