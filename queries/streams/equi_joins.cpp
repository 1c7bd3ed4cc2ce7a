// hashjoin, itHashJoin, mergejoin, sortmergejoin, smouterjoin: pairs of tuples with equal keys.
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/hash_join.h"
#include "queries/streams/detail/merge_join.h"

namespace queries {
namespace {

BoundOperator bound_hashjoin(const JoinTypes& types, const JoinOutput& output) {
  return {
      TypeExpr::stream(types.joined),
      [output](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return Datum{TupleStreamPtr(std::make_shared<HashJoin>(given[0].tuples(), given[1].tuples(), output, context))};
      },
      PairsTuples{types.left.attributes().size(), false, output.keys, {}, [types, output](std::vector<bool> read) {
                    JoinOutput pruned = output;
                    pruned.read = std::move(read);
                    return bound_hashjoin(types, pruned);
                  }}};
}

// hashjoin and itHashJoin are two names of one operator: the original's differ in what they do when memory is short.
Result<BoundOperator> map_hashjoin(const char* op, std::span<const ArgumentType> arguments) {
  const MappingCheck check(op, arguments);
  A3D_ASSIGN(const JoinTypes types, join_types(check));
  A3D_TRY(check.argument_count(4, 5));
  A3D_ASSIGN(const JoinKeys keys, join_keys(check, types));
  if (check.count() == 5) A3D_TRY(check.type(4, "int"));
  return bound_hashjoin(types, {keys});
}

/// The differences between merge joins.
struct MergeVariant {
  const char* name;
  bool sorts;
  bool is_outer;
};

TypeMapping map_merge_join(MergeVariant variant) {
  return [variant](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(variant.name, arguments);
    MergeJoinParameters parameters{{}, {}, variant.is_outer, variant.name};
    A3D_ASSIGN(parameters.types, join_types(check));
    A3D_ASSIGN(parameters.keys, join_keys(check, parameters.types));
    return BoundOperator{TypeExpr::stream(parameters.types.joined),
                         [parameters, variant](std::vector<Datum> given, Context& context) -> Result<Datum> {
                           TupleStreamPtr left = given[0].tuples();
                           TupleStreamPtr right = given[1].tuples();
                           if (variant.sorts) {
                             A3D_ASSIGN(left, sorted(*left, ascending({parameters.keys.left}), context));
                             A3D_ASSIGN(right, sorted(*right, ascending({parameters.keys.right}), context));
                           }
                           return Datum{merge_join(std::move(left), std::move(right), parameters, context)};
                         }};
  };
}

constexpr std::string_view kLeft = "[const rel(tuple([A: int])) value ((1) (2) (undefined))] feed ";
constexpr std::string_view kRight = "[const rel(tuple([B: int])) value ((2) (3) (undefined))] feed ";
constexpr std::string_view kPairSignature = "(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)";

void register_hash_joins(algebra3d::OperatorGroup& group, const std::string& left, const std::string& right) {
  group.add({
      .name = "hashjoin",
      .syntax = "_ _ hashjoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams with equal, defined values of the two attributes.",
      .detail = "In the order of the first stream if the second one fits into the memory of `set \"memory\"`, else "
                "in an unspecified order. A bucket count as a third argument is accepted and ignored.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator([](auto arguments) { return map_hashjoin("hashjoin", arguments); }),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)",
                     "(stream(tuple) stream(tuple) NAME NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + right + "hashjoin[A, B] consume", "((2 2))"},
                         {left + right + "hashjoin[A, B, 97] count", "1"}},
      .query_errors = {{"query " + left + right + "extend[C: TRUE] hashjoin[A, C] count",
                        "hashjoin: expected attributes of one type, got int and bool"}},
  });
  group.add({
      .name = "itHashJoin",
      .syntax = "_ _ itHashJoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams with equal, defined values of the two attributes: another name of "
             "hashjoin.",
      .detail = "An int as a third argument is accepted and ignored.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator([](auto arguments) { return map_hashjoin("itHashJoin", arguments); }),
      .signatures = {std::string(kPairSignature), "(stream(tuple) stream(tuple) NAME NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{left + right + "itHashJoin[A, B] consume", "((2 2))"}},
      .query_errors = {{"query " + left + right + "extend[C: TRUE] itHashJoin[A, C] count",
                        "itHashJoin: expected attributes of one type, got int and bool"},
                       {"query " + left + left + "itHashJoin[A, A] count", "itHashJoin: duplicate attribute name 'A'"}},
  });
}

void register_merge_joins(algebra3d::OperatorGroup& group, const std::string& left, const std::string& right) {
  group.add({
      .name = "mergejoin",
      .syntax = "_ _ mergejoin[attribute, attribute]",
      .doc = "The pairs of tuples of two streams that are sorted by the two attributes, with equal, defined values of "
             "these.",
      .detail = "In the order of the keys. An error if a stream is not sorted, ascending.",
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_merge_join({"mergejoin", false, false})),
      .signatures = {std::string(kPairSignature)},
      .handles_undefined = true,
      .query_examples = {{left + "sortby[A] " + right + "sortby[B] mergejoin[A, B] consume", "((2 2))"}},
      .query_errors = {{"query " + left + right + "mergejoin[A, B] count",
                        "mergejoin: the first stream is not sorted by A; write `sortby[A]`, or use sortmergejoin"},
                       {"query " + left + right + "extend[C: TRUE] mergejoin[A, C] count",
                        "mergejoin: expected attributes of one type, got int and bool"}},
  });
  group.add({
      .name = "sortmergejoin",
      .syntax = "_ _ sortmergejoin[attribute, attribute]",
      .doc = "The pairs of tuples of two streams with equal, defined values of the two attributes, in their order.",
      .detail = "Both streams are sorted first.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_merge_join({"sortmergejoin", true, false})),
      .signatures = {std::string(kPairSignature)},
      .handles_undefined = true,
      .query_examples = {{left + right + "sortmergejoin[A, B] consume", "((2 2))"}},
      .query_errors = {{"query " + left + right + "extend[C: TRUE] sortmergejoin[A, C] count",
                        "sortmergejoin: expected attributes of one type, got int and bool"}},
  });
  group.add({
      .name = "smouterjoin",
      .syntax = "_ _ smouterjoin[attribute, attribute]",
      .doc = "The full outer join: the pairs with equal, defined values of the two attributes, and every tuple without "
             "a partner, padded with undefined values.",
      .detail = "In the order of the keys; both streams are sorted first.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_merge_join({"smouterjoin", true, true})),
      .signatures = {std::string(kPairSignature)},
      .handles_undefined = true,
      .query_examples = {{left + right + "smouterjoin[A, B] consume",
                          "((undefined undefined) (undefined undefined) (1 undefined) (2 2) (undefined 3))"}},
      .query_errors = {{"query " + left + right + "extend[C: TRUE] smouterjoin[A, C] count",
                        "smouterjoin: expected attributes of one type, got int and bool"}},
  });
}

}  // namespace

void register_equi_joins(algebra3d::OperatorGroup& group) {
  const std::string left(kLeft);
  const std::string right(kRight);
  register_hash_joins(group, left, right);
  register_merge_joins(group, left, right);
}

}  // namespace queries
