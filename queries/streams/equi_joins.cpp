// hashjoin, itHashJoin, mergejoin, sortmergejoin, smouterjoin: pairs of tuples with equal keys.
#include "queries/streams/all.h"
#include "queries/streams/hash_join.h"
#include "queries/streams/merge_join.h"

namespace queries {
namespace {

// hashjoin and itHashJoin are two names of one operator: the original's differ in what they do when memory is short.
Result<Plan> map_hashjoin(const char* op, std::span<const ArgumentType> arguments) {
  const MappingCheck check(op, arguments);
  ASSIGN_OR_RETURN(const JoinTypes types, join_types(check));
  RETURN_IF_ERROR(check.argument_count(4, 5));
  ASSIGN_OR_RETURN(const JoinKeys keys, join_keys(check, types));
  if (check.count() == 5) RETURN_IF_ERROR(check.type(4, "int"));
  return Plan{TypeExpr::stream(types.joined), [keys](std::vector<Datum> given, Context& context) -> Result<Datum> {
                return Datum{TupleStreamPtr(
                    std::make_shared<HashJoin>(given[0].tuples(), given[1].tuples(), keys.left, keys.right, context))};
              }};
}

/// What makes one merge join differ from another.
struct MergeVariant {
  const char* name;
  bool sorts;
  bool is_outer;
};

TypeMapping map_merge_join(MergeVariant variant) {
  return [variant](std::span<const ArgumentType> arguments) -> Result<Plan> {
    const MappingCheck check(variant.name, arguments);
    MergeJoinPlan plan{{}, {}, variant.is_outer, variant.name};
    ASSIGN_OR_RETURN(plan.types, join_types(check));
    ASSIGN_OR_RETURN(plan.keys, join_keys(check, plan.types));
    return Plan{TypeExpr::stream(plan.types.joined),
                [plan, variant](std::vector<Datum> given, Context& context) -> Result<Datum> {
                  TupleStreamPtr left = given[0].tuples();
                  TupleStreamPtr right = given[1].tuples();
                  if (variant.sorts) {
                    ASSIGN_OR_RETURN(left, sorted(*left, ascending({plan.keys.left}), context));
                    ASSIGN_OR_RETURN(right, sorted(*right, ascending({plan.keys.right}), context));
                  }
                  return Datum{merge_join(std::move(left), std::move(right), plan, context)};
                }};
  };
}

constexpr std::string_view kLeft = "[const rel(tuple([A: int])) value ((1) (2) (undefined))] feed ";
constexpr std::string_view kRight = "[const rel(tuple([B: int])) value ((2) (3) (undefined))] feed ";
constexpr std::string_view kPairSignature = "(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)";

void register_hash_joins(algebra3d::Registry& registry, const std::string& left, const std::string& right) {
  registry.add({
      .name = "hashjoin",
      .syntax = "_ _ hashjoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams with equal, defined values of the two attributes.",
      .detail = "In the order of the first stream if the second one fits into the memory of `set \"memory\"`, else in "
                "no particular order. A bucket count as a third argument is accepted and not needed.",
      .stream = stream_operator([](auto arguments) { return map_hashjoin("hashjoin", arguments); }),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)",
                     "(stream(tuple) stream(tuple) NAME NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{left + right + "hashjoin[A, B] consume", "((2 2))"},
                   {left + right + "hashjoin[A, B, 97] count", "1"}},
      .errors = {{"query " + left + right + "extend[C: TRUE] hashjoin[A, C] count",
                  "hashjoin: expected attributes of one type, got int and bool"}},
  });
  registry.add({
      .name = "itHashJoin",
      .syntax = "_ _ itHashJoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams with equal, defined values of the two attributes: another name of "
             "hashjoin.",
      .detail = "An int as a third argument is accepted and not needed.",
      .stream = stream_operator([](auto arguments) { return map_hashjoin("itHashJoin", arguments); }),
      .signatures = {std::string(kPairSignature), "(stream(tuple) stream(tuple) NAME NAME int) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{left + right + "itHashJoin[A, B] consume", "((2 2))"}},
      .errors = {{"query " + left + right + "extend[C: TRUE] itHashJoin[A, C] count",
                  "itHashJoin: expected attributes of one type, got int and bool"},
                 {"query " + left + left + "itHashJoin[A, A] count",
                  "itHashJoin: the attribute 'A' would stand twice"}},
  });
}

void register_merge_joins(algebra3d::Registry& registry, const std::string& left, const std::string& right) {
  registry.add({
      .name = "mergejoin",
      .syntax = "_ _ mergejoin[attribute, attribute]",
      .doc = "The pairs of tuples of two streams that are sorted by the two attributes, with equal, defined values of "
             "these.",
      .detail = "In the order of the keys. An error if a stream is not sorted, ascending.",
      .stream = stream_operator(map_merge_join({"mergejoin", false, false})),
      .signatures = {std::string(kPairSignature)},
      .handles_undefined = true,
      .examples = {{left + "sortby[A] " + right + "sortby[B] mergejoin[A, B] consume", "((2 2))"}},
      .errors = {{"query " + left + right + "mergejoin[A, B] count",
                  "mergejoin: the first stream is not sorted by A; write `sortby[A]`, or use sortmergejoin"},
                 {"query " + left + right + "extend[C: TRUE] mergejoin[A, C] count",
                  "mergejoin: expected attributes of one type, got int and bool"}},
  });
  registry.add({
      .name = "sortmergejoin",
      .syntax = "_ _ sortmergejoin[attribute, attribute]",
      .doc = "The pairs of tuples of two streams with equal, defined values of the two attributes, in their order.",
      .detail = "Both streams are sorted first.",
      .stream = stream_operator(map_merge_join({"sortmergejoin", true, false})),
      .signatures = {std::string(kPairSignature)},
      .handles_undefined = true,
      .examples = {{left + right + "sortmergejoin[A, B] consume", "((2 2))"}},
      .errors = {{"query " + left + right + "extend[C: TRUE] sortmergejoin[A, C] count",
                  "sortmergejoin: expected attributes of one type, got int and bool"}},
  });
  registry.add({
      .name = "smouterjoin",
      .syntax = "_ _ smouterjoin[attribute, attribute]",
      .doc =
          "The full outer join: the pairs with equal, defined values of the two attributes, and every tuple without a "
          "partner beside undefined values.",
      .detail = "In the order of the keys; both streams are sorted first.",
      .stream = stream_operator(map_merge_join({"smouterjoin", true, true})),
      .signatures = {std::string(kPairSignature)},
      .handles_undefined = true,
      .examples = {{left + right + "smouterjoin[A, B] consume",
                    "((undefined undefined) (undefined undefined) (1 undefined) (2 2) (undefined 3))"}},
      .errors = {{"query " + left + right + "extend[C: TRUE] smouterjoin[A, C] count",
                  "smouterjoin: expected attributes of one type, got int and bool"}},
  });
}

}  // namespace

void register_equi_joins(algebra3d::Registry& registry) {
  const std::string left(kLeft);
  const std::string right(kRight);
  register_hash_joins(registry, left, right);
  register_merge_joins(registry, left, right);
}

}  // namespace queries
