// hausdorffDistance: of the boundaries of boxes, points, surfaces and solids.
#include "algebra3d/values/measures/hausdorff_distance.h"

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/descriptions/detail/spatial_sets.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "base/number_text.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// How close a distance is that the search ended with.
std::string bound_text(double distance, double upper_bound) {
  const double off = std::nextafter(upper_bound - distance, std::numeric_limits<double>::infinity());
  return fmt::format("hausdorffDistance: the exact distance is at most {}, that is {} more than the one found",
                     real_text(upper_bound), real_text(off));
}

template <typename A, typename B>
Result<Maybe<double>> hausdorff_distance_of(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  const Undefined no_distance{"the empty set has no distance"};
  if (is_either_empty(a.header(), b.header())) return Maybe<double>(no_distance);
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) -> Result<Maybe<double>> {
    A3D_ASSIGN(const auto farthest, hausdorff_distance(first, second, context.monitor()));
    if (!farthest) return Maybe<double>(no_distance);
    const double distance = farthest->squared_distance.nearest_root();
    if (!farthest->is_bounded) context.diagnostics.report(bound_text(distance, farthest->upper_bound));
    return Maybe<double>(distance);
  });
}

struct HausdorffMaker {
  template <typename A, typename B>
  static Overload make() {
    Overload made = overload<&hausdorff_distance_of<A, B>>("a", "b");
    made.is_symmetric = std::is_same_v<A, B>;
    return made;
  }
};

}  // namespace

void register_hausdorff(OperatorGroup& group) {
  group.add({
      .name = "hausdorffDistance",
      .syntax = "hausdorffDistance(_, _)",
      .doc = "The largest distance of a point of one set from the other set, whichever is larger, in coordinate units; "
             "of solids and boxes that of their boundaries.",
      .detail =
          "The distance of a point that was found, rounded once. It may be too small by a billionth of it and "
          "2^-44 of the largest coordinate; where a vertex is farthest, it mostly is exact. If that takes more "
          "than four million parts of triangles, or more than some 200 microseconds for each triangle of sets "
          "that are nowhere farther apart than 2^-16 of the largest coordinate, a diagnostic gives the bound that "
          "was reached. Undefined if a set is empty, or if the distance is beyond the range of doubles.",
      .exactness = Exactness::bounded,
      .cost = Cost::sorting,
      .sources = {"guthe2005", "tang2009"},
      .overloads = pairs_in_space<HausdorffMaker>(),
      .examples = {{{kCubeOfTwo, kUnitCube}, "1.7320508075688772"},
                   {{kUnitCube, kUnitCube}, "0.0"},
                   {{kUnitCube, "(createCube (makePoint3D 3 0 0) (makePoint3D 4 1 1))"}, "3.0"},
                   {{"(makePoint3D 0 0 5)", "(rectangle3 -1 1 -1 1 0 0)"}, "5.196152422706632"},
                   {{kUnitCube, "(volume3d ())"}, "undefined"},
                   {{kUnitCube, kUndefinedSolid}, "undefined"}},
      .errors = {{{kUnitCube, "1"}, "hausdorffDistance: expected (volume3d rect3)"}},
  });
}

}  // namespace algebra3d
