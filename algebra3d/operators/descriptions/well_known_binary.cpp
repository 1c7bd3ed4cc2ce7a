// fromWKB, surfaceFromWKB, meshFromWKB, pointsFromWKB, pointFromWKB, regionFromWKB, sridOfWKB, toWKB: well-known
// binary, the form in which PostGIS, GDAL and others exchange geometries.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/wkb.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

/// A fault of the bytes makes the value undefined; a fault of the statement stays an error.
template <typename T>
Result<Maybe<T>> defined_if_read(Result<Maybe<T>> read) {
  if (read.ok() || (read.error().code != ErrorCode::invalid_value && read.error().code != ErrorCode::limit_exceeded))
    return read;
  return Maybe<T>(Undefined{read.error().text()});
}

/// The reader of the operator that gives a T: its name, the geometries that it takes, and the value of one.
template <typename T>
struct WkbOf;

template <>
struct WkbOf<Volume3d> {
  static constexpr const char* kName = "fromWKB";
  static constexpr WkbContents kContents = WkbContents::faces;
  static Result<Maybe<Volume3d>> value(Context& context, const WkbGeometry& geometry) {
    A3D_ASSIGN(const PolygonMesh mesh, mesh_of_wkb(geometry, WkbHoles::triangulated, context.monitor()));
    A3D_ASSIGN(TriangleMesh triangles, welded_triangles_of(mesh, context.monitor()));
    A3D_ASSIGN(auto solid, Volume3d::prove(std::move(triangles), {.cancel = context.cancel}));
    if (solid) return solid;
    return Maybe<Volume3d>(Undefined{solid.reason() + "; surfaceFromWKB and meshFromWKB take faces that bound none"});
  }
};

template <>
struct WkbOf<Surface3d> {
  static constexpr const char* kName = "surfaceFromWKB";
  static constexpr WkbContents kContents = WkbContents::faces;
  static Result<Maybe<Surface3d>> value(Context& context, const WkbGeometry& geometry) {
    A3D_ASSIGN(const PolygonMesh mesh, mesh_of_wkb(geometry, WkbHoles::triangulated, context.monitor()));
    A3D_ASSIGN(TriangleMesh triangles, welded_triangles_of(mesh, context.monitor()));
    return Surface3d::prove(std::move(triangles), {.cancel = context.cancel});
  }
};

template <>
struct WkbOf<Mesh3d> {
  static constexpr const char* kName = "meshFromWKB";
  static constexpr WkbContents kContents = WkbContents::faces;
  static Result<Maybe<Mesh3d>> value(Context& context, const WkbGeometry& geometry) {
    A3D_ASSIGN(PolygonMesh mesh, mesh_of_wkb(geometry, WkbHoles::refused, context.monitor()));
    return Maybe<Mesh3d>(Mesh3d(std::move(mesh)));
  }
};

template <>
struct WkbOf<Points3d> {
  static constexpr const char* kName = "pointsFromWKB";
  static constexpr WkbContents kContents = WkbContents::points;
  static Result<Maybe<Points3d>> value(Context& context, const WkbGeometry& geometry) {
    if (geometry.has_lines) context.diagnostics.report("pointsFromWKB: of lines only the points are kept");
    return Maybe<Points3d>(Points3d(std::vector<ExactPoint>(geometry.points.begin(), geometry.points.end())));
  }
};

template <>
struct WkbOf<Point3d> {
  static constexpr const char* kName = "pointFromWKB";
  static constexpr WkbContents kContents = WkbContents::point;
  static Result<Maybe<Point3d>> value(Context& /*context*/, const WkbGeometry& geometry) {
    if (geometry.points.empty()) return Maybe<Point3d>(Undefined{"the point is empty"});
    return Maybe<Point3d>(Point3d{geometry.points.front()});
  }
};

template <>
struct WkbOf<Region> {
  static constexpr const char* kName = "regionFromWKB";
  static constexpr WkbContents kContents = WkbContents::region;
  static Result<Maybe<Region>> value(Context& context, const WkbGeometry& geometry) {
    return Region::prove(polygons_of_wkb(geometry), context.monitor());
  }
};

