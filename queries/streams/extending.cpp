// extend, projectextend, replaceAttr, addcounter: attributes that functions make.
#include <limits>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/changed_tuples.h"
#include "queries/streams/detail/column_streams.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

/// Makes tuples by the functions at `place`. Those that no source names make the last attributes.
BoundOperator making(const TypeExpr& result, AttributeSources sources, std::size_t place) {
  for (std::size_t made = 0; sources.size() < result.attributes().size(); ++made) sources.push_back({true, made});
  return {TypeExpr::stream(result),
          [sources, place](std::vector<Datum> given, Context&) -> Result<Datum> {
            return Datum{made_tuples(given[0].tuples(), sources, given[place].list())};
          },
          MakesTuples{sources}};
}

Result<BoundOperator> map_extend(std::span<const ArgumentType> arguments) {
  const MappingCheck check("extend", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const TypeExpr result, check.extended(tuple, 1, tuple));
  AttributeSources sources;
  for (std::size_t index = 0; index < tuple.attributes().size(); ++index) sources.push_back({false, index});
  return making(result, std::move(sources), 1);
}

Result<BoundOperator> map_projectextend(std::span<const ArgumentType> arguments) {
  const MappingCheck check("projectextend", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto indices, check.distinct_or_no_attributes(1, tuple));
  A3D_ASSIGN(const TypeExpr result, check.extended(projected(tuple, indices), 2, tuple));
  AttributeSources sources;
  for (const std::size_t index : indices) sources.push_back({false, index});
  return making(result, std::move(sources), 2);
}

Result<BoundOperator> map_replace(std::span<const ArgumentType> arguments) {
  const MappingCheck check("replaceAttr", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto replaced, check.distinct_attributes(1, tuple));
  A3D_ASSIGN(const TypeExpr made, check.extended(TypeExpr::tuple({}), 1, tuple));
  std::vector<TypeExpr::Attribute> attributes = tuple.attributes();
  for (std::size_t i = 0; i < replaced.size(); ++i) attributes[replaced[i]].type = made.attributes()[i].type;
  AttributeSources sources;
  for (std::size_t index = 0; index < attributes.size(); ++index) sources.push_back({false, index});
  for (std::size_t i = 0; i < replaced.size(); ++i) sources[replaced[i]] = {true, i};
  return making(TypeExpr::tuple(std::move(attributes)), std::move(sources), 1);
}

/// Counts to the largest int; later numbers are undefined.
class Counter {
 public:
  /// Without a start every number is undefined.
  explicit Counter(std::optional<std::int64_t> start) : next_(start) {}
  Value take(Context& context) {
    if (!next_) return Value(algebra3d::TypeOf<std::int64_t>::type());
    if (is_used_up_) {
      context.diagnostics.report_undefined("addcounter: the counter is beyond the range of ints");
      return Value(algebra3d::TypeOf<std::int64_t>::type());
    }
    Value value = Value::of(*next_);
    is_used_up_ = __builtin_add_overflow(*next_, 1, &*next_);
    return value;
  }

 private:
  std::optional<std::int64_t> next_;
  bool is_used_up_ = false;
};

Result<BoundOperator> map_addcounter(std::span<const ArgumentType> arguments) {
  const MappingCheck check("addcounter", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_TRY(check.argument_count(2, 3));
  if (check.count() == 3) A3D_TRY(check.type(2, "int"));
  A3D_ASSIGN(const TypeExpr result, check.concatenated(tuple, TypeExpr::tuple({{check[1].names[0], TypeExpr("int")}})));
  return BoundOperator{TypeExpr::stream(result), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         const bool is_started = given.size() < 3 || given[2].value().is_defined();
                         if (!is_started) context.diagnostics.report_undefined("addcounter: the start is undefined");
                         std::optional<std::int64_t> start;
                         if (is_started) start = given.size() < 3 ? 1 : given[2].value().get<std::int64_t>();
                         return changed_tuples(given[0].tuples(),
                                               [&context, counter = Counter(start)](const TuplePtr& from,
                                                                                    std::vector<Value>& to) mutable {
                                                 to = extended_attributes(*from, 1);
                                                 to.push_back(counter.take(context));
                                                 return Status();
                                               });
                       }};
}

}  // namespace

void register_extending(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "extend",
      .syntax = "_ extend[functions(TUPLE)]",
      .doc = "The tuples with new attributes appended; all functions see the input tuple only.",
      .stream = stream_operator(map_extend),
      .signatures = {"(stream(tuple) ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream extend[B: .Elem * 2, C: TRUE] consume",
                          "((1 2 TRUE) (2 4 TRUE))"},
                         {"intstream(1, 1) transformstream extend[B: [const int value undefined]] consume",
                          "((1 undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream extend[Elem: 1] count",
                        "extend: duplicate attribute name 'Elem'"}},
  });
  group.add({
      .name = "projectextend",
      .syntax = "_ projectextend[attributes; functions(TUPLE)]",
      .doc =
          "The tuples with the named attributes, and new ones appended; a new name may be that of a dropped attribute.",
      .stream = stream_operator(map_projectextend),
      .signatures = {"(stream(tuple) NAMES ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples =
          {{"intstream(1, 2) transformstream projectextend[; Elem: .Elem + 1] consume", "((2) (3))"},
           {"intstream(1, 1) transformstream projectextend[Elem; B: [const real value undefined]] consume",
            "((1 undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream projectextend[Elem; Elem: 1] count",
                        "projectextend: duplicate attribute name 'Elem'"}},
  });
  group.add({
      .name = "replaceAttr",
      .syntax = "_ replaceAttr[functions(TUPLE)]",
      .doc = "The tuples with new values of some attributes, possibly of other types, at their old positions.",
      .detail = "All functions see the old tuple.",
      .stream = stream_operator(map_replace),
      .signatures = {"(stream(tuple) ((NAME (map tuple DATA)) ...)) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples =
          {{"intstream(1, 2) transformstream extend[B: 7] replaceAttr[Elem: .Elem / 2] consume", "((0.5 7) (1.0 7))"},
           {"intstream(1, 1) transformstream extend[B: 7] replaceAttr[Elem: .B, B: .Elem] consume", "((7 1))"},
           {"intstream(1, 1) transformstream replaceAttr[Elem: [const int value undefined]] consume", "((undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream replaceAttr[Elm: 1] count",
                        "replaceAttr: unknown attribute 'Elm', did you mean 'Elem'?"},
                       {"query intstream(1, 2) transformstream replaceAttr[Elem: intstream(1, 2)] count",
                        "replaceAttr: expected a value for the attribute 'Elem', got (stream int)"}},
  });
  group.add({
      .name = "addcounter",
      .syntax = "_ addcounter[name ...]",
      .doc = "The tuples with a new attribute that counts them, from the start on; from 1 if no start is given.",
      .detail = "Undefined for every tuple if the start is.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_addcounter),
      .signatures = {"(stream(tuple) NAME int) -> stream(tuple)", "(stream(tuple) NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(7, 9) transformstream addcounter[No, 0] consume", "((7 0) (8 1) (9 2))"},
                         {"intstream(7, 8) transformstream addcounter[No] consume", "((7 1) (8 2))"},
                         {"intstream(7, 7) transformstream addcounter[No, [const int value undefined]] consume",
                          "((7 undefined))"}},
      .query_errors = {{"query intstream(1, 2) transformstream addcounter[Elem, 1] count",
                        "addcounter: duplicate attribute name 'Elem'"},
                       {"query intstream(1, 2) transformstream addcounter[No, 1.5] count",
                        "addcounter: expected int, got real"}},
  });
}

}  // namespace queries
