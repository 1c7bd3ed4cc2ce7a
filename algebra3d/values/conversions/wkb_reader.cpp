#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/values/conversions/detail/ring_triangulation.h"
#include "algebra3d/values/conversions/detail/soup_mesh.h"
#include "algebra3d/values/conversions/detail/wkb_kinds.h"
#include "algebra3d/values/conversions/wkb.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

constexpr int kMaxWkbDepth = 32;
constexpr std::size_t kTypeOffset = 1, kSridOffset = 5, kWordBytes = 4;
/// The size of the smallest part of a collection: byte order, type and count.
constexpr std::size_t kLeastPartBytes = 9;

std::string_view name_of_code(std::size_t code) {
  constexpr std::array<std::string_view, 18> kNames = {"",
                                                       "POINT",
                                                       "LINESTRING",
                                                       "POLYGON",
                                                       "MULTIPOINT",
                                                       "MULTILINESTRING",
                                                       "MULTIPOLYGON",
                                                       "GEOMETRYCOLLECTION",
                                                       "CIRCULARSTRING",
                                                       "COMPOUNDCURVE",
                                                       "CURVEPOLYGON",
                                                       "MULTICURVE",
                                                       "MULTISURFACE",
                                                       "CURVE",
                                                       "SURFACE",
                                                       "POLYHEDRALSURFACE",
                                                       "TIN",
                                                       "TRIANGLE"};
  return code < kNames.size() ? kNames.at(code) : "";
}

/// The head before the content of a geometry and of each of its parts.
struct WkbHeader {
  std::size_t begin = 0;  ///< its byte
  bool is_big_endian = false;
  std::size_t code = 0;  ///< of the kind, one that has a name
  bool has_z = false, has_m = false;
  std::optional<Srid> srid;

  std::string text() const {
    return fmt::format("{}{}{}{}", name_of_code(code), has_z || has_m ? " " : "", has_z ? "Z" : "", has_m ? "M" : "");
  }
};

using WkbKinds = std::vector<WkbKind>;

const WkbKinds& kinds_of(WkbContents contents) {
  using enum WkbKind;
  static const WkbKinds faces = {polyhedral_surface, tin, multi_polygon, polygon, triangle, geometry_collection};
  static const WkbKinds points = {multi_point, point, line_string, multi_line_string, geometry_collection};
  static const WkbKinds one_point = {point};
  static const WkbKinds region = {multi_polygon, polygon, geometry_collection};
  switch (contents) {
    case WkbContents::faces:
      return faces;
    case WkbContents::points:
      return points;
    case WkbContents::point:
      return one_point;
    case WkbContents::region:
      break;
  }
  return region;
}

std::string kind_names(const WkbKinds& kinds, bool has_z) {
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    text += fmt::format("{}{}{}",
                        i == 0                  ? ""
                        : i + 1 == kinds.size() ? " or "
                                                : ", ",
                        name_of_code(static_cast<std::size_t>(kinds[i])), has_z ? " Z" : "");
  return text;
}

Error unexpected(std::size_t byte, std::string_view found, std::string_view wanted) {
  return {ErrorCode::invalid_value, "byte {}: found {}, expected {}", byte, found, wanted};
}

std::string srid_text(Srid srid) {
  return srid == Srid::none ? "no SRID" : fmt::format("SRID {}", static_cast<std::size_t>(srid));
}

/// Reads the numbers of a WKB in order.
class WkbCursor {
 public:
  explicit WkbCursor(std::string_view bytes) : bytes_(bytes) {}

  std::size_t position() const { return position_; }
  std::size_t remaining() const { return bytes_.size() - position_; }

  /// Errors: invalid_value if fewer bytes are left.
  Status require(std::size_t count, std::string_view what) const {
    if (remaining() >= count) return {};
    return unexpected(bytes_.size(), "the end", fmt::format("{} of {} bytes from byte {}", what, count, position_));
  }

  // Numbers; their bytes must have been required (asserted).
  std::size_t u32(bool is_big_endian) { return fixed<4>(is_big_endian); }
  double f64(bool is_big_endian) { return std::bit_cast<double>(fixed<8>(is_big_endian)); }

  /// Errors: invalid_value.
  Result<WkbHeader> header();

 private:
  template <std::size_t width>
  std::uint64_t fixed(bool is_big_endian) {
    assert(remaining() >= width);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[position_ + (is_big_endian ? i : width - 1 - i)]);
      value = value << 8U | byte;
    }
    position_ += width;
    return value;
  }

  std::string_view bytes_;
  std::size_t position_ = 0;
};

