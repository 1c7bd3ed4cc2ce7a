// use, printstream: something is done with each element of a stream.
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/any_stream.h"

namespace queries {
namespace {

/// Of an element in a note.
constexpr std::size_t kShownCharacters = 200;

/// The value that the function gives for each element.
template <typename Stream>
Datum used(const std::shared_ptr<Stream>& stream, std::shared_ptr<const Function> function) {
  return Datum{make_value_stream([stream, function = std::move(function)]() mutable -> Result<std::optional<Value>> {
    A3D_ASSIGN(const auto element, stream->next());
    if (!element) return std::optional<Value>();
    const Datum argument = element_datum(element);
    A3D_ASSIGN(Value result, function->call_for_value({&argument, 1}));
    return std::optional(std::move(result));
  })};
}

/// The elements of the streams, all of the kind `Inner`, that the function gives for each element.
template <typename Inner, typename Stream>
Datum flattened(const std::shared_ptr<Stream>& stream, std::shared_ptr<const Function> function,
                const Context& context) {
  return Datum{
      make_stream_of<Inner>([stream, function = std::move(function), &context, inner = std::shared_ptr<Inner>(),
                             step = 0U]() mutable -> Result<ElementOf<Inner>> {
        while (true) {
          if (++step % 1024 == 0) A3D_TRY(context.check_cancelled());
          if (inner != nullptr) {
            A3D_ASSIGN(ElementOf<Inner> next, inner->next());
            if (next) return next;
          }
          A3D_ASSIGN(const auto element, stream->next());
          if (!element) return ElementOf<Inner>();
          const Datum argument = element_datum(element);
          A3D_ASSIGN(const Datum result, function->call({&argument, 1}));
          inner = std::get<std::shared_ptr<Inner>>(result.content);
        }
      })};
}

Result<BoundOperator> map_use(std::span<const ArgumentType> arguments) {
  const MappingCheck check("use", arguments);
  A3D_ASSIGN(const TypeExpr element, check.any_stream(0));
  A3D_TRY(check.takes(check[1].type, {element}));
  const TypeExpr result = check[1].type.function_result();
  if (!is_value_type(result) && !result.is_stream())
    return check.expected("a function that gives a value or a stream", result);
  return BoundOperator{result.is_stream() ? result : TypeExpr::stream(result),
                       [result](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         const auto& function = given[1].function_ptr();
                         return visit_stream(given[0], [&](const auto& stream) -> Result<Datum> {
                           if (result.is_tuple_stream()) return flattened<TupleStream>(stream, function, context);
                           if (result.is_stream()) return flattened<ValueStream>(stream, function, context);
                           return used(stream, function);
                         });
                       }};
}

/// `(1 "a")`, or `5` for a value; large values are cut.
Result<std::string> shown(const TuplePtr& tuple) {
  A3D_ASSIGN(const std::vector<Value> values, loaded_values(tuple));
  algebra3d::NestedList::List list;
  for (const Value& value : values) list.push_back(value.to_nested());
  return algebra3d::NestedList(std::move(list)).print_short(kShownCharacters);
}
Result<std::string> shown(const std::optional<Value>& element) {
  A3D_ASSIGN(const Value value, element->loaded());
  return value.to_nested().print_short(kShownCharacters);
}

// A library prints nothing, so the elements travel as diagnostics, which the host shows.
Result<BoundOperator> map_printstream(std::span<const ArgumentType> arguments) {
  A3D_ASSIGN(const TypeExpr element, MappingCheck("printstream", arguments).any_stream(0));
  return BoundOperator{TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         return visit_stream(given[0], [&]<typename Stream>(const std::shared_ptr<Stream>& stream) {
                           return Result<Datum>(Datum{make_stream_of<Stream>(
                               [stream, &context, number = std::uint64_t{0}]() mutable -> Result<ElementOf<Stream>> {
                                 A3D_ASSIGN(ElementOf<Stream> next, stream->next());
                                 if (!next) return next;
                                 A3D_ASSIGN(const std::string text, shown(next));
                                 context.diagnostics.show(fmt::format("printstream: {}: {}", ++number, text));
                                 return next;
                               })});
                         });
                       }};
}

}  // namespace

void register_using(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "use",
      .syntax = "_ use[fun(STREAMELEM)]",
      .doc = "The stream of the results of a function for each element.",
      .detail =
          "`.` is the element, or `.A` an attribute of a tuple. The streams of a function that gives streams follow "
          "each other.",
      .stream = stream_operator(map_use),
      .signatures = {"(stream(DATA) (map DATA DATA)) -> stream(DATA)",
                     "(stream(tuple) (map tuple DATA)) -> "
                     "stream(DATA)",
                     "(stream(DATA) (map DATA stream(DATA))) -> stream(DATA)",
                     "(stream(DATA) (map DATA stream(tuple))) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) use[. * .] collect_vector", "(1 4 9)"},
                         {"intstream(1, 3) use[fun(n: int) intstream(1, n)] collect_vector", "(1 1 2 1 2 3)"},
                         {"intstream(1, 2) transformstream use[.Elem > 1] collect_vector", "(FALSE TRUE)"},
                         {"[const int value undefined] feed use[. + 1] collect_vector", "(undefined)"}},
      .query_errors = {{"query intstream(1, 3) transformstream use[.] count",
                        "use: expected a function that gives a value or a stream, got (tuple"},
                       {"query 5 use[. + 1] count", "use: expected a stream as operand 1, got int"}},
  });
  group.add({
      .name = "printstream",
      .syntax = "_ printstream",
      .doc = "The same stream; every element is shown as a note while it passes.",
      .detail = "For looking into a query. The notes go to standard error; long ones are cut, and their number is "
                "limited like that of all notes of a statement.",
      .is_pure = false,
      .stream = stream_operator(map_printstream),
      .signatures = {"(stream(tuple)) -> stream(tuple)", "(stream(DATA)) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 3) printstream count", "3"},
                         {"[const int value undefined] feed transformstream printstream consume", "((undefined))"}},
      .query_errors = {{"query 5 printstream", "printstream: expected a stream, got int"}},
  });
}

}  // namespace queries
