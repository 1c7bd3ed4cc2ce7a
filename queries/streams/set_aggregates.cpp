// union_aggr, intersection_aggr: one solid or set of points from a stream.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "algebra3d/operators/solid_sets.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::ExactPoint;
using algebra3d::Points3d;
using algebra3d::Volume3d;

/// The defined values of an attribute, loaded; undefined ones are left out and counted in a diagnostic.
template <typename T>
Result<std::vector<T>> defined_values(const Datum& stream, std::size_t attribute, std::string_view op,
                                      Context& context) {
  std::vector<T> values;
  std::size_t undefined = 0;
  RETURN_IF_ERROR(for_each_tuple(*stream.tuples(), context, [&](const TuplePtr& tuple) -> Status {
    const Value& value = tuple->attributes[attribute];
    if (!value.is_defined()) return ++undefined, Status();
    const auto loaded = value.loaded();
    if (!loaded) return loaded.error();
    values.push_back(loaded->template get<T>());
    return {};
  }));
  if (undefined > 0)
    context.diagnostics.report(
        fmt::format("{}: left out {} undefined value{}", op, undefined, undefined == 1 ? "" : "s"));
  return values;
}

Result<Volume3d> united_values(const std::vector<Volume3d>& solids, Context& context) {
  return algebra3d::united(context, solids);
}

Result<Points3d> united_values(const std::vector<Points3d>& sets, Context& /*context*/) {
  std::vector<ExactPoint> points;
  for (const Points3d& set : sets) points.insert(points.end(), set.points().begin(), set.points().end());
  return Points3d(std::move(points));
}

Result<Volume3d> common_values(const std::vector<Volume3d>& solids, Context& context) {
  return algebra3d::intersected(context, solids);
}

Result<Points3d> common_values(const std::vector<Points3d>& sets, Context& context) {
  Points3d common = sets.front();
  for (const Points3d& set : sets) {
    RETURN_IF_ERROR(context.check_cancelled());
    std::vector<ExactPoint> points;
    std::ranges::set_intersection(common.points(), set.points(), std::back_inserter(points));
    common = Points3d(std::move(points));
  }
  return common;
}

template <typename T>
Plan union_plan(const TypeExpr& type, std::size_t attribute) {
  return {type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
            ASSIGN_OR_RETURN(const auto values, defined_values<T>(given[0], attribute, "union_aggr", context));
            ASSIGN_OR_RETURN(T united, united_values(values, context));
            return Datum{Value::of<T>(std::move(united))};
          }};
}

template <typename T>
Plan intersection_plan(const TypeExpr& type, std::size_t attribute) {
  return {type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
            ASSIGN_OR_RETURN(const auto values, defined_values<T>(given[0], attribute, "intersection_aggr", context));
            if (values.empty()) {
              context.diagnostics.report_undefined("intersection_aggr: there is no defined value");
              return Datum{Value(algebra3d::TypeOf<T>::type())};
            }
            ASSIGN_OR_RETURN(T common, common_values(values, context));
            return Datum{Value::of<T>(std::move(common))};
          }};
}

/// The plan for the attribute's type.
Result<Plan> map_aggregate(std::string_view op, std::span<const ArgumentType> arguments,
                           Plan (*of_solids)(const TypeExpr&, std::size_t),
                           Plan (*of_points)(const TypeExpr&, std::size_t)) {
  const MappingCheck check(op, arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t index, check.attribute(1, tuple));
  const TypeExpr& type = tuple.attributes()[index].type;
  if (type.is("volume3d")) return of_solids(type, index);
  if (type.is("points3d")) return of_points(type, index);
  return check.expected("an attribute of type volume3d or points3d", type);
}

const std::string kSolids =
    "intstream(0, 3) transformstream extend[V: createCube(makePoint3D(.Elem, 0, 0), makePoint3D(.Elem + 2, 2, 2))] ";
const std::string kNothing =
    "intstream(1, 0) transformstream extend[V: createCube(makePoint3D(0, 0, 0), "
    "makePoint3D(1, 1, 1))] ";

}  // namespace

void register_set_aggregates(algebra3d::Registry& registry) {
  registry.add({
      .name = "union_aggr",
      .syntax = "_ union_aggr[attribute]",
      .doc = "The union of all defined values of an attribute: solids or sets of points. Empty if there are none.",
      .detail =
          "All solids are divided at one another once, not one after the other. Undefined values are left out, with a "
          "note.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator([](auto arguments) {
        return map_aggregate("union_aggr", arguments, &union_plan<Volume3d>, &union_plan<Points3d>);
      }),
      .signatures = {"(stream(tuple) NAME) -> volume3d", "(stream(tuple) NAME) -> points3d"},
      .handles_undefined = true,
      .examples = {{"volume(" + kSolids + "union_aggr[V])", "20.0"},
                   {"size(" + kSolids + "union_aggr[V])", "12"},
                   {"size(" + kNothing + "union_aggr[V])", "0"}},
      .errors = {{"query intstream(1, 2) transformstream union_aggr[Elem]",
                  "union_aggr: expected an attribute of type volume3d or points3d, got int"}},
  });
  registry.add({
      .name = "intersection_aggr",
      .syntax = "_ intersection_aggr[attribute]",
      .doc = "The common part of all defined values of an attribute: solids or sets of points.",
      .detail = "Undefined for a stream without a defined value. Other undefined values are left out, with a note.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator([](auto arguments) {
        return map_aggregate("intersection_aggr", arguments, &intersection_plan<Volume3d>,
                             &intersection_plan<Points3d>);
      }),
      .signatures = {"(stream(tuple) NAME) -> volume3d", "(stream(tuple) NAME) -> points3d"},
      .handles_undefined = true,
      .examples = {{"volume(" + kSolids + "head[2] intersection_aggr[V])", "4.0"},
                   {"size(" + kSolids + "intersection_aggr[V])", "0"},
                   {kNothing + "intersection_aggr[V]", "undefined"}},
      .errors = {{"query intstream(1, 2) transformstream intersection_aggr[Elem]",
                  "intersection_aggr: expected an attribute of type volume3d or points3d, got int"}},
  });
}

}  // namespace queries