Result<WkbHeader> WkbCursor::header() {
  WkbHeader header;
  header.begin = position_;
  A3D_TRY(require(kSridOffset, "a byte order and a type"));
  const auto order = static_cast<unsigned char>(bytes_[position_++]);
  if (order > 1)
    return unexpected(header.begin, fmt::format("{:#04x}", order), "a byte order: 0 (big-endian) or 1 (little-endian)");
  header.is_big_endian = order == 0;
  const std::size_t type = u32(header.is_big_endian);
  const std::size_t plain = type & ~std::size_t{kWkbZ | kWkbM | kWkbSrid};
  // ISO: 1000 for Z, 2000 for M, 3000 for both.
  const std::size_t coordinates = plain / 1000;
  header.code = plain % 1000;
  header.has_z = (type & kWkbZ) != 0 || coordinates == 1 || coordinates == 3;
  header.has_m = (type & kWkbM) != 0 || coordinates == 2 || coordinates == 3;
  if (coordinates > 3 || name_of_code(header.code).empty())
    return unexpected(header.begin + kTypeOffset, fmt::format("the type {:#x}", type), "the type of a geometry");
  if ((type & kWkbSrid) != 0) {
    A3D_TRY(require(kWordBytes, "a SRID"));
    header.srid = static_cast<Srid>(u32(header.is_big_endian));
  }
  return header;
}

std::string text_of_point(const Vec3& point, bool has_z) {
  return has_z ? fmt::format("({} {} {})", real_text(point.x), real_text(point.y), real_text(point.z))
               : fmt::format("({} {})", real_text(point.x), real_text(point.y));
}

class WkbReader {
 public:
  WkbReader(std::string_view bytes, WkbContents contents, Srid srid)
      : cursor_(bytes), contents_(contents), srid_(srid) {}

  Result<WkbGeometry> read() {
    A3D_TRY(read_geometry(kinds_of(contents_), 1));
    if (cursor_.remaining() > 0)
      return unexpected(cursor_.position(), counted(cursor_.remaining(), "further byte"), "the end");
    return std::move(geometry_);
  }

 private:
  Result<WkbHeader> read_header(const WkbKinds& kinds, int depth);
  Status check_srid(const WkbHeader& header, bool is_outermost) const;
  Status read_geometry(const WkbKinds& kinds, int depth);
  Status read_parts(const WkbHeader& header, const WkbKinds& kinds, int depth);
  Status read_single_point(const WkbHeader& header);
  Status read_line(const WkbHeader& header);
  Status read_polygon(const WkbHeader& header);
  Status read_ring(const WkbHeader& header);
  /// A number of parts that take so many bytes each at least. Errors: invalid_value if the bytes that follow are too
  /// few.
  Result<std::size_t> read_count(const WkbHeader& header, std::size_t bytes_each, std::string_view noun);
  /// The coordinates, whose bytes must have been required. Errors: invalid_value for one that is not finite.
  Result<Vec3> read_coordinates(const WkbHeader& header);

  static std::size_t point_bytes(const WkbHeader& header) { return (header.has_z ? 3 : 2) * sizeof(double); }

  WkbCursor cursor_;
  WkbContents contents_;
  Srid srid_;
  std::optional<bool> has_z_;  // of the whole
  std::size_t step_ = 0;
  WkbGeometry geometry_;
};

Status WkbReader::check_srid(const WkbHeader& header, bool is_outermost) const {
  const Srid found = header.srid.value_or(Srid::none);
  // Parts need not repeat it.
  if (found == srid_ || (!is_outermost && !header.srid)) return {};
  if (found == Srid::none)
    return unexpected(header.begin + (header.srid ? kSridOffset : kTypeOffset), srid_text(found), srid_text(srid_));
  return unexpected(
      header.begin + kSridOffset, srid_text(found),
      is_outermost && srid_ == Srid::none ? "no SRID, since none was asked for as second argument" : srid_text(srid_));
}

Result<WkbHeader> WkbReader::read_header(const WkbKinds& kinds, int depth) {
  if (depth > kMaxWkbDepth)
    return unexpected(cursor_.position(), fmt::format("a geometry at depth {}", depth),
                      fmt::format("at most {}", kMaxWkbDepth));
  A3D_ASSIGN(const WkbHeader header, cursor_.header());
  const bool needs_z = contents_ != WkbContents::region;
  const auto kind = static_cast<WkbKind>(header.code);
  const std::size_t byte = header.begin + kTypeOffset;
  if (header.has_m || (needs_z && !header.has_z) || std::ranges::find(kinds, kind) == kinds.end())
    return unexpected(byte, header.text(), kind_names(kinds, needs_z));
  if (has_z_ && *has_z_ != header.has_z)
    return unexpected(byte, header.text(), *has_z_ ? "coordinates with Z, as before" : "no Z, as before");
  has_z_ = header.has_z;
  A3D_TRY(check_srid(header, depth == 1));
  return header;
}

