// intstream, realstream, transformstream and its relatives: streams of values and how they become tuples.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Result<Plan> map_intstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("intstream", arguments);
  RETURN_IF_ERROR(check.type(0, "int"));
  RETURN_IF_ERROR(check.type(1, "int"));
  return Plan{TypeExpr::stream("int"), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                const Value& first = given[0].value();
                const Value& last = given[1].value();
                const bool is_empty = !first.is_defined() || !last.is_defined();
                std::int64_t next = is_empty ? 1 : first.get<std::int64_t>();
                std::int64_t end = is_empty ? 0 : last.get<std::int64_t>();
                return Datum{make_value_stream([next, end, &context]() mutable -> Result<std::optional<Value>> {
                  if (next > end) return std::optional<Value>();
                  if (next % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
                  const Value value = Value::of(next);
                  // After the largest int comes nothing: an empty range.
                  if (next < end)
                    ++next;
                  else
                    end = std::numeric_limits<std::int64_t>::min();
                  return std::optional(value);
                })};
              }};
}

// Every element is computed anew, so that rounding does not add up.
Result<Plan> map_realstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("realstream", arguments);
  std::array<Conversion, 3> to_reals{};
  for (std::size_t place = 0; place < 3; ++place) {
    ASSIGN_OR_RETURN(to_reals[place], check.conversion(place, TypeExpr("real")));
  }
  return Plan{TypeExpr::stream("real"), [to_reals](std::vector<Datum> given, Context& context) -> Result<Datum> {
                const auto is_defined = [](const Datum& datum) { return datum.value().is_defined(); };
                const bool is_empty = !std::ranges::all_of(given, is_defined);
                const auto number = [&](std::size_t place) {
                  return converted(given[place].value(), to_reals[place]).get<double>();
                };
                const double first = is_empty ? 0 : number(0);
                const double last = is_empty ? 0 : number(1);
                const double step = is_empty ? 0 : number(2);
                if (!is_empty && step == 0)
                  context.diagnostics.report("realstream: the step is 0, so there is no element");
                return Datum{make_value_stream(
                    [=, &context, count = std::uint64_t{0}]() mutable -> Result<std::optional<Value>> {
                      // Rounded once; the product alone may be beyond the range of doubles.
                      const double next = std::fma(static_cast<double>(count), step, first);
                      const bool is_over = step > 0 ? next > last : step < 0 ? next < last : true;
                      if (is_over || !std::isfinite(next)) return std::optional<Value>();
                      if (++count % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
                      return std::optional(Value::of<double>(next));
                    })};
              }};
}

Datum values_as_tuples(const ValueStreamPtr& values) {
  return Datum{make_stream([values]() -> Result<TuplePtr> {
    ASSIGN_OR_RETURN(auto value, values->next());
    if (!value) return TuplePtr();
    return TuplePtr(std::make_shared<const Tuple>(Tuple{{std::move(*value)}}));
  })};
}

Datum tuples_as_values(const TupleStreamPtr& tuples, std::size_t attribute) {
  return Datum{make_value_stream([tuples, attribute]() -> Result<std::optional<Value>> {
    ASSIGN_OR_RETURN(const TuplePtr tuple, tuples->next());
    return tuple == nullptr ? std::optional<Value>() : std::optional(tuple->attributes[attribute]);
  })};
}

Result<Plan> map_transformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("transformstream", arguments);
  const TypeExpr& type = check[0].type;
  if (type.is_tuple_stream() && type.element().attributes().size() == 1)
    return Plan{
        TypeExpr::stream(type.element().attributes()[0].type),
        [](std::vector<Datum> given, Context&) -> Result<Datum> { return tuples_as_values(given[0].tuples(), 0); }};
  if (!type.is_stream() || type.is_tuple_stream())
    return check.expected("a stream of values, or of tuples with one attribute", type);
  return Plan{TypeExpr::stream(TypeExpr::tuple({{"Elem", type.element()}})),
              [](std::vector<Datum> given, Context&) -> Result<Datum> { return values_as_tuples(given[0].values()); }};
}

Result<Plan> map_namedtransformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("namedtransformstream", arguments);
  const TypeExpr& type = check[0].type;
  if (!type.is_stream() || !is_value_type(type.element())) return check.expected("a stream of values", type);
  return Plan{TypeExpr::stream(TypeExpr::tuple({{check[1].names[0], type.element()}})),
              [](std::vector<Datum> given, Context&) -> Result<Datum> { return values_as_tuples(given[0].values()); }};
}

