// distance, withinDistance, closestPoints: of boxes, points, surfaces and solids in space, and of points, rectangles
// and regions in the plane.
#include <cmath>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/descriptions/detail/spatial_sets.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

const Undefined kNoDistance{"the empty set has no distance"};

template <typename A, typename B>
Result<Maybe<double>> distance_of(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  if (is_either_empty(a.header(), b.header())) return Maybe<double>(kNoDistance);
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) -> Result<Maybe<double>> {
    A3D_ASSIGN(const auto square, squared_distance_of(first, second, context.monitor()));
    return square ? Maybe<double>(square->nearest_root()) : Maybe<double>(kNoDistance);
  });
}

template <typename A, typename B>
Result<bool> is_within(Context& context, const OnDemand<A>& a, const OnDemand<B>& b, double limit) {
  if (is_either_empty(a.header(), b.header()) || limit < 0) return false;
  if (const std::optional<bool> by_boxes = are_within_by_boxes(a.header().box, b.header().box, limit)) return *by_boxes;
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) {
    return are_within(first, second, Rational(limit), context.monitor());
  });
}

using ClosestRow = std::tuple<Point3d, Point3d, std::optional<double>>;

/// Nothing beyond the range of doubles.
std::optional<double> length_of(const NearestPoints& nearest) {
  const double length = nearest.squared_distance.nearest_root();
  return std::isfinite(length) ? std::optional(length) : std::nullopt;
}

template <typename A, typename B>
Result<std::optional<ClosestRow>> closest_points_row(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  using Row = std::optional<ClosestRow>;
  if (is_either_empty(a.header(), b.header())) return Row();
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) -> Result<Row> {
    A3D_ASSIGN(const auto nearest, nearest_points(first, second, context.monitor()));
    if (!nearest) return Row();
    return Row(ClosestRow(Point3d{nearest->first}, Point3d{nearest->second}, length_of(*nearest)));
  });
}

struct DistanceMaker {
  template <typename A, typename B>
  static Overload make() {
    Overload made = overload<&distance_of<A, B>>("a", "b");
    made.is_symmetric = std::is_same_v<A, B>;
    return made;
  }
};

struct WithinMaker {
  template <typename A, typename B>
  static Overload make() {
    return overload<&is_within<A, B>>("a", "b", "limit");
  }
};

struct ClosestPointsMaker {
  template <typename A, typename B>
  static Overload make() {
    return table<&closest_points_row<A, B>>({"First", "Second", "Distance"}, "a", "b");
  }
};

const std::string kFarCube = "(createCube (makePoint3D 5 6 0) (makePoint3D 6 7 1))";
const std::string kEmptySolid = "(volume3d ())";

constexpr const char* kMeaningOfDistance =
    "All sets are closed; the inside of a solid or box belongs to it, so sets that meet have the distance 0.";

}  // namespace

void register_distances(OperatorGroup& group) {
  group.add({
      .name = "distance",
      .syntax = "distance(_, _)",
      .doc = "The smallest distance of a point of one set and a point of the other, in coordinate units.",
      .detail = std::string(kMeaningOfDistance) +
                " Undefined if a set is empty, or if the distance is beyond the range of doubles.",
      .exactness = Exactness::rounded_once,
      .sources = {"larsen2000", "ericson2005"},
      .overloads = all_pairs<DistanceMaker>(),
      .examples = {{{kCubeOfTwo, kFarCube}, "5.0"},
                   {{kCubeOfTwo, kInnerCube}, "0.0"},
                   {{"(makePoint3D 1 1 4)", kCubeOfTwo}, "2.0"},
                   {{"(rectangle3 0 1 0 1 0 1)", "(rectangle3 2 3 2 3 0 1)"}, "1.4142135623730951"},
                   {{"(makePoint 4 5)", kUnitRegion}, "5.0"},
                   {{kCubeOfTwo, kEmptySolid}, "undefined"},
                   {{kCubeOfTwo, kUndefinedSolid}, "undefined"}},
      .errors = {{{kCubeOfTwo, "1"}, "distance: expected (volume3d rect3)"}},
  });
  group.add({
      .name = "withinDistance",
      .syntax = "withinDistance(_, _, _)",
      .doc = "True if the distance of two sets is at most a limit, in coordinate units.",
      .detail = std::string(kMeaningOfDistance) + " False if a set is empty or the limit is negative.",
      .exactness = Exactness::exact,
      .boxes = BoxCondition::are_near,
      .sources = {"larsen2000", "ericson2005"},
      .overloads = all_pairs<WithinMaker>(),
      .examples = {{{kCubeOfTwo, kFarCube, "5"}, "TRUE"},
                   {{kCubeOfTwo, kFarCube, "4.999999999999999"}, "FALSE"},
                   {{kCubeOfTwo, kInnerCube, "0"}, "TRUE"},
                   {{kCubeOfTwo, kEmptySolid, "1e300"}, "FALSE"},
                   {{kCubeOfTwo, kUndefinedSolid, "1"}, "undefined"}},
      .errors = {{{kCubeOfTwo, kFarCube}, "withinDistance: expected (rect3 rect3 real)"}},
  });
  group.add({
      .name = "closestPoints",
      .syntax = "closestPoints(_, _)",
      .doc =
          "A point of each of two sets, nearest to each other, in one row (First: point3d, Second: point3d, Distance: "
          "real); no row if a set is empty.",
      .detail = std::string(kMeaningOfDistance) +
                " The points are exact. If several pairs of points are equally near, always the same one of them.",
      .exactness = Exactness::rounded_once,
      .sources = {"larsen2000", "ericson2005"},
      .overloads = pairs_in_space<ClosestPointsMaker>(),
      .examples = {{{kCubeOfTwo, kFarCube}, "(((2.0 2.0 0.0) (5.0 6.0 0.0) 5.0))"},
                   {{"(makePoint3D 1 1 4)", kCubeOfTwo}, "(((1.0 1.0 4.0) (1.0 1.0 2.0) 2.0))"},
                   {{kCubeOfTwo, kEmptySolid}, "()"},
                   {{kCubeOfTwo, kUndefinedSolid}, "()"}},
      .errors = {{{kCubeOfTwo, "1"}, "closestPoints: expected (volume3d rect3)"}},
  });
}

}  // namespace algebra3d
