// spatialSelfJoin, distanceSelfJoin: pairs of tuples of one stream by the relation or the distance of their sets.
#include <fmt/format.h>

#include <array>
#include <string>

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

using algebra3d::Registry;

/// The joined pairs of a stream for which `test` holds.
Result<Datum> self_joined(const SpatialOperands& join, const std::vector<Datum>& given, WindowOfBox window,
                          PairTest test, const Context& context) {
  return Datum{refined_join(box_pairs_within({given[0].tuples(), join.left_key}, std::move(window), context),
                            {join.left_key, join.left_key}, std::move(test), context)};
}

TypeMapping map_spatial_self_join(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("spatialSelfJoin", arguments);
    A3D_ASSIGN(const SpatialOperands join, spatial_self_operands(registry, check));
    A3D_ASSIGN(const std::string name, predicate_name(check, 2));
    A3D_TRY(check_operands(registry, name, std::array{join.left_type, join.left_type}));
    return BoundOperator{TypeExpr::stream(join.joined), [=](const std::vector<Datum>& given, Context& context) {
                           const auto window = [](const algebra3d::Box3& box) { return box; };
                           return self_joined(join, given, window, predicate_test(name, true), context);
                         }};
  };
}

TypeMapping map_distance_self_join(const Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("distanceSelfJoin", arguments);
    A3D_ASSIGN(const SpatialOperands join, spatial_self_operands(registry, check));
    A3D_ASSIGN(const Conversion conversion, check.conversion(2, TypeExpr("real")));
    A3D_TRY(check_operands(registry, "withinDistance", std::array{join.left_type, join.left_type, TypeExpr("real")}));
    return BoundOperator{TypeExpr::stream(join.joined), [=](const std::vector<Datum>& given, Context& context) {
                           const Value limit = converted(given[2].value(), conversion);
                           return self_joined(join, given, distance_window(limit), distance_test(limit), context);
                         }};
  };
}

const std::string kRowOfBalls =
    "intstream(1, 4) transformstream extend[Ball: createSphere(makePoint3D(1.5 * .Elem, .Elem, 0), 1, 8)] ";
/// Two boxes of which the second lies in the first, and one beside them.
const std::string kNestedBoxes =
    "[const rel(tuple([No: int, B: rect3])) value ((1 (1 2 1 2 1 2)) (2 (0 3 0 3 0 3)) (3 (3 4 0 1 0 1)))] feed ";

constexpr const char* kEachOnce =
    "The same as a join of the stream with itself, but each pair of different tuples comes once, and no tuple with "
    "itself. In the result the attributes of the first tuple end in `_a`, those of the second in `_b`. The order is "
    "that of the later tuples of the pairs. Pairs are examined exactly, many in parallel; the result and its order do "
    "not depend on that. Empty and undefined sets have no partners.";

}  // namespace

void register_spatial_self_join(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "spatialSelfJoin",
      .syntax = "_ spatialSelfJoin[attribute; _]",
      .doc = "The pairs of different tuples of a stream for whose attributes a predicate holds, each pair once.",
      .detail = fmt::format("The predicate is a constant, one of {}. The earlier tuple is the first one; of `inside`, "
                            "`contains`, `covers` and `coveredBy` the one for which the predicate holds. {}",
                            predicate_names(), kEachOnce),
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_spatial_self_join(group.registry())),
      .signatures = {"(stream(tuple) NAME string) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{kRowOfBalls + "spatialSelfJoin[Ball; \"intersects\"] project[Elem_a, Elem_b] consume",
                          "((1 2) (2 3) (3 4))"},
                         {kNestedBoxes + "spatialSelfJoin[B; \"inside\"] project[No_a, No_b] consume", "((1 2))"},
                         {kNestedBoxes + "spatialSelfJoin[B; \"contains\"] project[No_a, No_b] consume", "((2 1))"}},
      .query_errors = {{"query " + kRowOfBalls + "spatialSelfJoin[Ball; \"disjoint\"] count",
                        "spatialSelfJoin: expected a predicate: intersects, touches, inside"},
                       {"query " + kRowOfBalls + "spatialSelfJoin[Elem; \"intersects\"] count",
                        "spatialSelfJoin: expected an attribute of kind SPATIAL2D or SPATIAL3D, got int"}},
  });
  group.add({
      .name = "distanceSelfJoin",
      .syntax = "_ distanceSelfJoin[attribute, _]",
      .doc = "The pairs of different tuples of a stream whose attributes are at most a distance apart, each pair once, "
             "the earlier tuple first.",
      .detail = std::string("No pairs for an undefined or negative distance. ") + kEachOnce,
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_distance_self_join(group.registry())),
      .signatures = {"(stream(tuple) NAME real) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{kRowOfBalls + "distanceSelfJoin[Ball, 2] project[Elem_a, Elem_b] consume",
                          "((1 2) (1 3) (2 3) (2 4) (3 4))"},
                         {kRowOfBalls + "distanceSelfJoin[Ball, -1] count", "0"}},
      .query_errors = {{"query " + kRowOfBalls + "distanceSelfJoin[Ball, \"2\"] count", "distanceSelfJoin: expected"}},
  });
}

}  // namespace queries
