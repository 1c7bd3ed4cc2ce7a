// extendstream, projectextendstream: one tuple per element of a stream that a function gives.
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/changed_tuples.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

/// `kept` with the attribute whose elements the only function at `position` gives.
Result<TypeExpr> streamed(const MappingCheck& check, const TypeExpr& tuple, const TypeExpr& kept,
                          std::size_t position) {
  const ArgumentType& argument = check[position];
  if (argument.names.size() != 1)
    return check.error(fmt::format("expected one new attribute, got {}", argument.names.size()));
  A3D_TRY(check.takes(argument.types[0], {tuple}));
  const TypeExpr& result = argument.types[0].function_result();
  if (!result.is_stream() || !is_value_type(result.element()))
    return check.expected("a stream of values for the attribute '" + argument.names[0] + "'", result);
  return check.concatenated(kept, TypeExpr::tuple({{argument.names[0], result.element()}}));
}

/// For each tuple its attributes `kept` beside each element of the function's stream for it.
Datum extended_stream(const TupleStreamPtr& tuples, const std::vector<std::size_t>& kept, const DatumList& functions,
                      const Context& context) {
  return Datum{make_stream([tuples, kept, function = functions[0].function_ptr(), &context, current = TuplePtr(),
                            elements = ValueStreamPtr(), step = 0U]() mutable -> Result<TuplePtr> {
    while (true) {
      if (++step % 1024 == 0) A3D_TRY(context.check_cancelled());
      if (elements != nullptr) {
        A3D_ASSIGN(auto element, elements->next());
        if (element) {
          Tuple result;
          A3D_TRY(append_attributes(*current, kept, result.attributes));
          result.attributes.push_back(std::move(*element));
          return TuplePtr(std::make_shared<const Tuple>(std::move(result)));
        }
      }
      A3D_ASSIGN(current, tuples->next());
      if (current == nullptr) return TuplePtr();
      const Datum argument{current};
      A3D_ASSIGN(const Datum stream, function->call({&argument, 1}));
      elements = stream.values();
    }
  })};
}

Result<BoundOperator> map_extendstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("extendstream", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const TypeExpr result, streamed(check, tuple, tuple, 1));
  std::vector<std::size_t> all;
  for (std::size_t index = 0; index < tuple.attributes().size(); ++index) all.push_back(index);
  return BoundOperator{TypeExpr::stream(result), [all](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return extended_stream(given[0].tuples(), all, given[1].list(), context);
                       }};
}

Result<BoundOperator> map_projectextendstream(std::span<const ArgumentType> arguments) {
  const MappingCheck check("projectextendstream", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const auto kept, check.distinct_or_no_attributes(1, tuple));
  A3D_ASSIGN(const TypeExpr result, streamed(check, tuple, projected(tuple, kept), 2));
  return BoundOperator{TypeExpr::stream(result), [kept](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return extended_stream(given[0].tuples(), kept, given[2].list(), context);
                       }};
}

}  // namespace

void register_extending_streams(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "extendstream",
      .syntax = "_ extendstream[functions(TUPLE)]",
      .doc =
          "For each tuple one tuple per element of the stream that the function returns for it, with this element as "
          "a new attribute.",
      .detail = "Tuples with an empty stream are dropped.",
      .stream = stream_operator(map_extendstream),
      .signatures = {"(stream(tuple) ((NAME (map tuple stream(DATA))))) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) transformstream extendstream[B: intstream(2, .Elem)] consume",
                          "((2 2) (3 2) (3 3))"},
                         {"intstream(1, 1) transformstream extendstream[B: [const int value undefined] feed] consume",
                          "((1 undefined))"}},
      .query_errors =
          {{"query intstream(1, 3) transformstream extendstream[B: .Elem] count",
            "extendstream: expected a stream of values for the attribute 'B', got int"},
           {"query intstream(1, 3) transformstream extendstream[Elem: intstream(1, 2)] count",
            "extendstream: duplicate attribute name 'Elem'"},
           {"query intstream(1, 3) transformstream extendstream[B: intstream(1, 2), C: intstream(1, 2)] count",
            "extendstream: expected one new attribute, got 2"}},
  });
  group.add({
      .name = "projectextendstream",
      .syntax = "_ projectextendstream[attributes; functions(TUPLE)]",
      .doc = "For each tuple one tuple per element of the stream that the function returns for it: the named "
             "attributes, then the element.",
      .detail = "The new name may be that of a dropped attribute.",
      .stream = stream_operator(map_projectextendstream),
      .signatures = {"(stream(tuple) NAMES ((NAME (map tuple stream(DATA))))) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream projectextendstream[; Elem: intstream(1, .Elem)] consume",
                          "((1) (1) (2))"},
                         {"[const rel(tuple([A: int, B: int])) value ((1 2) (undefined 3))] feed "
                          "projectextendstream[B; N: intstream(1, .A)] consume",
                          "((2 1))"}},
      .query_errors = {{"query intstream(1, 3) transformstream projectextendstream[Elem; Elem: intstream(1, 2)] count",
                        "projectextendstream: duplicate attribute name 'Elem'"},
                       {"query intstream(1, 3) transformstream projectextendstream[; B: 5] count",
                        "projectextendstream: expected a stream of values for the attribute 'B', got int"}},
  });
}

}  // namespace queries
