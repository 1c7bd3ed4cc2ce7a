// filter, head, tail: which tuples go on.
#include <algorithm>
#include <deque>

#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Result<Plan> map_filter(std::span<const ArgumentType> arguments) {
  const MappingCheck check("filter", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  RETURN_IF_ERROR(check.function(1, "bool"));
  return Plan{TypeExpr::stream(tuple), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                return Datum{make_stream([tuples = given[0].tuples(), predicate = given[1].function_ptr(), &context,
                                          step = 0U]() mutable -> Result<TuplePtr> {
                  while (true) {
                    ASSIGN_OR_RETURN(TuplePtr next, tuples->next());
                    if (next == nullptr) return next;
                    ASSIGN_OR_RETURN(const Value holds, call_on(*predicate, next));
                    if (is_true(holds)) return next;
                    if (++step % 1024 == 0) RETURN_IF_ERROR(context.check_cancelled());
                  }
                })};
              }};
}

Result<Plan> map_head(std::span<const ArgumentType> arguments) {
  const MappingCheck check("head", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  RETURN_IF_ERROR(check.type(1, "int"));
  return Plan{TypeExpr::stream(tuple), [](std::vector<Datum> given, Context&) -> Result<Datum> {
                const Value& limit = given[1].value();
                const std::int32_t count = limit.is_defined() ? limit.get<std::int32_t>() : 0;
                return Datum{make_stream([tuples = given[0].tuples(), left = count]() mutable -> Result<TuplePtr> {
                  if (left <= 0) return TuplePtr();
                  --left;
                  return tuples->next();
                })};
              }};
}

// Keeps no more than the tuples that it will give.
Result<TupleStreamPtr> last_tuples(TupleStream& tuples, std::size_t count, bool keep_order, Context& context) {
  std::deque<TuplePtr> last;
  RETURN_IF_ERROR(for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
    last.push_back(tuple);
    if (last.size() > count) last.pop_front();
    return {};
  }));
  if (!keep_order) std::ranges::reverse(last);
  return make_stream([last = std::move(last)]() mutable -> Result<TuplePtr> {
    if (last.empty()) return TuplePtr();
    TuplePtr next = std::move(last.front());
    last.pop_front();
    return next;
  });
}

Result<Plan> map_tail(std::span<const ArgumentType> arguments) {
  const MappingCheck check("tail", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  RETURN_IF_ERROR(check.argument_count(2, 3));
  RETURN_IF_ERROR(check.type(1, "int"));
  if (check.count() == 3) RETURN_IF_ERROR(check.type(2, "bool"));
  return Plan{TypeExpr::stream(tuple), [](std::vector<Datum> given, Context& context) -> Result<Datum> {
                const Value& limit = given[1].value();
                const std::int32_t count = limit.is_defined() ? std::max(0, limit.get<std::int32_t>()) : 0;
                const bool keep_order = given.size() < 3 || is_true(given[2].value());
                ASSIGN_OR_RETURN(TupleStreamPtr last,
                                 last_tuples(*given[0].tuples(), static_cast<std::size_t>(count), keep_order, context));
                return Datum{std::move(last)};
              }};
}

}  // namespace

void register_selection(algebra3d::Registry& registry) {
  registry.add({
      .name = "filter",
      .syntax = "_ filter[fun(TUPLE)]",
      .doc = "The tuples for which the predicate is a defined TRUE.",
      .stream = stream_operator(map_filter),
      .signatures = {"(stream(tuple) (map tuple bool)) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream filter[.Elem > 8] consume", "((9) (10))"},
                   {"intstream(1, 3) transformstream filter[[const bool value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) transformstream filter[.Elem] count",
                  "filter: expected a function that gives bool, got int"},
                 {"query 5 filter[TRUE]", "filter: expected a stream of tuples as operand 1, got int"}},
  });
  registry.add({
      .name = "head",
      .syntax = "_ head[_]",
      .doc = "The first n tuples of a stream.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_head),
      .signatures = {"(stream(tuple) int) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream head[2] consume", "((1) (2))"},
                   {"intstream(1, 10) transformstream head[[const int value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) transformstream head[1.5] count", "head: expected int, got real"}},
  });
  registry.add({
      .name = "tail",
      .syntax = "_ tail[_ ...]",
      .doc = "The last n tuples of a stream, in their order or, with FALSE as the last argument, the last one first.",
      .detail = "None for n below 1 or undefined.",
      .stream = stream_operator(map_tail),
      .signatures = {"(stream(tuple) int) -> stream(tuple)", "(stream(tuple) int bool) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"intstream(1, 10) transformstream tail[2] consume", "((9) (10))"},
                   {"intstream(1, 10) transformstream tail[2, FALSE] consume", "((10) (9))"},
                   {"intstream(1, 10) transformstream tail[[const int value undefined]] count", "0"}},
      .errors = {{"query intstream(1, 3) transformstream tail[1, 2] count", "tail: expected bool, got int"}},
  });
}

}  // namespace queries