Result<Plan> map_projecttransformstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("projecttransformstream", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t attribute, check.attribute(1, tuple));
  return Plan{TypeExpr::stream(tuple.attributes()[attribute].type),
              [attribute](std::vector<Datum> given, Context&) -> Result<Datum> {
                return tuples_as_values(given[0].tuples(), attribute);
              }};
}

}  // namespace

void register_elements(algebra3d::Registry& registry) {
  registry.add({
      .name = "intstream",
      .syntax = "intstream(_, _)",
      .doc = "The ints from the first to the last, both included; none if the first is larger or one is undefined.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_intstream),
      .signatures = {"(int int) -> stream(int)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 5) count", "5"},
                   {"intstream(2, 1) count", "0"},
                   {"intstream([const int value undefined], 1) count", "0"}},
      .errors = {{"query intstream(1, 2.5) count", "intstream: expected int, got real"}},
  });
  registry.add({
      .name = "realstream",
      .syntax = "realstream(_, _, _)",
      .doc = "The reals from the first to the second number, in steps of the third; downwards if that is negative.",
      .detail =
          "Element i is the first number plus i times the step, so rounding does not add up. No element for a step of "
          "0 or an undefined argument.",
      .exactness = algebra3d::Exactness::rounded_once,
      .stream = stream_operator(map_realstream),
      .signatures = {"(real real real) -> stream(real)"},
      .handles_undefined = true,
      .examples = {{"realstream(0.0, 1.0, 0.25) collect_vector", "(0.0 0.25 0.5 0.75 1.0)"},
                   {"realstream(0.0, 1.000001, 0.1) count", "11"},
                   {"realstream(1, -1, -0.5) count", "5"},
                   {"realstream(1.0, 2.0, 0.0) count", "0"},
                   {"realstream(1.0, [const real value undefined], 1.0) count", "0"}},
      .errors = {{"query realstream(1.0, 2.0, TRUE) count", "realstream: expected real, got bool"},
                 {"query realstream(1.0, 2.0) count", "realstream: expected 3 arguments, got 2"}},
  });
  registry.add({
      .name = "transformstream",
      .syntax = "_ transformstream",
      .doc = "A stream of values as tuples with the single attribute Elem, or such tuples as a stream of their values.",
      .stream = stream_operator(map_transformstream),
      .signatures = {"(stream(DATA)) -> stream(tuple((Elem DATA)))", "(stream(tuple((NAME DATA)))) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) transformstream consume", "((1) (2))"},
                   {"[const rel(tuple([A: int])) value ((7))] feed transformstream transformstream consume", "((7))"},
                   {"[const int value undefined] feed transformstream consume", "((undefined))"}},
      .errors = {{"query 5 transformstream",
                  "transformstream: expected a stream of values, or of tuples with one attribute, got int"}},
  });
  registry.add({
      .name = "namedtransformstream",
      .syntax = "_ namedtransformstream[name]",
      .doc = "A stream of values as tuples with a single attribute of that name.",
      .stream = stream_operator(map_namedtransformstream),
      .signatures = {"(stream(DATA) NAME) -> stream(tuple((NAME DATA)))"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 2) namedtransformstream[No] filter[.No > 1] consume", "((2))"},
                   {"[const int value undefined] feed namedtransformstream[No] consume", "((undefined))"}},
      .errors = {{"query 5 namedtransformstream[No]", "namedtransformstream: expected a stream of values, got int"},
                 {"query intstream(1, 2) transformstream namedtransformstream[No] count",
                  "namedtransformstream: expected a stream of values, got (stream (tuple"}},
  });
  registry.add({
      .name = "projecttransformstream",
      .syntax = "_ projecttransformstream[attribute]",
      .doc = "The stream of the values of an attribute.",
      .stream = stream_operator(map_projecttransformstream),
      .signatures = {"(stream(tuple) NAME) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 3) transformstream extend[B: .Elem * 2] projecttransformstream[B] collect_vector",
                    "(2 4 6)"},
                   {"[const rel(tuple([A: int])) value ((1) (undefined))] feed projecttransformstream[A] count", "2"}},
      .errors = {{"query intstream(1, 3) transformstream projecttransformstream[B] count",
                  "projecttransformstream: unknown attribute 'B'"},
                 {"query intstream(1, 3) projecttransformstream[B] count",
                  "projecttransformstream: expected a stream of tuples (write `transformstream`"}},
  });
}

}  // namespace queries
