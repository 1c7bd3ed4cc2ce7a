// makeRegion: a region from the points of a stream.
#include <fmt/format.h>

#include "algebra3d/types/planar.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Maybe;
using algebra3d::Point2d;
using algebra3d::Polygons;
using algebra3d::Region;

/// One cycle of the defined points; undefined ones are left out and counted in a diagnostic.
Result<Polygons> cycle_of(const Datum& stream, std::size_t attribute, Context& context) {
  Polygons polygons;
  std::size_t undefined = 0;
  RETURN_IF_ERROR(for_each_tuple(*stream.tuples(), context, [&](const TuplePtr& tuple) -> Status {
    const Value& corner = tuple->attributes[attribute];
    if (!corner.is_defined()) return ++undefined, Status();
    polygons.corners.push_back(corner.get<Point2d>().position);
    return {};
  }));
  if (undefined > 0)
    context.diagnostics.report(
        fmt::format("makeRegion: left out {} undefined value{}", undefined, undefined == 1 ? "" : "s"));
  polygons.cycle_ends = {static_cast<std::uint32_t>(polygons.corners.size())};
  polygons.face_ends = {1};
  return polygons;
}

Result<Plan> map_make_region(std::span<const ArgumentType> arguments) {
  const MappingCheck check("makeRegion", arguments);
  ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ASSIGN_OR_RETURN(const std::size_t attribute, check.attribute(1, tuple));
  const TypeExpr& type = tuple.attributes()[attribute].type;
  if (!type.is("point")) return check.expected("an attribute of type point", type);
  return Plan{TypeExpr("region"), [attribute](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
                ASSIGN_OR_RETURN(const Polygons polygons, cycle_of(given[0], attribute, context));
                ASSIGN_OR_RETURN(const Maybe<Region> region, Region::prove(polygons, context.monitor()));
                if (region) return Datum{Value::of<Region>(*region)};
                context.diagnostics.report_undefined("makeRegion: " + region.reason());
                return Datum{Value(algebra3d::TypeOf<Region>::type())};
              }};
}

const std::string kSquareCorners =
    "intstream(0, 3) transformstream extend[P: makePoint(4 * (.Elem div 2), 4 * ((.Elem + 1) div 2 mod 2))] ";

}  // namespace

void register_make_regions(algebra3d::Registry& registry) {
  registry.add({
      .name = "makeRegion",
      .syntax = "_ makeRegion[attribute]",
      .doc = "The region round which the points of an attribute run, in the order of the stream.",
      .detail =
          "One cycle in either sense, whose first point is not repeated. Undefined, with the reason, if it bounds "
          "no region: of fewer than three points, or where segments meet. Undefined points are left out, with a "
          "note.",
      .exactness = algebra3d::Exactness::exact,
      .stream = stream_operator(map_make_region),
      .signatures = {"(stream(tuple) NAME) -> region"},
      .handles_undefined = true,
      .examples = {{kSquareCorners + "makeRegion[P]", "((((0.0 0.0) (4.0 0.0) (4.0 4.0) (0.0 4.0))))"},
                   {kSquareCorners + "head[2] makeRegion[P]", "undefined"}},
      .errors = {{"query intstream(1, 3) transformstream makeRegion[Elem]",
                  "makeRegion: expected an attribute of type point, got int"}},
  });
}

}  // namespace queries
