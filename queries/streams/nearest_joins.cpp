// knnJoin, knnSelfJoin, closestPair, closestSelfPair: pairs of tuples by the smallest distances of their sets.
#include <algorithm>
#include <array>
#include <string>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/join_condition.h"
#include "queries/streams/detail/nearest_join.h"
#include "queries/streams/detail/spatial_operands.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Registry;

/// A join of two streams, or of one with itself.
enum class Operands : std::uint8_t { two_streams, one_stream };

Result<SpatialOperands> nearest_operands(const Registry& registry, const MappingCheck& check, Operands operands) {
  A3D_ASSIGN(SpatialOperands join, operands == Operands::two_streams ? spatial_operands(registry, check)
                                                                     : spatial_self_operands(registry, check));
  A3D_TRY(check_operands(registry, "distance", std::array{join.left_type, join.right_type}));
  return join;
}

TupleStreamPtr empty_stream() {
  return make_stream([]() -> Result<TuplePtr> { return TuplePtr(); });
}

/// Runs `join(probes, partners)` on the first operand and on the second one, or on itself.
template <typename Join>
Result<Datum> run_join(const std::vector<Datum>& given, Operands operands, const Context& context, const Join& join) {
  const bool is_self_join = operands == Operands::one_stream;
  A3D_ASSIGN(TupleBuffer partners, buffered(*given[is_self_join ? 0 : 1].tuples(), context));
  const TupleStreamPtr probes = is_self_join ? partners.scan() : given[0].tuples();
  return Datum{join(probes, std::move(partners))};
}

TypeMapping map_knn_join(const Registry& registry, const char* op, Operands operands) {
  return [&registry, op, operands](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(op, arguments);
    A3D_ASSIGN(const SpatialOperands join, nearest_operands(registry, check, operands));
    A3D_TRY(check.type(check.count() - 1, "int"));
    return BoundOperator{
        TypeExpr::stream(join.joined), [=](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
          const Value& count = given.back().value();
          if (!count.is_defined() || count.get<std::int64_t>() <= 0) return Datum{empty_stream()};
          const NearestTask task{join.left_key, join.right_key, static_cast<std::size_t>(count.get<std::int64_t>()),
                                 operands == Operands::two_streams ? Partners::all : Partners::others};
          return run_join(given, operands, context, [&](TupleStreamPtr probes, TupleBuffer partners) {
            return nearest_join(std::move(probes), std::move(partners), task, context);
          });
        }};
  };
}

TypeMapping map_closest_pair(const Registry& registry, const char* op, Operands operands) {
  return [&registry, op, operands](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(op, arguments);
    A3D_ASSIGN(const SpatialOperands join, nearest_operands(registry, check, operands));
    return BoundOperator{TypeExpr::stream(join.joined),
                         [=](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
                           const NearestTask task{join.left_key, join.right_key, 1,
                                                  operands == Operands::two_streams ? Partners::all : Partners::later};
                           return run_join(given, operands, context, [&](TupleStreamPtr probes, TupleBuffer partners) {
                             return closest_pair(std::move(probes), std::move(partners), task, context);
                           });
                         }};
  };
}

const std::string kPoints =
    "[const rel(tuple([No: int, P: point3d])) value ((1 (0 0 0)) (2 (3 0 0)) (3 (4 0 0)) (4 undefined))] feed ";
const std::string kTwoOperands = kPoints + "{a} " + kPoints + "{b} ";
const std::string kSolids =
    "intstream(1, 3) transformstream extend[S: createCube(makePoint3D(.Elem * .Elem, 0, 0), makePoint3D(.Elem * .Elem "
    "+ 1, 1, 1))] ";

constexpr const char* kExactly =
    "Distances are those of `distance`, compared before they are rounded. Candidates come from an R-tree over the "
    "boxes, and their distances are computed many in parallel; the result and its order do not depend on that. Empty "
    "and undefined sets have no partners.";
constexpr const char* kSuffixes =
    " In the result the attributes of the first tuple end in `_a`, those of the second in `_b`.";
constexpr const char* kNotSpatial = ": expected an attribute of kind SPATIAL2D or SPATIAL3D, got int";

