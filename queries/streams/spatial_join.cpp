// itSpatialJoin, spatialJoin, distanceJoin: pairs of tuples by the boxes, the relation or the distance of their sets.
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/box_join.h"
#include "queries/streams/detail/join_condition.h"
#include "queries/streams/detail/refined_join.h"
#include "queries/streams/detail/spatial_operands.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::Registry;

PairStreamPtr pairs_by_boxes(const SpatialOperands& join, const std::vector<Datum>& given, WindowOfBox window,
                             const Context& context) {
  return box_pairs({given[0].tuples(), join.left_key}, {given[1].tuples(), join.right_key}, std::move(window), context);
}

Box3 itself(const Box3& box) {
  return box;
}

TypeMapping map_box_join(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("itSpatialJoin", arguments);
    A3D_TRY(check.argument_count(4, 7));
    for (std::size_t place = 4; place < check.count(); ++place) A3D_TRY(check.type(place, "int"));
    A3D_ASSIGN(const SpatialOperands join, spatial_operands(registry, check));
    return BoundOperator{TypeExpr::stream(join.joined),
                         [join](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
                           return Datum{concatenated_pairs(pairs_by_boxes(join, given, itself, context))};
                         }};
  };
}

TypeMapping map_spatial_join(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("spatialJoin", arguments);
    A3D_ASSIGN(const SpatialOperands join, spatial_operands(registry, check));
    A3D_ASSIGN(const std::string name, predicate_name(check, 4));
    A3D_TRY(check_operands(registry, name, std::array{join.left_type, join.right_type}));
    return BoundOperator{
        TypeExpr::stream(join.joined), [=](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
          return Datum{refined_join(pairs_by_boxes(join, given, itself, context), {join.left_key, join.right_key},
                                    predicate_test(name, false), context)};
        }};
  };
}

TypeMapping map_distance_join(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("distanceJoin", arguments);
    A3D_ASSIGN(const SpatialOperands join, spatial_operands(registry, check));
    A3D_ASSIGN(const Conversion conversion, check.conversion(4, TypeExpr("real")));
    A3D_TRY(check_operands(registry, "withinDistance", std::array{join.left_type, join.right_type, TypeExpr("real")}));
    return BoundOperator{TypeExpr::stream(join.joined),
                         [=](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
                           const Value limit = converted(given[4].value(), conversion);
                           return Datum{refined_join(pairs_by_boxes(join, given, distance_window(limit), context),
                                                     {join.left_key, join.right_key}, distance_test(limit), context)};
                         }};
  };
}

constexpr std::string_view kJoinedBoxes =
    "[const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))] feed ";
const std::string kBalls =
    "intstream(1, 4) transformstream extend[Ball: createSphere(makePoint3D(1.5 * .Elem, .Elem, 0), 1, 8)] ";

void register_box_join(algebra3d::OperatorGroup& group) {
  const std::string boxes(kJoinedBoxes);
  group.add({
      .name = "itSpatialJoin",
      .syntax = "_ _ itSpatialJoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams whose boxes meet, in the order of the second stream.",
      .detail = "The first stream is held in memory with an R-tree over it; if it does not fit into the memory of `set "
                "\"memory\"`, both streams are divided by space into temporary files. Touching counts. Up to three "
                "ints (node sizes and memory) are accepted and "
                "not needed.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_box_join(group.registry())),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{boxes + "{a} " + boxes + "{b} itSpatialJoin[B_a, B_b] project[No_a, No_b] consume",
                          "((1 1) (2 2))"}},
      .query_errors = {{"query " + boxes + boxes + "itSpatialJoin[B, B] count",
                        "itSpatialJoin: duplicate attribute name 'No'"},
                       {"query " + boxes + "{a} " + boxes + "{b} itSpatialJoin[No_a, B_b] count",
                        "itSpatialJoin: expected an attribute of kind SPATIAL2D or SPATIAL3D, got int"}},
  });
}

constexpr const char* kRefined =
    "Pairs whose boxes are near enough are found as by `itSpatialJoin`, and examined exactly, many in parallel; the "
    "result and its order do not depend on that. Empty and undefined sets have no partners.";

void register_exact_joins(algebra3d::OperatorGroup& group) {
  const std::string pairs = kBalls + "{a} " + kBalls + "{b} ";
  group.add({
      .name = "spatialJoin",
      .syntax = "_ _ spatialJoin[attribute, attribute; _]",
      .doc = "The pairs of tuples of both streams for whose attributes a predicate holds, in the order of the second "
             "stream.",
      .detail = fmt::format("The predicate is a constant, one of {}. {}", predicate_names(), kRefined),
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_spatial_join(group.registry())),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME string) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{pairs + "spatialJoin[Ball_a, Ball_b; \"intersects\"] filter[.Elem_a < .Elem_b] "
                                  "project[Elem_a, Elem_b] consume",
                          "((1 2) (2 3) (3 4))"},
                         {pairs + "spatialJoin[Ball_a, Ball_b; \"inside\"] count", "4"}},
      .query_errors = {{"query " + pairs + "spatialJoin[Ball_a, Ball_b; \"disjoint\"] count",
                        "spatialJoin: expected a predicate: intersects, touches, inside"},
                       {"query " + pairs + "spatialJoin[Elem_a, Ball_b; \"intersects\"] count",
                        "spatialJoin: expected an attribute of kind SPATIAL2D or SPATIAL3D, got int"}},
  });
  group.add({
      .name = "distanceJoin",
      .syntax = "_ _ distanceJoin[attribute, attribute, _]",
      .doc = "The pairs of tuples of both streams whose attributes are at most a distance apart, in the order of the "
             "second stream.",
      .detail = std::string("No pairs for an undefined or negative distance. ") + kRefined,
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_distance_join(group.registry())),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME real) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{kBalls + "{a} " + kBalls +
                              "{b} distanceJoin[Ball_a, Ball_b, 2] filter[.Elem_a < .Elem_b] "
                              "project[Elem_a, Elem_b] consume",
                          "((1 2) (1 3) (2 3) (2 4) (3 4))"},
                         {pairs + "distanceJoin[Ball_a, Ball_b, -1] count", "0"}},
      .query_errors = {{"query " + pairs + "distanceJoin[Ball_a, Ball_b, \"2\"] count", "distanceJoin: expected"}},
  });
}

}  // namespace

void register_spatial_join(algebra3d::OperatorGroup& group) {
  register_box_join(group);
  register_exact_joins(group);
}

}  // namespace queries
