// sum, avg, min, max, extract: one value from a stream.
#include <cmath>
#include <limits>
#include <optional>

#include "algebra3d/exact/real_sum.h"
#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Rational;
using algebra3d::RealSum;
using algebra3d::TypeOf;

/// Calls `visit` with each defined value of an attribute, loaded.
template <typename Visit>
Status for_each_defined(const Datum& stream, std::size_t attribute, Context& context, Visit visit) {
  return for_each_tuple(*stream.tuples(), context, [&](const TuplePtr& tuple) -> Status {
    const Value& value = tuple->attributes[attribute];
    if (!value.is_defined()) return {};
    if (!value.is_deferred()) return visit(value), Status();
    // Not moved out of the result: GCC 12 then takes the unused part of the value for an uninitialised read.
    const auto loaded = value.loaded();
    if (!loaded) return loaded.error();
    visit(*loaded);
    return {};
  });
}

Datum finite(double value, std::string_view op, Context& context) {
  if (std::isfinite(value)) return Datum{Value::of<double>(value)};
  context.diagnostics.report_undefined(std::string(op) + ": the result is no finite number");
  return Datum{Value(TypeOf<double>::type())};
}

/// The exact sum of ints: as many as there can be do not leave 128 bits.
struct IntSum {
  __extension__ __int128 total = 0;
  std::uint64_t count = 0;
};

Result<IntSum> exact_sum(const Datum& stream, std::size_t attribute, Context& context) {
  IntSum sum;
  RETURN_IF_ERROR(for_each_defined(stream, attribute, context, [&](const Value& value) {
    sum.total += value.get<std::int64_t>();
    ++sum.count;
  }));
  return sum;
}

Result<Datum> sum_of_ints(const Datum& stream, std::size_t attribute, Context& context) {
  ASSIGN_OR_RETURN(const IntSum sum, exact_sum(stream, attribute, context));
  if (const auto total = static_cast<std::int64_t>(sum.total); total == sum.total) return Datum{Value::of(total)};
  context.diagnostics.report_undefined(fmt::format("sum: the result {} is beyond the range of ints", sum.total));
  return Datum{Value(TypeOf<std::int64_t>::type())};
}

Rational total_of(const IntSum& sum) {
  constexpr unsigned kHalf = 64;
  const Rational half = Rational(std::int64_t{1} << (kHalf / 2));
  return Rational(static_cast<std::int64_t>(sum.total >> kHalf)) * half * half +
         Rational(static_cast<std::uint64_t>(sum.total));
}

Datum mean(const Rational& total, std::uint64_t count, Context& context) {
  if (count > 0) return finite((total / Rational(count)).nearest_double(), "avg", context);
  context.diagnostics.report_undefined("avg: there is no defined value");
  return Datum{Value(TypeOf<double>::type())};
}

Result<RealSum> sum_of_reals(const Datum& stream, std::size_t attribute, Context& context) {
  RealSum sum;
  RETURN_IF_ERROR(
      for_each_defined(stream, attribute, context, [&](const Value& value) { sum.add(value.get<double>()); }));
  return sum;
}

Result<std::size_t> numeric_attribute(const MappingCheck& check, const TypeExpr& tuple) {
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(1, tuple));
  const TypeExpr& type = tuple.attributes()[index].type;
  if (!type.is("int") && !type.is("real")) return check.expected("an attribute of type int or real", type);
  return index;
}

Result<Plan> map_sum(std::span<const ArgumentType> arguments) {
  const MappingCheck check("sum", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t index, numeric_attribute(check, tuple));
  const TypeExpr type = tuple.attributes()[index].type;
  return Plan{type, [index, is_int = type.is("int")](std::vector<Datum> given, Context& context) -> Result<Datum> {
                if (is_int) return sum_of_ints(given[0], index, context);
                ASSIGN_OR_RETURN(const RealSum sum, sum_of_reals(given[0], index, context));
                return finite(sum.total().nearest_double(), "sum", context);
              }};
}

Result<Plan> map_avg(std::span<const ArgumentType> arguments) {
  const MappingCheck check("avg", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t index, numeric_attribute(check, tuple));
  const bool is_int = tuple.attributes()[index].type.is("int");
  return Plan{"real", [index, is_int](std::vector<Datum> given, Context& context) -> Result<Datum> {
                if (is_int) {
                  ASSIGN_OR_RETURN(const IntSum sum, exact_sum(given[0], index, context));
                  return mean(total_of(sum), sum.count, context);
                }
                ASSIGN_OR_RETURN(const RealSum sum, sum_of_reals(given[0], index, context));
                return mean(sum.total(), sum.count(), context);
              }};
}

