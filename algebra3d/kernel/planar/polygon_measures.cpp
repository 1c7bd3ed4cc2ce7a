#include "algebra3d/kernel/planar/polygon_measures.h"

#include <cmath>

#include "algebra3d/kernel/exact/balanced_sum.h"
#include "algebra3d/kernel/exact/exact_sum_plane.h"
#include "algebra3d/kernel/exact/expansion.h"
#include "base/interruption_scope.h"

namespace algebra3d {

Rational doubled_area(const Polygons& valid) {
  detail::BalancedSum sum;
  for (std::size_t face = 0; face < valid.face_count(); ++face) {
    poll_interruption_at(face);
    const std::uint32_t outer = valid.first_cycle(face);
    for (std::uint32_t cycle = outer; cycle < valid.face_ends[face]; ++cycle) {
      const Rational area = exact_doubled_area(valid.corners, valid.first_corner(cycle), valid.cycle_ends[cycle]).abs();
      sum.add(cycle == outer ? area : -area);
    }
  }
  return sum.total();
}

double nearest_area(const Polygons& valid) {
  return (doubled_area(valid) / Rational(2)).nearest_double();
}

// Each length carries an error of 1 ulp at most, and all are positive; the sum of the rounded ones carries next to
// none.
double nearest_perimeter(const Polygons& polygons) {
  double total = 0, rests = 0;
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
    const double length = nearest_length(polygons.corners, polygons.first_corner(cycle), polygons.cycle_ends[cycle]);
    const auto [sum, rest] = detail::two_sum(total, length);
    total = sum;
    rests += rest;
  }
  return std::isfinite(total) ? total + rests : total;
}

}  // namespace algebra3d