/// Errors: invalid_value.
Result<Srid> checked_srid(std::int64_t srid, const char* op) {
  if (srid >= 0 && srid <= kMaxSrid) return static_cast<Srid>(srid);
  return Error{ErrorCode::invalid_value, "{}: expected a SRID from 0 (none) to {}, got {}", op, kMaxSrid, srid};
}

template <typename T>
Result<Maybe<T>> value_of_wkb(Context& context, std::string_view bytes, Srid srid) {
  A3D_ASSIGN(const WkbGeometry geometry, read_wkb(bytes, WkbOf<T>::kContents, srid, context.monitor()));
  return WkbOf<T>::value(context, geometry);
}

template <typename T>
Result<Maybe<T>> from_bytes_of(Context& context, const Bytes& bytes, std::int64_t srid) {
  A3D_ASSIGN(const Srid checked, checked_srid(srid, WkbOf<T>::kName));
  return defined_if_read(value_of_wkb<T>(context, bytes.content, checked));
}
template <typename T>
Result<Maybe<T>> from_hex_of(Context& context, const Text& text, std::int64_t srid) {
  A3D_ASSIGN(const Srid checked, checked_srid(srid, WkbOf<T>::kName));
  const auto bytes = bytes_of_hex(text.content);
  if (!bytes) return Maybe<T>(Undefined{bytes.error().text()});
  return defined_if_read(value_of_wkb<T>(context, *bytes, checked));
}
template <typename T>
Result<Maybe<T>> from_bytes(Context& context, const Bytes& bytes) {
  return from_bytes_of<T>(context, bytes, 0);
}
template <typename T>
Result<Maybe<T>> from_hex(Context& context, const Text& text) {
  return from_hex_of<T>(context, text, 0);
}

template <typename T>
std::vector<Overload> from_overloads() {
  return {overload<&from_bytes<T>>("bytes"), overload<&from_bytes_of<T>>("bytes", "srid"),
          overload<&from_hex<T>>("digits"), overload<&from_hex_of<T>>("digits", "srid")};
}

Maybe<std::int64_t> srid_in(std::string_view bytes) {
  const auto srid = srid_of_wkb(bytes);
  if (!srid) return Undefined{srid.error().text()};
  return static_cast<std::int64_t>(*srid);
}
Maybe<std::int64_t> srid_of_bytes(const Bytes& bytes) {
  return srid_in(bytes.content);
}
Maybe<std::int64_t> srid_of_digits(const Text& text) {
  const auto bytes = bytes_of_hex(text.content);
  if (!bytes) return Undefined{bytes.error().text()};
  return srid_in(*bytes);
}

/// Tells that corners were rounded. `reason`: why the result is not a valid value; empty if it is one.
void report_wkb_rounding(Context& context, std::size_t count, const char* noun, const std::string& reason) {
  if (count > 0)
    context.diagnostics.report(fmt::format("toWKB: rounded {} to doubles{}", algebra3d::counted(count, noun), reason));
}

/// Why the mesh with rounded vertices is not a value of type T; empty if it is one.
template <typename T>
Result<std::string> rounding_fault(Context& context, const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    triangles.push_back(mesh.triangle(FaceId(f)));
  }
  WeldedTriangles welded = weld(mesh.points().approx(), triangles);
  A3D_ASSIGN(const auto proved,
             T::prove(TriangleMesh(std::move(welded.points), welded.triangles), {.cancel = context.cancel}));
  return proved ? std::string() : "; the result is not valid, that of roundCoordinates is: " + proved.reason();
}

// The WKB of a value, with diagnostics of what was rounded.

template <typename T>
Status report_vertices(Context& context, const T& value) {
  const std::size_t count = value.mesh().points().exact_count();
  if (count == 0) return {};
  A3D_ASSIGN(const std::string fault, rounding_fault<T>(context, value.mesh()));
  report_wkb_rounding(context, count, "corner", fault);
  return {};
}

