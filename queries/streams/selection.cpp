// filter, head, tail, nth, some, exist: which elements of a stream go on.
#include <algorithm>
#include <deque>
#include <random>

#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/any_stream.h"

namespace queries {
namespace {

Result<Plan> map_filter(std::span<const ArgumentType> arguments) {
  const MappingCheck check("filter", arguments);
  ASSIGN_OR_RETURN(const TypeExpr element, check.any_stream(0));
  RETURN_IF_ERROR(check.function(1, {element}, "bool"));
  return Plan{
      TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
        return visit_stream(given[0], [&]<typename Stream>(const std::shared_ptr<Stream>& stream) {
          return Result<Datum>(Datum{make_stream_of<Stream>([stream, predicate = given[1].function_ptr(), &context,
                                                             step = 0U]() mutable -> Result<ElementOf<Stream>> {
            while (true) {
              ASSIGN_OR_RETURN(ElementOf<Stream> next, stream->next());
              if (!next) return next;
              const Datum argument = element_datum(next);
              ASSIGN_OR_RETURN(const Datum holds, predicate->call({&argument, 1}));
              if (is_true(holds.value())) return next;
              if (++step % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
            }
          })});
        });
      }};
}

// A number of elements: none for an undefined or negative one.
std::size_t element_count(const Datum& datum) {
  const Value& value = datum.value();
  return value.is_defined() ? static_cast<std::size_t>(std::max(0, value.get<std::int32_t>())) : 0;
}

Result<Plan> map_head(std::span<const ArgumentType> arguments) {
  const MappingCheck check("head", arguments);
  ASSIGN_OR_RETURN(const TypeExpr element, check.any_stream(0));
  RETURN_IF_ERROR(check.type(1, "int"));
  return Plan{TypeExpr::stream(element), [](std::vector<Datum> given, Context&) -> Result<Datum> {
                return visit_stream(given[0], [&]<typename Stream>(const std::shared_ptr<Stream>& stream) {
                  return Result<Datum>(Datum{make_stream_of<Stream>(
                      [stream, left = element_count(given[1])]() mutable -> Result<ElementOf<Stream>> {
                        if (left == 0) return ElementOf<Stream>();
                        --left;
                        return stream->next();
                      })});
                });
              }};
}

/// The stream of elements that lie in a container.
template <typename Stream>
Datum given_out(std::deque<ElementOf<Stream>> elements) {
  return Datum{make_stream_of<Stream>([elements = std::move(elements)]() mutable -> Result<ElementOf<Stream>> {
    if (elements.empty()) return ElementOf<Stream>();
    ElementOf<Stream> next = std::move(elements.front());
    elements.pop_front();
    return next;
  })};
}

// Keeps no more than the elements that it will give.
template <typename Stream>
Result<Datum> last_elements(Stream& stream, std::size_t count, bool keep_order, const Context& context) {
  std::deque<ElementOf<Stream>> last;
  RETURN_IF_ERROR(for_each_element(stream, context, [&](const auto& element) -> Status {
    last.push_back(element);
    if (last.size() > count) last.pop_front();
    return {};
  }));
  if (!keep_order) std::ranges::reverse(last);
  return given_out<Stream>(std::move(last));
}

Result<Plan> map_tail(std::span<const ArgumentType> arguments) {
  const MappingCheck check("tail", arguments);
  ASSIGN_OR_RETURN(const TypeExpr element, check.any_stream(0));
  RETURN_IF_ERROR(check.argument_count(2, 3));
  RETURN_IF_ERROR(check.type(1, "int"));
  if (check.count() == 3) RETURN_IF_ERROR(check.type(2, "bool"));
  return Plan{TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                const bool keep_order =
                    given.size() < 3 || !given[2].value().is_defined() || given[2].value().get<bool>();
                return visit_stream(given[0], [&](const auto& stream) {
                  return last_elements(*stream, element_count(given[1]), keep_order, context);
                });
              }};
}

/// Elements n, 2n, 3n and so on, or element n alone.
template <typename Stream>
Datum every_nth(const std::shared_ptr<Stream>& stream, std::size_t distance, bool once, const Context& context) {
  return Datum{make_stream_of<Stream>([stream, distance, once, &context, is_done = distance == 0,
                                       position = std::uint64_t{0}]() mutable -> Result<ElementOf<Stream>> {
    while (!is_done) {
      ASSIGN_OR_RETURN(ElementOf<Stream> next, stream->next());
      if (!next) break;
      if (++position % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
      if (position % distance != 0) continue;
      is_done = once;
      return next;
    }
    return ElementOf<Stream>();
  })};
}

Result<Plan> map_nth(std::span<const ArgumentType> arguments) {
  const MappingCheck check("nth", arguments);
  ASSIGN_OR_RETURN(const TypeExpr element, check.any_stream(0));
  RETURN_IF_ERROR(check.argument_count(2, 3));
  RETURN_IF_ERROR(check.type(1, "int"));
  if (check.count() == 3) RETURN_IF_ERROR(check.type(2, "bool"));
  return Plan{TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                const bool once = given.size() == 3 && is_true(given[2].value());
                return visit_stream(given[0], [&](const auto& stream) {
                  return Result<Datum>(every_nth(stream, element_count(given[1]), once, context));
                });
              }};
}

// Reservoir sampling, with a generator of its own whose numbers are the same everywhere, so that the same stream gives
// the same elements. Source: [vitter1985], algorithm R. The remainder of a 64-bit number is as good as uniform here.
template <typename Stream>
Result<Datum> drawn(Stream& stream, std::size_t count, const Context& context) {
  using Numbered = std::pair<std::uint64_t, ElementOf<Stream>>;
  std::mt19937_64 generator;  // NOLINT(cert-msc32-c,cert-msc51-cpp): the fixed seed is the point
  std::vector<Numbered> sample;
  std::uint64_t seen = 0;
  RETURN_IF_ERROR(for_each_element(stream, context, [&](const auto& element) -> Status {
    if (sample.size() < count) {
      sample.emplace_back(seen, element);
    } else if (const std::uint64_t place = generator() % (seen + 1); place < count) {
      sample[place] = {seen, element};
    }
    ++seen;
    return {};
  }));
  std::ranges::sort(sample, {}, &Numbered::first);
  std::deque<ElementOf<Stream>> elements;
  for (Numbered& entry : sample) elements.push_back(std::move(entry.second));
  return given_out<Stream>(std::move(elements));
}

Result<Plan> map_some(std::span<const ArgumentType> arguments) {
  const MappingCheck check("some", arguments);
  ASSIGN_OR_RETURN(const TypeExpr element, check.any_stream(0));
  RETURN_IF_ERROR(check.type(1, "int"));
  return Plan{TypeExpr::stream(element), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                return visit_stream(
                    given[0], [&](const auto& stream) { return drawn(*stream, element_count(given[1]), context); });
              }};
}

