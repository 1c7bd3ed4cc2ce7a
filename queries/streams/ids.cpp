// tupleid, addid, gettuples: the numbers of tuples within their relation.
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/tuple_number.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/changed_tuples.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

Value id_of_tuple(const Tuple& tuple, std::string_view op, Context& context) {
  if (tuple.id != 0) return id_value(tuple.id);
  context.diagnostics.report_undefined(std::string(op) + ": the tuple does not come straight from a stored relation");
  return Value(algebra3d::TypeOf<algebra3d::TupleNumber>::type());
}

Result<BoundOperator> map_tupleid(std::span<const ArgumentType> arguments) {
  const MappingCheck check("tupleid", arguments);
  if (!check[0].type.is_tuple()) return check.expected("a tuple", check[0].type);
  return BoundOperator{"tid", [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return Datum{id_of_tuple(*given[0].tuple(), "tupleid", context)};
                       }};
}

Result<BoundOperator> map_addid(std::span<const ArgumentType> arguments) {
  const MappingCheck check("addid", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const TypeExpr result, check.with_id(tuple));
  return BoundOperator{TypeExpr::stream(result), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return changed_tuples(given[0].tuples(),
                                               [&context](const TuplePtr& from, std::vector<Value>& to) {
                                                 to = from->attributes;
                                                 to.push_back(id_of_tuple(*from, "addid", context));
                                                 return Status();
                                               });
                       }};
}

Result<BoundOperator> map_gettuples(std::span<const ArgumentType> arguments) {
  const MappingCheck check("gettuples", arguments);
  A3D_ASSIGN(const TypeExpr ids, check.stream(0));
  A3D_ASSIGN(const TypeExpr tuple, check.relation(1));
  A3D_ASSIGN(const std::size_t id, check.id_attribute(ids));
  std::vector<std::size_t> kept;
  for (std::size_t index = 0; index < ids.attributes().size(); ++index)
    if (index != id) kept.push_back(index);
  A3D_ASSIGN(const TypeExpr result, check.concatenated(projected(ids, kept), tuple));
  return BoundOperator{TypeExpr::stream(result),
                       [id, kept](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return Datum{make_stream([id, kept, tuples = given[0].tuples(), relation = given[1].relation(),
                                                   &context, step = 0U]() mutable -> Result<TuplePtr> {
                           while (true) {
                             if (++step % 1024 == 0) A3D_TRY(context.check_cancelled());
                             A3D_ASSIGN(const TuplePtr next, tuples->next());
                             if (next == nullptr) return TuplePtr();
                             if (!next->attributes[id].is_defined()) continue;
                             A3D_ASSIGN(const TuplePtr found, relation->fetch(id_of(next->attributes[id])));
                             if (found == nullptr || kept.empty()) {
                               if (found != nullptr) return found;
                               continue;
                             }
                             Tuple left;
                             A3D_TRY(append_attributes(*next, kept, left.attributes));
                             return concatenated(left, *found);
                           }
                         })};
                       }};
}

}  // namespace

void register_ids(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "tupleid",
      .syntax = "tupleid(_)",
      .doc = "The id of a tuple within its stored relation.",
      .detail = "Undefined for a tuple that does not come straight from a stored relation, such as a result of extend, "
                "project or a join.",
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::constant,
      .stream = stream_operator(map_tupleid),
      .signatures = {"(tuple) -> tid"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed projectextend[No; Id: tupleid(.)] consume", "((1 1) (2 2) (3 3))"},
                         {"intstream(7, 7) transformstream extend[Id: tupleid(.)] consume", "((7 undefined))"}},
      .query_errors = {{"query tupleid(5)", "tupleid: expected a tuple, got int"}},
  });
  group.add({
      .name = "addid",
      .syntax = "_ addid",
      .doc = "The tuples of a stored relation with their ids as an attribute TID.",
      .detail = "Undefined for a tuple that does not come straight from a stored relation.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_addid),
      .signatures = {"(stream(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"Boxes feed filter[.No > 1] addid project[No, TID] consume", "((2 2) (3 3))"},
                         {"intstream(7, 7) transformstream addid consume", "((7 undefined))"}},
      .query_errors = {{"query Boxes feed addid addid count", "addid: duplicate attribute name 'TID'"},
                       {"query Boxes addid count",
                        "addid: expected a stream of tuples (write `feed` after the relation)"}},
  });
  group.add({
      .name = "gettuples",
      .syntax = "_ _ gettuples",
      .doc = "The tuples of a relation with the ids in the attribute of type tid of a stream.",
      .detail =
          "Other attributes of the stream come before those of the relation. Ids that are undefined or not in the "
          "relation are left out.",
      .stream = stream_operator(map_gettuples),
      .signatures = {"(stream(tuple) rel(tuple)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples =
          {{"Boxes_B windowintersectsS[rectangle3(0, 2, 0, 2, 0, 2)] Boxes gettuples project[No] consume", "((1))"},
           {"[const rel(tuple([Id: tid])) value ((3) (undefined) (77) (1))] feed Boxes gettuples project[No] "
            "consume",
            "((3) (1))"}},
      .query_errors =
          {{"query intstream(1, 2) transformstream Boxes gettuples count",
            "gettuples: expected tuples with one attribute of type tid (see addid and tupleid), got (tuple"},
           {"query Boxes feed addid Boxes gettuples count", "gettuples: duplicate attribute name 'No'"}},
  });
}

}  // namespace queries