Result<std::string> wkb_of(Context& context, const Volume3d& solid, Srid srid) {
  A3D_TRY(report_vertices(context, solid));
  return wkb_of_solid(solid.mesh(), srid);
}
Result<std::string> wkb_of(Context& context, const Surface3d& surface, Srid srid) {
  A3D_TRY(report_vertices(context, surface));
  return wkb_of_surface(surface.mesh(), srid);
}
Result<std::string> wkb_of(Context& context, const Mesh3d& mesh, Srid srid) {
  report_wkb_rounding(context, mesh.mesh().points().exact_count(), "corner", {});
  return wkb_of_mesh(mesh.mesh(), srid);
}
Result<std::string> wkb_of(Context& context, const Points3d& points, Srid srid) {
  std::size_t exact = 0;
  for (std::size_t i = 0; i < points.points().size(); ++i) {
    poll_interruption_at(i);
    exact += points.points()[i].is_double() ? 0 : 1;
  }
  report_wkb_rounding(context, exact, "point", {});
  return wkb_of_points(points.points(), srid);
}
Result<std::string> wkb_of(Context& context, const Point3d& point, Srid srid) {
  report_wkb_rounding(context, point.position.is_double() ? 0 : 1, "point", {});
  return wkb_of_point(point.position, srid);
}
Result<std::string> wkb_of(Context& context, const Region& region, Srid srid) {
  const Polygons& polygons = region.polygons();
  if (const std::size_t count = polygons.corners.exact_count(); count > 0) {
    Polygons rounded = polygons;
    rounded.corners = PointArray(polygons.corners.approx());
    A3D_ASSIGN(const auto proved, Region::prove(rounded, context.monitor()));
    report_wkb_rounding(context, count, "corner", proved ? "" : "; the result bounds no region: " + proved.reason());
  }
  return wkb_of_region(polygons, srid);
}

template <typename T>
Result<Bytes> to_wkb_with(Context& context, const T& value, std::int64_t srid) {
  A3D_ASSIGN(const Srid checked, checked_srid(srid, "toWKB"));
  A3D_ASSIGN(std::string bytes, wkb_of(context, value, checked));
  return Bytes{std::move(bytes)};
}
template <typename T>
Result<Bytes> to_wkb(Context& context, const T& value) {
  return to_wkb_with(context, value, 0);
}

template <typename... T>
std::vector<Overload> to_overloads(const std::vector<const char*>& names) {
  std::vector<Overload> overloads;
  std::size_t place = 0;
  ((overloads.push_back(overload<&to_wkb<T>>(names[place])),
    overloads.push_back(overload<&to_wkb_with<T>>(names[place++], "srid"))),
   ...);
  return overloads;
}

constexpr const char* kFromDetail =
    "WKB with ISO's codes of types, and the extended form of PostGIS, in both byte orders; a text has its hexadecimal "
    "digits, as PostGIS prints a geometry. The SRID must be the one that is given, and there must be none if none, or "
    "0, is given, so that no SRID is lost unseen: `sridOfWKB` tells it. Undefined, with the byte (from 0), what was "
    "found there and what was expected, for other kinds of geometries, curves, coordinates M, rings that do not repeat "
    "their first point, parts with another SRID, numbers that are not finite, nesting deeper than 32, and bytes that "
    "are left over.";

const std::string kUndefinedWkb = "(bytes undefined)";
// By PostGIS 3.3: ST_AsEWKB('SRID=4326;POINT Z (1 2 3.5)').
const std::string kPointDigits = "01010000a0e6100000000000000000f03f00000000000000400000000000000c40";
// By GDAL 3.6: TIN Z (((0 0 0,1 0 0,0 1 0,0 0 0))), in ISO's form, big-endian.
const std::string kTriangleDigits = "00000003f80000000100000003f90000000100000004" + std::string(48, '0') +
                                    "3ff0000000000000" + std::string(32, '0') + std::string(16, '0') +
                                    "3ff0000000000000" + std::string(16, '0') + std::string(48, '0');

/// The parts of the description that most readers share.
template <typename T>
Operator reader_of(std::string doc, const std::string& detail) {
  const std::string name = WkbOf<T>::kName;
  Operator op;
  op.name = name;
  op.syntax = name + "(_ ...)";
  op.doc = std::move(doc);
  op.detail = detail + " " + kFromDetail;
  op.exactness = Exactness::exact;
  op.frame_use = FrameUse::coordinates;
  op.cost = Cost::sorting;
  op.sources = {"ogc06103", "postgis2022"};
  op.overloads = from_overloads<T>();
  op.errors = {{{"5"}, name + ": expected (bytes), (bytes int), (text) or (text int), got (int)"},
               {{"'00'", "-1"}, name + ": expected a SRID from 0 (none) to 999999, got -1"}};
  return op;
}