Result<std::size_t> WkbReader::read_count(const WkbHeader& header, std::size_t bytes_each, std::string_view noun) {
  const std::size_t at = cursor_.position();
  A3D_TRY(cursor_.require(kWordBytes, "a count"));
  const std::size_t count = cursor_.u32(header.is_big_endian);
  if (count > cursor_.remaining() / bytes_each)
    return unexpected(
        at, fmt::format("a count of {} {}s", count, noun),
        fmt::format("at most {}, since {} bytes follow", cursor_.remaining() / bytes_each, cursor_.remaining()));
  return count;
}

Result<Vec3> WkbReader::read_coordinates(const WkbHeader& header) {
  poll_interruption_at(step_++);
  Vec3 point;
  for (std::size_t axis = 0; axis < (header.has_z ? 3U : 2U); ++axis) {
    const double number = cursor_.f64(header.is_big_endian);
    if (!std::isfinite(number))
      return unexpected(cursor_.position() - sizeof(double), real_text(number), "a finite number");
    if (axis < 2 || contents_ != WkbContents::region) point[axis] = number == 0 ? 0 : number;
  }
  return point;
}

// A point whose coordinates are all NaN is POINT EMPTY.
Status WkbReader::read_single_point(const WkbHeader& header) {
  A3D_TRY(cursor_.require(point_bytes(header), "the coordinates of a point"));
  WkbCursor ahead = cursor_;
  std::size_t nan_count = 0;
  for (std::size_t axis = 0; axis < (header.has_z ? 3U : 2U); ++axis)
    nan_count += std::isnan(ahead.f64(header.is_big_endian)) ? 1 : 0;
  if (nan_count == (header.has_z ? 3U : 2U)) {
    cursor_ = ahead;
    return {};
  }
  A3D_ASSIGN(const Vec3 point, read_coordinates(header));
  geometry_.points.push_back(point);
  return {};
}

Status WkbReader::read_line(const WkbHeader& header) {
  A3D_ASSIGN(const std::size_t count, read_count(header, point_bytes(header), "point"));
  for (std::size_t i = 0; i < count; ++i) {
    A3D_ASSIGN(const Vec3 point, read_coordinates(header));
    geometry_.points.push_back(point);
  }
  geometry_.has_lines = geometry_.has_lines || count > 1;
  return {};
}

Status WkbReader::read_ring(const WkbHeader& header) {
  const std::size_t at = cursor_.position();
  A3D_ASSIGN(const std::size_t count, read_count(header, point_bytes(header), "point"));
  constexpr std::size_t kLeast = 4;
  if (count < kLeast)
    return unexpected(at, "a ring of " + counted(count, "point"), "at least 4, the last one equal to the first");
  std::vector<Vec3>& points = geometry_.points;
  const std::size_t begin = points.size();
  Vec3 last;
  for (std::size_t i = 0; i < count; ++i) {
    A3D_ASSIGN(last, read_coordinates(header));
    if (i == 0 || !(last == points.back())) points.push_back(last);
  }
  const bool has_z = contents_ != WkbContents::region;
  if (!(last == points[begin]))
    return unexpected(cursor_.position() - point_bytes(header), "a ring that ends at " + text_of_point(last, has_z),
                      "its first point again, " + text_of_point(points[begin], has_z));
  if (points.size() > begin + 1) points.pop_back();
  if (points.size() < begin + 3)
    return unexpected(at, "a ring of " + counted(points.size() - begin, "different point"), "at least 3");
  geometry_.ring_ends.push_back(points.size());
  return {};
}

Status WkbReader::read_polygon(const WkbHeader& header) {
  A3D_ASSIGN(const std::size_t count, read_count(header, kWordBytes, "ring"));
  for (std::size_t i = 0; i < count; ++i) A3D_TRY(read_ring(header));
  if (count == 0) return {};  // POLYGON EMPTY
  geometry_.polygon_ends.push_back(geometry_.ring_ends.size());
  geometry_.polygon_bytes.push_back(header.begin);
  return {};
}

Status WkbReader::read_parts(const WkbHeader& header, const WkbKinds& kinds, int depth) {
  A3D_ASSIGN(const std::size_t count, read_count(header, kLeastPartBytes, "part"));
  for (std::size_t i = 0; i < count; ++i) {
    poll_interruption_at(step_++);
    A3D_TRY(read_geometry(kinds, depth + 1));
  }
  return {};
}

