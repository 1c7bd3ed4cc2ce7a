#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/planar/polygons.h"

namespace algebra3d {

// Well-known binary of geometries (WKB) with ISO's codes of types, and PostGIS's extended form (EWKB), which has flags
// for Z and M and a spatial reference identifier (SRID). Source: [ogc06103], section 8; [postgis2022]. A SRID of 0
// means none.

/// A spatial reference identifier.
enum class Srid : unsigned { none = 0 };
/// The number of the largest one that PostGIS keeps.
inline constexpr std::int64_t kMaxSrid = 999'999;

/// The geometries that a reader takes; collections of such geometries, too, but for a single point. Coordinates M and
/// curves are refused.
enum class WkbContents : std::uint8_t {
  faces,   ///< POLYHEDRALSURFACE, TIN, MULTIPOLYGON, POLYGON and TRIANGLE, all with Z
  points,  ///< MULTIPOINT, POINT, LINESTRING and MULTILINESTRING, all with Z
  point,   ///< POINT with Z
  region,  ///< MULTIPOLYGON and POLYGON; Z is ignored
};

/// The points and polygons of a WKB, in its order. Coordinates are finite.
struct WkbGeometry {
  std::vector<Vec3> points;                ///< those of rings, or else single points; z is 0 in a region
  std::vector<std::size_t> ring_ends;      ///< per ring: one past its last point; the first is not repeated
  std::vector<std::size_t> polygon_ends;   ///< per polygon: one past its last ring; its first ring is the outer one
  std::vector<std::size_t> polygon_bytes;  ///< per polygon: the byte at which it begins
  bool has_lines = false;                  ///< some of the points were joined to lines

  std::size_t polygon_count() const { return polygon_ends.size(); }
  std::size_t first_point(std::size_t ring) const { return ring == 0 ? 0 : ring_ends[ring - 1]; }
  std::size_t first_ring(std::size_t polygon) const { return polygon == 0 ? 0 : polygon_ends[polygon - 1]; }
};

/// The SRID of a WKB, or none. Looks at the beginning only. Errors: invalid_value.
Result<Srid> srid_of_wkb(std::string_view bytes);

/// Reads a WKB. Domain: any bytes, in both byte orders; nesting up to 32. Its SRID must be `srid`, so that no SRID is
/// dropped unseen. Each ring repeats its first point; adjacent equal points become one corner, and at least three must
/// be left. Errors: invalid_value with the byte (from 0), what was found and what was expected; limit_exceeded;
/// interrupted. Cost: linear; counts are checked against the bytes that follow before memory is reserved.
Result<WkbGeometry> read_wkb(std::string_view bytes, WkbContents contents, Srid srid, const Monitor& monitor = {});

/// The treatment of polygons with holes.
enum class WkbHoles : std::uint8_t { refused, triangulated };

/// The polygons as faces of a mesh, over their different points in order of first use. Polygons with holes become
/// triangles (ring_triangulation.h). Errors: invalid_value with the byte of a polygon that is refused, or whose rings
/// cross; limit_exceeded; interrupted. Cost: linear, n log n for polygons with holes.
Result<PolygonMesh> mesh_of_wkb(const WkbGeometry& geometry, WkbHoles holes, const Monitor& monitor = {});
/// The polygons of a region; it is not proved.
Polygons polygons_of_wkb(const WkbGeometry& geometry);

// Writers: the extended form, little-endian, with the flag for Z but for regions, and with the SRID, if there is one,
// at its beginning. Exact coordinates are rounded to the nearest doubles. Errors: limit_exceeded for want of memory.

/// POLYHEDRALSURFACE Z with a polygon for each triangle, in their order.
Result<std::string> wkb_of_solid(const TriangleMesh& mesh, Srid srid);
/// TIN Z.
Result<std::string> wkb_of_surface(const TriangleMesh& mesh, Srid srid);
/// POLYHEDRALSURFACE Z with a polygon for each face; points that no face uses are not written.
Result<std::string> wkb_of_mesh(const PolygonMesh& mesh, Srid srid);
/// MULTIPOINT Z.
Result<std::string> wkb_of_points(std::span<const ExactPoint> points, Srid srid);
/// POINT Z.
std::string wkb_of_point(const ExactPoint& point, Srid srid);
/// MULTIPOLYGON.
Result<std::string> wkb_of_region(const Polygons& polygons, Srid srid);

}  // namespace algebra3d