void register_knn_joins(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "knnJoin",
      .syntax = "_ _ knnJoin[attribute, attribute, _]",
      .doc = "Each tuple of the first stream with each of the k tuples of the second one that are nearest to it, in "
             "the order of the first stream, the nearest one first.",
      .detail = std::string("Equal distances: in the order of the second stream. No pairs if k is undefined or not "
                            "positive. ") +
                kExactly,
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .sources = {"hjaltason1999"},
      .stream = stream_operator(map_knn_join(group.registry(), "knnJoin", Operands::two_streams)),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{kTwoOperands + "knnJoin[P_a, P_b, 2] project[No_a, No_b] consume",
                          "((1 1) (1 2) (2 2) (2 3) (3 3) (3 2))"},
                         {kTwoOperands + "knnJoin[P_a, P_b, 0] count", "0"}},
      .query_errors = {{"query " + kTwoOperands + "knnJoin[No_a, P_b, 1] count", std::string("knnJoin") + kNotSpatial},
                       {"query " + kTwoOperands + "knnJoin[P_a, P_b, 0.5] count", "knnJoin: expected int, got real"}},
  });
  group.add({
      .name = "knnSelfJoin",
      .syntax = "_ knnSelfJoin[attribute, _]",
      .doc = "Each tuple of a stream with each of the k other ones that are nearest to it, in the order of the stream, "
             "the nearest one first.",
      .detail =
          std::string("Equal distances: in the order of the stream. No pairs if k is undefined or not positive. ") +
          kExactly + kSuffixes,
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .sources = {"hjaltason1999"},
      .stream = stream_operator(map_knn_join(group.registry(), "knnSelfJoin", Operands::one_stream)),
      .signatures = {"(stream(tuple) NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{kPoints + "knnSelfJoin[P, 1] project[No_a, No_b] consume", "((1 2) (2 3) (3 2))"},
                         {kPoints + "knnSelfJoin[P, [const int value undefined]] count", "0"}},
      .query_errors = {{"query " + kPoints + "knnSelfJoin[No, 1] count", std::string("knnSelfJoin") + kNotSpatial}},
  });
}

void register_closest_pairs(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "closestPair",
      .syntax = "_ _ closestPair[attribute, attribute]",
      .doc = "The tuple of the first stream and the tuple of the second one that are nearest to each other, as a "
             "stream of one tuple; of none if there is no pair.",
      .detail = std::string("Equal distances: the earlier tuple of the first stream, then the earlier one of the "
                            "second. ") +
                kExactly,
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .sources = {"hjaltason1999"},
      .stream = stream_operator(map_closest_pair(group.registry(), "closestPair", Operands::two_streams)),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .gives_one_tuple = true,
      .query_examples = {{kTwoOperands + "closestPair[P_a, P_b] project[No_a, No_b] consume", "((1 1))"},
                         {kTwoOperands + "filter[.No_b > 3] closestPair[P_a, P_b] count", "0"}},
      .query_errors = {{"query " + kTwoOperands + "closestPair[No_a, P_b] count",
                        std::string("closestPair") + kNotSpatial}},
  });
  group.add({
      .name = "closestSelfPair",
      .syntax = "_ closestSelfPair[attribute]",
      .doc = "The two different tuples of a stream that are nearest to each other, the earlier one first, as a stream "
             "of one tuple; of none if there is no pair.",
      .detail = std::string("Equal distances: the earliest tuple that has the smallest one, with the earliest of its "
                            "partners. ") +
                kExactly + kSuffixes,
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::sorting,
      .sources = {"hjaltason1999"},
      .stream = stream_operator(map_closest_pair(group.registry(), "closestSelfPair", Operands::one_stream)),
      .signatures = {"(stream(tuple) NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .gives_one_tuple = true,
      .query_examples = {{kPoints + "closestSelfPair[P] project[No_a, No_b] consume", "((2 3))"},
                         {kSolids + "closestSelfPair[S] project[Elem_a, Elem_b] consume", "((1 2))"},
                         {kPoints + "filter[.No > 2] closestSelfPair[P] count", "0"}},
      .query_errors = {{"query " + kPoints + "closestSelfPair[No] count",
                        std::string("closestSelfPair") + kNotSpatial}},
  });
}

}  // namespace

void register_nearest_joins(algebra3d::OperatorGroup& group) {
  register_knn_joins(group);
  register_closest_pairs(group);
}

}  // namespace queries
