// wkt2region, region2wkt, geojson2region: regions as texts that other programs read and write.
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/conversions/geojson.h"
#include "algebra3d/values/conversions/wkt.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<Maybe<Region>> region_of_wkt(Context& context, const Text& text) {
  const Result<Polygons> polygons = polygons_from_wkt(text.content);
  if (!polygons) return Maybe<Region>(Undefined{polygons.error().text()});
  return Region::prove(*polygons, context.monitor());
}

/// Tells that corners were rounded, and whether what they bound is still a region.
Status report_rounding(Context& context, const Polygons& polygons) {
  Polygons rounded = polygons;
  rounded.corners = PointArray(polygons.corners.approx());
  A3D_ASSIGN(const auto region, Region::prove(rounded, context.monitor()));
  const std::size_t count = polygons.corners.exact_count();
  context.diagnostics.report(fmt::format("region2wkt: rounded {} corner{} to doubles{}", count, count == 1 ? "" : "s",
                                         region ? "" : "; the result bounds no region: " + region.reason()));
  return {};
}

Result<Text> wkt_of_region(Context& context, const Region& region) {
  const Polygons& polygons = region.polygons();
  if (polygons.corners.exact_count() > 0) A3D_TRY(report_rounding(context, polygons));
  return Text{wkt_of(polygons)};
}

Result<Maybe<Region>> region_of_geojson_text(Context& context, const Text& text) {
  return region_of_geojson(text.content, context.monitor());
}

void register_wkt(OperatorGroup& group) {
  group.add({
      .name = "wkt2region",
      .syntax = "wkt2region(_)",
      .doc = "Converts a POLYGON or MULTIPOLYGON in well-known text (WKT) to a region.",
      .detail =
          "Words may be in any case, white space is ignored, and a prefix `SRID=n;` is skipped. Coordinates after "
          "the second (Z, M, ZM) are ignored. Rings repeat their first point; adjacent equal points are one corner. "
          "Numbers become the nearest doubles. Undefined, with the character and what was expected there, for a "
          "malformed text; and, with the segments, for polygons that bound no region, such as polygons that overlap "
          "or share a side.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .sources = {"ogc06103"},
      .overloads = {overload<&region_of_wkt>("text")},
      .examples = {{{"'POLYGON ((0 0, 4 0, 4 4, 0 0))'"}, "((((0.0 0.0) (4.0 0.0) (4.0 4.0))))"},
                   {{"'MultiPolygon Z (((0 0 7, 4 0 7, 4 4 7, 0 0 7)), ((5 0 7, 6 0 7, 6 1 7, 5 0 7)))'"},
                    "8.5",
                    "(area _)"},
                   {{"'POLYGON EMPTY'"}, "()"},
                   {{"'POLYGON ((0 0, 4 0, 4 4))'"}, "undefined"},
                   {{"'POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))'"}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"1"}, "wkt2region: expected (text), got (int)"}},
  });
  group.add({
      .name = "region2wkt",
      .syntax = "region2wkt(_)",
      .doc = "A region as well-known text: POLYGON if it has one face, else MULTIPOLYGON.",
      .detail =
          "Outer rings run counter-clockwise, holes clockwise. Numbers have the shortest digits that read back as "
          "the same double. Coordinates that are not doubles are rounded to the nearest double; a diagnostic says "
          "so, and whether the result is still a region.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .sources = {"ogc06103"},
      .overloads = {overload<&wkt_of_region>("region")},
      .examples = {{{"(region ((((0 0) (4 0) (4 4)) ((2 1) (3 1) (3 2.5)))))"},
                    "'POLYGON ((0 0, 4 0, 4 4, 0 0), (2 1, 3 2.5, 3 1, 2 1))'"},
                   {{"(region ())"}, "'MULTIPOLYGON EMPTY'"},
                   {{"(region undefined)"}, "undefined"}},
      .errors = {{{"1"}, "region2wkt: expected (region), got (int)"}},
  });
}

}  // namespace

void register_region_texts(OperatorGroup& group) {
  register_wkt(group);
  group.add({
      .name = "geojson2region",
      .syntax = "geojson2region(_)",
      .doc = "Converts a GeoJSON geometry, or the geometry of one Feature, to a region.",
      .detail =
          "The geometry is a Polygon, MultiPolygon, or a GeometryCollection of these. Coordinates after the second "
          "are ignored. Rings repeat their first position; adjacent equal positions are one corner. Numbers become "
          "the nearest doubles. Undefined, with the place and what was expected there, for other texts; and, with "
          "the segments, for polygons that bound no region. `importGeoJSON` reads files and collections of features.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .sources = {"rfc7946"},
      .overloads = {overload<&region_of_geojson_text>("text")},
      .examples = {{{R"('{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 0]]]}')"},
                    "((((0.0 0.0) (4.0 0.0) (4.0 4.0))))"},
                   {{R"('{"type": "Point", "coordinates": [0, 0]}')"}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"1"}, "geojson2region: expected (text), got (int)"}},
  });
}

}  // namespace algebra3d