// `wanted` is the sign of the comparison that makes a later value win.
Result<Plan> map_extreme(const char* op, int wanted, std::span<const ArgumentType> arguments) {
  const MappingCheck check(op, arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(1, tuple));
  return Plan{tuple.attributes()[index].type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                std::optional<Value> best;
                RETURN_IF_ERROR(for_each_defined(given[0], index, context, [&](const Value& value) {
                  const auto order = best ? compare(value, *best) : std::strong_ordering::equal;
                  if (!best || (wanted < 0 ? order < 0 : order > 0)) best = value;
                }));
                if (best) return Datum{*best};
                context.diagnostics.report_undefined(std::string(op) + ": there is no defined value");
                return Datum{undefined_of(tuple.attributes()[index].type)};
              }};
}

Result<Plan> map_extract(std::span<const ArgumentType> arguments) {
  const MappingCheck check("extract", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(1, tuple));
  const TypeExpr type = tuple.attributes()[index].type;
  return Plan{type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                ASSIGN_OR_RETURN(const TuplePtr first, given[0].tuples()->next());
                if (first != nullptr) return Datum{first->attributes[index]};
                context.diagnostics.report_undefined("extract: the stream is empty");
                return Datum{undefined_of(type)};
              }};
}

}  // namespace

void register_aggregates(algebra3d::Registry& registry) {
  const std::string numbers = "[const rel(tuple([A: int, B: real])) value ((1 0.5) (2 undefined) (6 1.0))] feed ";
  const std::string nothing = "[const rel(tuple([A: int])) value ((undefined))] feed ";
  registry.add({
      .name = "sum",
      .syntax = "_ sum[attribute]",
      .doc = "The sum of the defined values of a numeric attribute; 0 if there are none.",
      .detail =
          "The exact sum, for reals rounded once, whatever the order. A sum beyond the range of the type is undefined.",
      .exactness = algebra3d::Exactness::rounded_once,
      .sources = {"neal2015"},
      .stream = stream_operator(map_sum),
      .signatures = {"(stream(tuple) NAME) -> int", "(stream(tuple) NAME) -> real"},
      .handles_undefined = true,
      .examples = {{numbers + "sum[A]", "9"}, {numbers + "sum[B]", "1.5"}, {nothing + "sum[A]", "0"}},
      .errors = {{"query intstream(1, 2) transformstream extend[T: TRUE] sum[T]",
                  "sum: expected an attribute of type int or real, got bool"}},
  });
  registry.add({
      .name = "avg",
      .syntax = "_ avg[attribute]",
      .doc = "The mean of the defined values of a numeric attribute; undefined if there are none.",
      .detail = "The exact mean, rounded once.",
      .exactness = algebra3d::Exactness::rounded_once,
      .sources = {"neal2015"},
      .stream = stream_operator(map_avg),
      .signatures = {"(stream(tuple) NAME) -> real"},
      .handles_undefined = true,
      .examples = {{numbers + "avg[A]", "3.0"}, {numbers + "avg[B]", "0.75"}, {nothing + "avg[A]", "undefined"}},
      .errors = {{"query intstream(1, 2) transformstream extend[T: TRUE] avg[T]",
                  "avg: expected an attribute of type int or real, got bool"}},
  });
  registry.add({
      .name = "min",
      .syntax = "_ min[attribute]",
      .doc = "The smallest defined value of an attribute; undefined if there is none.",
      .stream = stream_operator([](auto arguments) { return map_extreme("min", -1, arguments); }),
      .signatures = {"(stream(tuple) NAME) -> DATA"},
      .handles_undefined = true,
      .examples = {{numbers + "min[A]", "1"}, {nothing + "min[A]", "undefined"}},
      .errors = {{"query intstream(1, 2) transformstream min[X]", "min: unknown attribute 'X'"}},
  });
  registry.add({
      .name = "max",
      .syntax = "_ max[attribute]",
      .doc = "The largest defined value of an attribute; undefined if there is none.",
      .stream = stream_operator([](auto arguments) { return map_extreme("max", 1, arguments); }),
      .signatures = {"(stream(tuple) NAME) -> DATA"},
      .handles_undefined = true,
      .examples = {{numbers + "max[B]", "1.0"}, {nothing + "max[A]", "undefined"}},
      .errors = {{"query intstream(1, 2) transformstream max[X]", "max: unknown attribute 'X'"}},
  });
  registry.add({
      .name = "extract",
      .syntax = "_ extract[attribute]",
      .doc = "The value of an attribute in the first tuple; undefined for an empty stream.",
      .stream = stream_operator(map_extract),
      .signatures = {"(stream(tuple) NAME) -> DATA"},
      .handles_undefined = true,
      .examples = {{numbers + "extract[B]", "0.5"}, {nothing + "extract[A]", "undefined"}},
      .errors = {{"query intstream(1, 2) transformstream extract[X]", "extract: unknown attribute 'X'"}},
  });
}

}  // namespace queries