void register_readers_of_faces(OperatorGroup& group) {
  Operator solids = reader_of<Volume3d>(
      "The solid that the faces of a POLYHEDRALSURFACE, TIN or MULTIPOLYGON in well-known binary (WKB) bound.",
      "All with Z; collections of these, too. Equal corners are welded and polygons triangulated, also those with "
      "holes, as by mesh2volume; nothing is repaired. Undefined, with the defects, if the faces do not bound a solid "
      "with the faces outward.");
  solids.examples = {{{"(toWKB " + kUnitCube + ")"}, "1.0", "(volume _)"},
                     {{"(toWKB " + kUnitCube + " 4326)", "4326"}, "1.0", "(volume _)"},
                     {{"(toWKB " + kUnitCube + " 4326)"}, "undefined"},
                     {{"(bytes2hex (toWKB " + kCubeOfTwo + "))"}, "8.0", "(volume _)"},
                     {{"'" + kTriangleDigits + "'"}, "undefined"},
                     {{"'01ff'", "0"}, "undefined"},
                     {{kUndefinedWkb}, "undefined"}};
  group.add(std::move(solids));
  Operator surfaces = reader_of<Surface3d>(
      "The surface of the faces of a POLYHEDRALSURFACE, TIN, MULTIPOLYGON, POLYGON or TRIANGLE in well-known binary "
      "(WKB).",
      "All with Z; collections of these, too. Equal corners are welded and polygons triangulated, also those with "
      "holes; nothing is repaired. Undefined, with the defects, if the triangles do not make a valid surface.");
  surfaces.examples = {{{"'" + kTriangleDigits + "'"}, "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)))"},
                       {{"(toWKB (surface3d (((0 0 0) (1 0 0) (0 1 0)))) 3857)", "3857"}, "0.5", "(area _)"},
                       {{"(toWKB (surface3d (((0 0 0) (1 0 0) (0 1 0)))))"}, "0.5", "(area _)"},
                       {{"'" + kTriangleDigits + "'", "0"}, "1", "(size _)"},
                       {{kUndefinedWkb}, "undefined"}};
  group.add(std::move(surfaces));
  Operator meshes = reader_of<Mesh3d>(
      "The mesh of the polygons of a POLYHEDRALSURFACE, TIN, MULTIPOLYGON, POLYGON or TRIANGLE in well-known binary "
      "(WKB).",
      "All with Z; collections of these, too. Polygons keep their order; equal corners become one vertex, in order of "
      "first use. Polygons with holes are refused.");
  meshes.examples = {{{"(toWKB (mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2 3)))))"},
                      "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))"},
                     {{"'" + kTriangleDigits + "'"}, "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)))"},
                     {{"(toWKB (mesh3d (() ())))", "4326"}, "undefined"},
                     {{kUndefinedWkb}, "undefined"}};
  group.add(std::move(meshes));
}

void register_other_readers(OperatorGroup& group) {
  Operator points = reader_of<Points3d>(
      "The points of a MULTIPOINT, POINT, LINESTRING or MULTILINESTRING in well-known binary (WKB).",
      "All with Z; collections of these, too. Empty points are left out. Of lines only the points are kept, which a "
      "diagnostic tells.");
  points.examples = {{{"(toWKB (points3d ((1 2 3) (0 0 0))))"}, "((0.0 0.0 0.0) (1.0 2.0 3.0))"},
                     {{"'" + kPointDigits + "'", "4326"}, "((1.0 2.0 3.5))"},
                     {{"'" + kPointDigits + "'"}, "undefined"},
                     {{kUndefinedWkb}, "undefined"}};
  group.add(std::move(points));
  Operator point =
      reader_of<Point3d>("The point of a POINT with Z in well-known binary (WKB).", "Undefined for an empty point.");
  point.cost = Cost::linear;
  point.examples = {{{"'" + kPointDigits + "'", "4326"}, "(1.0 2.0 3.5)"},
                    {{"(toWKB (makePoint3D 1 2 3))"}, "(1.0 2.0 3.0)"},
                    {{"(toWKB (points3d ((1 2 3))))"}, "undefined"},
                    {{kUndefinedWkb}, "undefined"}};
  group.add(std::move(point));
  Operator region = reader_of<Region>(
      "The region of a MULTIPOLYGON or POLYGON in well-known binary (WKB).",
      "Collections of these, too. Z is ignored, as by wkt2region. Undefined, with the segments, for polygons that "
      "bound no region, such as polygons that overlap or share a side.");
  region.examples = {{{"(toWKB " + kUnitRegion + " 25832)", "25832"}, "1.0", "(area _)"},
                     {{"(toWKB (region ((((0 0) (4 0) (4 4)) ((2 1) (3 1) (3 2.5))))))"}, "7.25", "(area _)"},
                     {{"'" + kPointDigits + "'", "4326"}, "undefined"},
                     {{kUndefinedWkb}, "undefined"}};
  group.add(std::move(region));
}

}  // namespace

