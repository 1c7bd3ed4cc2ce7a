// transformstream and its relatives: how streams of values become tuples, and tuples values.
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Datum values_as_tuples(const ValueStreamPtr& values) {
  return Datum{make_stream([values]() -> Result<TuplePtr> {
    A3D_ASSIGN(auto value, values->next());
    if (!value) return TuplePtr();
    return TuplePtr(std::make_shared<const Tuple>(Tuple{{std::move(*value)}}));
  })};
}

Datum tuples_as_values(const TupleStreamPtr& tuples, std::size_t attribute) {
  return Datum{make_value_stream([tuples, attribute]() -> Result<std::optional<Value>> {
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    return tuple == nullptr ? std::optional<Value>() : std::optional(tuple->attributes[attribute]);
  })};
}

Result<BoundOperator> map_transformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("transformstream", arguments);
  const TypeExpr& type = check[0].type;
  if (type.is_tuple_stream() && type.element().attributes().size() == 1)
    return BoundOperator{
        TypeExpr::stream(type.element().attributes()[0].type),
        [](std::vector<Datum> given, Context&) -> Result<Datum> { return tuples_as_values(given[0].tuples(), 0); }};
  if (!type.is_stream() || type.is_tuple_stream())
    return check.expected("a stream of values, or of tuples with one attribute", type);
  return BoundOperator{
      TypeExpr::stream(TypeExpr::tuple({{"Elem", type.element()}})),
      [](std::vector<Datum> given, Context&) -> Result<Datum> { return values_as_tuples(given[0].values()); }};
}

Result<BoundOperator> map_namedtransformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("namedtransformstream", arguments);
  const TypeExpr& type = check[0].type;
  if (!type.is_stream() || !is_value_type(type.element())) return check.expected("a stream of values", type);
  return BoundOperator{
      TypeExpr::stream(TypeExpr::tuple({{check[1].names[0], type.element()}})),
      [](std::vector<Datum> given, Context&) -> Result<Datum> { return values_as_tuples(given[0].values()); }};
}

Result<BoundOperator> map_projecttransformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("projecttransformstream", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t attribute, check.attribute(1, tuple));
  return BoundOperator{TypeExpr::stream(tuple.attributes()[attribute].type),
                       [attribute](std::vector<Datum> given, Context&) -> Result<Datum> {
                         return tuples_as_values(given[0].tuples(), attribute);
                       }};
}

}  // namespace

void register_elements(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "transformstream",
      .syntax = "_ transformstream",
      .doc = "A stream of values as tuples with the single attribute Elem, or such tuples as a stream of their values.",
      .stream = stream_operator(map_transformstream),
      .signatures = {"(stream(DATA)) -> stream(tuple((Elem DATA)))", "(stream(tuple((NAME DATA)))) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream consume", "((1) (2))"},
                         {"[const rel(tuple([A: int])) value ((7))] feed transformstream transformstream consume",
                          "((7))"},
                         {"[const int value undefined] feed transformstream consume", "((undefined))"}},
      .query_errors = {{"query 5 transformstream",
                        "transformstream: expected a stream of values, or of tuples with one attribute, got int"}},
  });
  group.add({
      .name = "namedtransformstream",
      .syntax = "_ namedtransformstream[name]",
      .doc = "A stream of values as tuples with a single attribute of that name.",
      .stream = stream_operator(map_namedtransformstream),
      .signatures = {"(stream(DATA) NAME) -> stream(tuple((NAME DATA)))"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) namedtransformstream[No] filter[.No > 1] consume", "((2))"},
                         {"[const int value undefined] feed namedtransformstream[No] consume", "((undefined))"}},
      .query_errors = {{"query 5 namedtransformstream[No]",
                        "namedtransformstream: expected a stream of values, got int"},
                       {"query intstream(1, 2) transformstream namedtransformstream[No] count",
                        "namedtransformstream: expected a stream of values, got (stream (tuple"}},
  });
  group.add({
      .name = "projecttransformstream",
      .syntax = "_ projecttransformstream[attribute]",
      .doc = "The stream of the values of an attribute.",
      .stream = stream_operator(map_projecttransformstream),
      .signatures = {"(stream(tuple) NAME) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples =
          {{"intstream(1, 3) transformstream extend[B: .Elem * 2] projecttransformstream[B] collect_vector", "(2 4 6)"},
           {"[const rel(tuple([A: int])) value ((1) (undefined))] feed projecttransformstream[A] count", "2"}},
      .query_errors = {{"query intstream(1, 3) transformstream projecttransformstream[B] count",
                        "projecttransformstream: unknown attribute 'B'"},
                       {"query intstream(1, 3) projecttransformstream[B] count",
                        "projecttransformstream: expected a stream of tuples (write `transformstream`"}},
  });
}

}  // namespace queries
