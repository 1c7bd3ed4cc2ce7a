// pointsInside: tuples whose point lies in a solid, many at a time.
#include <span>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/spatial_relations/point_location.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/parallel_filter.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Placement;
using algebra3d::Point3d;
using algebra3d::PointRef;
using algebra3d::Volume3d;

/// Whether the points of tuples are in a solid. An undefined point is not.
std::vector<bool> are_inside(std::span<const TuplePtr> tuples, std::size_t attribute, const Volume3d& solid) {
  std::vector<PointRef> points;
  std::vector<std::size_t> places;  // of their tuples
  for (std::size_t i = 0; i < tuples.size(); ++i) {
    const Value& value = tuples[i]->attributes[attribute];
    if (!value.is_defined()) continue;
    points.push_back(value.get<Point3d>().position.ref());
    places.push_back(i);
  }
  const std::vector<Placement> placements = place_in_solid(points, solid.geometry());
  std::vector<bool> result(tuples.size());
  for (std::size_t k = 0; k < places.size(); ++k) result[places[k]] = placements[k] != Placement::outside;
  return result;
}

Result<BoundOperator> map_points_inside(std::span<const ArgumentType> arguments) {
  const MappingCheck check("pointsInside", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t attribute, check.attribute(1, tuple));
  if (const TypeExpr& type = tuple.attributes()[attribute].type; !type.is("point3d"))
    return check.expected("an attribute of type point3d", type);
  A3D_TRY(check.type(2, "volume3d"));
  return BoundOperator{TypeExpr::stream(tuple), [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         if (!given[2].value().is_defined())
                           return Datum{make_stream([]() -> Result<TuplePtr> { return TuplePtr(); })};
                         A3D_ASSIGN(const Value solid, given[2].value().loaded());
                         const auto condition = [attribute,
                                                 solid](std::span<const TuplePtr> block) -> Result<std::vector<bool>> {
                           return are_inside(block, attribute, solid.get<Volume3d>());
                         };
                         constexpr std::size_t kLargestBlock = 16384;
                         return Datum{block_filter(given[0].tuples(), kLargestBlock, condition, context)};
                       }};
}

}  // namespace

void register_points_inside(algebra3d::OperatorGroup& group) {
  const std::string points =
      "[const rel(tuple([No: int, P: point3d])) value ((1 (0 0 0)) (2 (0.5 0.5 0.5)) (3 (2 0 0)) (4 undefined))] feed ";
  const std::string cube = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";
  group.add({
      .name = "pointsInside",
      .syntax = "_ pointsInside[attribute, _]",
      .doc = "The tuples whose point lies in a solid, its boundary included, in their order.",
      .detail = "The same as `filter[.P inside v]`, but the points are located many at a time and in parallel. Tuples "
                "with an undefined point are left out; no tuple is in an undefined solid.",
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_points_inside),
      .signatures = {"(stream(tuple) NAME volume3d) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{points + "pointsInside[P, " + cube + "] project[No] consume", "((1) (2))"},
                         {points + "pointsInside[P, [const volume3d value undefined]] count", "0"}},
      .query_errors = {{"query " + points + "pointsInside[No, " + cube + "] count",
                        "pointsInside: expected an attribute of type point3d, got int"}},
  });
}

}  // namespace queries