void register_well_known_binary(OperatorGroup& group) {
  register_readers_of_faces(group);
  register_other_readers(group);
  group.add({
      .name = "sridOfWKB",
      .syntax = "sridOfWKB(_)",
      .doc = "The spatial reference identifier (SRID) of a geometry in well-known binary (WKB); 0 if it has none.",
      .detail = "Looks at the beginning only. Undefined, with the byte, if no geometry begins there. A text has the "
                "hexadecimal digits. `fromWKB` of the bytes and this number reads any SRID; the number is to be kept "
                "beside the value.",
      .exactness = Exactness::exact,
      .sources = {"ogc06103", "postgis2022"},
      .overloads = {overload<&srid_of_bytes>("bytes"), overload<&srid_of_digits>("digits")},
      .examples = {{{"'" + kPointDigits + "'"}, "4326"},
                   {{"(toWKB (makePoint3D 1 2 3))"}, "0"},
                   {{"'01'"}, "undefined"},
                   {{kUndefinedWkb}, "undefined"}},
      .errors = {{{"5"}, "sridOfWKB: expected (bytes) or (text), got (int)"}},
  });
  group.add({
      .name = "toWKB",
      .syntax = "toWKB(_ ...)",
      .doc = "A value in well-known binary (WKB), in PostGIS's extended form, with a spatial reference identifier "
             "(SRID) if one is given.",
      .detail =
          "Little-endian. A solid is a POLYHEDRALSURFACE Z with one polygon for each of its triangles, outward from "
          "the "
          "solid: those of all bodies and cavities together, which `fromWKB` reads back; `components` divides it "
          "before, "
          "where one geometry for each body is wanted. A surface is a TIN Z, a mesh a POLYHEDRALSURFACE Z of its "
          "faces, "
          "points are a MULTIPOINT Z, a point is a POINT Z, a region a MULTIPOLYGON. Coordinates that are not doubles "
          "are rounded to the nearest double; a diagnostic says so, and whether the result is still a solid, surface "
          "or region. A SRID of 0 means that there is none.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .cost = Cost::sorting,
      .sources = {"ogc06103", "postgis2022"},
      .overloads = to_overloads<Volume3d, Surface3d, Mesh3d, Points3d, Point3d, Region>(
          {"solid", "surface", "mesh", "points", "point", "region"}),
      .examples = {{{"(makePoint3D 1 2 3.5)", "4326"}, "'" + kPointDigits + "'"},
                   {{kUnitCube}, "TRUE", "(startsWith (bytes2hex _) '010f0000800c000000')"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0))))"}, "1", "(size (surfaceFromWKB _))"},
                   {{"(mesh3d (((0 0 0) (1 0 0) (0 1 0)) ((0 1 2))))"}, "1", "(size (meshFromWKB _))"},
                   {{"(points3d ((1 2 3)))"},
                    "'0104000080010000000101000080000000000000f03f00000000000000400000000000000840'"},
                   {{kUnitRegion}, "1.0", "(area (regionFromWKB _))"},
                   {{"(makePoint3D 1 2 3)", "(int undefined)"}, "undefined"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{kUnitCube, "1000000"}, "toWKB: expected a SRID from 0 (none) to 999999, got 1000000"}},
  });
}

}  // namespace algebra3d