Result<Plan> map_exist(std::span<const ArgumentType> arguments) {
  RETURN_IF_ERROR(MappingCheck("exist", arguments).any_stream(0));
  return Plan{"bool", [](std::vector<Datum> given, Context&) -> Result<Datum> {
                return visit_stream(given[0], [](const auto& stream) -> Result<Datum> {
                  ASSIGN_OR_RETURN(const auto first, stream->next());
                  return Datum{Value::of<bool>(static_cast<bool>(first))};
                });
              }};
}

}  // namespace

void register_selection(algebra3d::Registry& registry) {
  registry.add({
      .name = "filter",
      .syntax = "_ filter[fun(STREAMELEM)]",
      .doc = "The elements of a stream for which the predicate is a defined TRUE.",
      .detail = "In a stream of tuples `.A` is an attribute, in a stream of values `.` the value.",
      .stream = stream_operator(map_filter),
      .signatures = {"(stream(tuple) (map tuple bool)) -> stream(tuple)",
                     "(stream(DATA) (map DATA bool)) -> "
                     "stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream filter[.Elem > 8] consume", "((9) (10))"},
                   {"intstream(1, 10) filter[. mod 3 = 0] count", "3"},
                   {"intstream(1, 3) transformstream filter[[const bool value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) transformstream filter[.Elem] count",
                  "filter: expected a function that gives bool, got int"},
                 {"query 5 filter[TRUE]", "filter: expected a stream as operand 1, got int"}},
  });
  registry.add({
      .name = "head",
      .syntax = "_ head[_]",
      .doc = "The first n elements of a stream.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_head),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(DATA) int) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream head[2] consume", "((1) (2))"},
                   {"intstream(1, 10) head[4] count", "4"},
                   {"intstream(1, 10) transformstream head[[const int value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) transformstream head[1.5] count", "head: expected int, got real"},
                 {"query 5 head[1]", "head: expected a stream, got int"}},
  });
  registry.add({
      .name = "tail",
      .syntax = "_ tail[_ ...]",
      .doc = "The last n elements of a stream, in their order or, with FALSE as the last argument, the last one first.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_tail),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(tuple) int bool) -> stream(tuple)",
                     "(stream(DATA) int) -> stream(DATA)", "(stream(DATA) int bool) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream tail[2] consume", "((9) (10))"},
                   {"intstream(1, 10) tail[2, FALSE] transformstream consume", "((10) (9))"},
                   {"intstream(1, 10) transformstream tail[[const int value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) transformstream tail[1, 2] count", "tail: expected bool, got int"}},
  });
  registry.add({
      .name = "nth",
      .syntax = "_ nth[_ ...]",
      .doc = "Every n-th element of a stream or, with TRUE as the last argument, the n-th element alone.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_nth),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(tuple) int bool) -> stream(tuple)",
                     "(stream(DATA) int) -> stream(DATA)", "(stream(DATA) int bool) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream nth[4] consume", "((4) (8))"},
                   {"intstream(1, 10) transformstream nth[4, TRUE] consume", "((4))"},
                   {"intstream(1, 10) nth[[const int value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) nth[TRUE] count", "nth: expected int, got bool"},
                 {"query intstream(1, 3) nth[1, 2] count", "nth: expected bool, got int"}},
  });
  registry.add({
      .name = "some",
      .syntax = "_ some[_]",
      .doc = "A sample of n elements of a stream, or all if there are no more, in their order.",
      .detail =
          "Every element has the same chance, and the same stream always gives the same sample. None for n below 1 "
          "or undefined.",
      .stream = stream_operator(map_some),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(DATA) int) -> stream(DATA)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 100) some[7] count", "7"},
                   {"intstream(1, 3) transformstream some[7] consume", "((1) (2) (3))"},
                   {"intstream(1, 10) some[[const int value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) some[1.5] count", "some: expected int, got real"},
                 {"query 5 some[1] count", "some: expected a stream, got int"}},
  });
  registry.add({
      .name = "exist",
      .syntax = "_ exist",
      .doc = "True if a stream has an element.",
      .detail = "Reads no more than the first one.",
      .stream = stream_operator(map_exist),
      .signatures = {"(stream(tuple)) -> bool", "(stream(DATA)) -> bool"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream filter[.Elem > 9] exist", "TRUE"},
                   {"intstream(1, 10) filter[. > 10] exist", "FALSE"},
                   {"[const int value undefined] feed exist", "TRUE"}},
      .errors = {{"query 5 exist", "exist: expected a stream, got int"},
                 {"query [const rel(tuple([A: int])) value ()] exist",
                  "exist: expected a stream of tuples (write `feed` after the relation), got (rel"}},
  });
}

}  // namespace queries