// Recursion ends at kMaxWkbDepth.
Status WkbReader::read_geometry(const WkbKinds& kinds, int depth) {
  static const WkbKinds in_points = {WkbKind::point}, in_lines = {WkbKind::line_string},
                        in_polygons = {WkbKind::polygon}, in_patches = {WkbKind::polygon, WkbKind::triangle};
  A3D_ASSIGN(const WkbHeader header, read_header(kinds, depth));
  switch (static_cast<WkbKind>(header.code)) {
    case WkbKind::point:
      return read_single_point(header);
    case WkbKind::line_string:
      return read_line(header);
    case WkbKind::polygon:
    case WkbKind::triangle:
      return read_polygon(header);
    case WkbKind::multi_point:
      return read_parts(header, in_points, depth);
    case WkbKind::multi_line_string:
      return read_parts(header, in_lines, depth);
    case WkbKind::multi_polygon:
      return read_parts(header, in_polygons, depth);
    case WkbKind::polyhedral_surface:
    case WkbKind::tin:
      return read_parts(header, in_patches, depth);
    case WkbKind::geometry_collection:
      break;
  }
  return read_parts(header, kinds_of(contents_), depth);
}

/// A polygon over points that are numbered.
std::vector<PointRing> rings_of(const WkbGeometry& geometry, std::size_t polygon, const PointRing& numbers) {
  std::vector<PointRing> rings;
  for (std::size_t ring = geometry.first_ring(polygon); ring < geometry.polygon_ends[polygon]; ++ring) {
    const auto corners =
        std::span(numbers).subspan(geometry.first_point(ring), geometry.ring_ends[ring] - geometry.first_point(ring));
    rings.emplace_back(corners.begin(), corners.end());
  }
  return rings;
}

}  // namespace

Result<Srid> srid_of_wkb(std::string_view bytes) {
  A3D_ASSIGN(const WkbHeader header, WkbCursor(bytes).header());
  return header.srid.value_or(Srid::none);
}

Result<WkbGeometry> read_wkb(std::string_view bytes, WkbContents contents, Srid srid, const Monitor& monitor) {
  A3D_TRY(monitor.check());
  constexpr std::size_t kMost = std::size_t{kNone} * 2 * sizeof(double);
  if (bytes.size() > kMost)
    return Error{ErrorCode::limit_exceeded, "{} bytes, at most {} are read", bytes.size(), kMost};
  const InterruptionScope interruption(monitor.cancel());
  return as_interrupted([&] { return WkbReader(bytes, contents, srid).read(); });
}

Result<PolygonMesh> mesh_of_wkb(const WkbGeometry& geometry, WkbHoles holes, const Monitor& monitor) {
  PointTable table(geometry.points.size());
  PointRing numbers;
  numbers.reserve(geometry.points.size());
  for (std::size_t i = 0; i < geometry.points.size(); ++i) {
    if (i % 1024 == 0) A3D_TRY(monitor.check());
    numbers.push_back(table.intern(PointRef(geometry.points[i])));
  }
  PolygonSoup soup;
  std::vector<IndexTriangle> triangles;
  for (std::size_t polygon = 0; polygon < geometry.polygon_count(); ++polygon) {
    if (polygon % 1024 == 0) A3D_TRY(monitor.check());
    const auto rings = rings_of(geometry, polygon, numbers);
    const std::size_t byte = geometry.polygon_bytes[polygon];
    if (rings.size() > 1 && holes == WkbHoles::refused)
      return unexpected(byte, "a polygon with " + counted(rings.size() - 1, "hole"), "polygons without holes");
    triangles.clear();
    if (rings.size() > 1 && !triangulate_rings(table, rings, triangles))
      return unexpected(byte, "a polygon whose rings cross", "holes within its outer ring");
    for (const IndexTriangle& triangle : triangles) soup.add_face(triangle);
    if (rings.size() == 1) soup.add_face(rings.front());
    if (soup.corners.size() > PolygonMesh::kMaxHalfedges)
      return Error{ErrorCode::limit_exceeded, "byte {}: more than {} corners of polygons", byte,
                   PolygonMesh::kMaxHalfedges};
  }
  soup.points = std::move(table).take_doubles();
  return mesh_of_soup(std::move(soup));
}

Polygons polygons_of_wkb(const WkbGeometry& geometry) {
  Polygons polygons;
  polygons.corners = PointArray(geometry.points);
  polygons.cycle_ends.assign(geometry.ring_ends.begin(), geometry.ring_ends.end());
  polygons.face_ends.assign(geometry.polygon_ends.begin(), geometry.polygon_ends.end());
  return polygons;
}

}  // namespace algebra3d
