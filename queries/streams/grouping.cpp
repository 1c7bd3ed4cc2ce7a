// groupby: what functions make of runs of tuples with equal keys.
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/adjacent_groups.h"
#include "queries/streams/detail/hash_groups.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

RelationPtr group_relation(const TypeExpr& tuple, TupleBuffer tuples) {
  return std::make_shared<MemoryRelation>(tuple, std::move(tuples));
}

/// `sortby groupby` in one.
BoundOperator hashed_grouping(const TypeExpr& tuple, const TypeExpr& result, HashGrouping grouping) {
  UsesAttributes uses{grouping.keys};
  for (const auto& attribute : result.attributes())
    grouping.result_types.push_back(&undefined_of(attribute.type).type());
  for (const GroupAggregate& each : grouping.aggregates)
    if (each.call) uses.indices.push_back(each.attribute);
  return {TypeExpr::stream(result),
          [tuple, grouping = std::move(grouping)](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
            A3D_ASSIGN(TupleStreamPtr stream,
                       hashed_groups(*given[0].tuples(), tuple, grouping, given[2].list(), context));
            return Datum{std::move(stream)};
          },
          std::move(uses), "by a hash table"};
}

Result<BoundOperator> map_groupby(std::span<const ArgumentType> arguments) {
  const MappingCheck check("groupby", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto keys, check.distinct_or_no_attributes(1, tuple));
  A3D_ASSIGN(const TypeExpr result, check.extended(projected(tuple, keys), 2, TypeExpr::rel(tuple)));
  return BoundOperator{
      TypeExpr::stream(result),
      [tuple, keys](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return Datum{make_stream([groups = AdjacentGroups(given[0].tuples(), keys), functions = given[2].list(), tuple,
                                  &context]() mutable -> Result<TuplePtr> {
          A3D_ASSIGN(auto group, groups.next(context));
          if (!group) return TuplePtr();
          Tuple row{std::move(group->keys)};
          A3D_TRY(append_results(functions, Datum{group_relation(tuple, std::move(group->tuples))}, row.attributes));
          return TuplePtr(std::make_shared<const Tuple>(std::move(row)));
        })};
      },
      GroupsTuples{keys, [tuple, keys, result](std::vector<SortKey> order, std::vector<GroupAggregate> aggregates) {
                     return hashed_grouping(tuple, result, {keys, std::move(order), std::move(aggregates), {}});
                   }}};
}

}  // namespace

void register_grouping(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "groupby",
      .syntax = "_ groupby[attributes; functions(GROUP)]",
      .doc = "One tuple per run of adjacent tuples with equal keys: the keys, then the results of the functions on the "
             "group.",
      .detail = "`group` is the relation of the run. Sort first. Without keys all tuples are one group.",
      .stream = stream_operator(map_groupby),
      .signatures = {"(stream(tuple) NAMES ((NAME (map rel(tuple) DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples =
          {{"intstream(1, 5) transformstream extend[K: .Elem div 3] groupby[K; N: group count] consume",
            "((0 2) (1 3))"},
           {"intstream(1, 5) transformstream groupby[; S: group feed sum[Elem]] consume", "((15))"},
           {"[const rel(tuple([A: int])) value ((undefined) (undefined))] feed groupby[A; N: group count] consume",
            "((undefined 2))"}},
      .query_errors = {{"query intstream(1, 5) transformstream groupby[K; N: group count] count",
                        "groupby: unknown attribute 'K'"}},
  });
}

}  // namespace queries
