#include <string>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/values/conversions/detail/wkb_kinds.h"
#include "algebra3d/values/conversions/wkb.h"
#include "algebra3d/values/types/binary_io.h"
#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr std::uint8_t kLittleEndian = 1;
// The sizes of the head of a part, of the SRID of the whole, of a number of parts, and of a point with Z.
constexpr std::size_t kHeaderBytes = 5, kSridBytes = 4, kCountBytes = 4, kPointBytes = 24;
constexpr std::size_t kWholeBytes = kHeaderBytes + kSridBytes + kCountBytes;

enum class WkbAxes : std::uint8_t { xy, xyz };

/// Writes geometries one after the other.
class WkbWriter {
 public:
  explicit WkbWriter(WkbAxes axes) : axes_(axes) {}

  /// Errors: limit_exceeded if that many bytes exceed the memory limit.
  Status reserve(std::size_t bytes) {
    A3D_TRY(require_memory(bytes, "the bytes of the geometry"));
    bytes_.reserve(bytes);
    return {};
  }
  void header(WkbKind kind, Srid srid = Srid::none) {
    writer_.u8(kLittleEndian);
    const bool has_srid = srid != Srid::none;
    auto type = static_cast<unsigned>(kind);
    if (axes_ == WkbAxes::xyz) type |= kWkbZ;
    if (has_srid) type |= kWkbSrid;
    writer_.u32(type);
    if (has_srid) writer_.u32(static_cast<unsigned>(srid));
  }
  void count(std::size_t number) { writer_.u32(static_cast<unsigned>(number)); }
  void point(const Vec3& at) {
    writer_.f64(at.x);
    writer_.f64(at.y);
    if (axes_ == WkbAxes::xyz) writer_.f64(at.z);
  }
  std::string take() && { return std::move(bytes_); }

 private:
  WkbAxes axes_;
  std::string bytes_;
  ByteWriter writer_{bytes_};
};

/// `whole` with a part of kind `part` for each triangle.
Result<std::string> wkb_of_triangles(const TriangleMesh& mesh, WkbKind whole, WkbKind part, Srid srid) {
  WkbWriter writer(WkbAxes::xyz);
  constexpr std::size_t kTriangleBytes = kHeaderBytes + 2 * kCountBytes + 4 * kPointBytes;
  A3D_TRY(writer.reserve(kWholeBytes + mesh.face_count() * kTriangleBytes));
  writer.header(whole, srid);
  writer.count(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const TriangleRef corners = mesh.corners(FaceId(f));
    writer.header(part);
    writer.count(1);
    writer.count(4);
    for (const std::size_t i : {0U, 1U, 2U, 0U}) writer.point(corners[i].approx);
  }
  return std::move(writer).take();
}

}  // namespace

Result<std::string> wkb_of_solid(const TriangleMesh& mesh, Srid srid) {
  return wkb_of_triangles(mesh, WkbKind::polyhedral_surface, WkbKind::polygon, srid);
}

Result<std::string> wkb_of_surface(const TriangleMesh& mesh, Srid srid) {
  return wkb_of_triangles(mesh, WkbKind::tin, WkbKind::triangle, srid);
}

Result<std::string> wkb_of_mesh(const PolygonMesh& mesh, Srid srid) {
  WkbWriter writer(WkbAxes::xyz);
  constexpr std::size_t kFaceBytes = kHeaderBytes + 2 * kCountBytes + kPointBytes;
  A3D_TRY(writer.reserve(kWholeBytes + mesh.face_count() * kFaceBytes + mesh.halfedge_count() * kPointBytes));
  writer.header(WkbKind::polyhedral_surface, srid);
  writer.count(mesh.face_count());
  std::size_t first = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const std::size_t degree = mesh.degree(FaceId(f));
    writer.header(WkbKind::polygon);
    writer.count(1);
    writer.count(degree + 1);
    for (std::size_t i = 0; i <= degree; ++i) writer.point(mesh.points()[mesh.origins()[first + i % degree]].approx);
    first += degree;
  }
  return std::move(writer).take();
}

Result<std::string> wkb_of_points(std::span<const ExactPoint> points, Srid srid) {
  WkbWriter writer(WkbAxes::xyz);
  A3D_TRY(writer.reserve(kWholeBytes + points.size() * (kHeaderBytes + kPointBytes)));
  writer.header(WkbKind::multi_point, srid);
  writer.count(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    writer.header(WkbKind::point);
    writer.point(points[i].approx());
  }
  return std::move(writer).take();
}

std::string wkb_of_point(const ExactPoint& point, Srid srid) {
  WkbWriter writer(WkbAxes::xyz);
  writer.header(WkbKind::point, srid);
  writer.point(point.approx());
  return std::move(writer).take();
}

Result<std::string> wkb_of_region(const Polygons& polygons, Srid srid) {
  WkbWriter writer(WkbAxes::xy);
  constexpr std::size_t kFlatPointBytes = 2 * sizeof(double);
  A3D_TRY(writer.reserve(kWholeBytes + polygons.face_count() * (kHeaderBytes + kCountBytes) +
                         polygons.cycle_count() * (kCountBytes + kFlatPointBytes) +
                         polygons.corners.size() * kFlatPointBytes));
  writer.header(WkbKind::multi_polygon, srid);
  writer.count(polygons.face_count());
  for (std::size_t face = 0; face < polygons.face_count(); ++face) {
    writer.header(WkbKind::polygon);
    writer.count(polygons.face_ends[face] - polygons.first_cycle(face));
    for (std::size_t cycle = polygons.first_cycle(face); cycle < polygons.face_ends[face]; ++cycle) {
      const std::size_t first = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
      writer.count(end - first + 1);
      for (std::size_t corner = first; corner < end; ++corner) {
        poll_interruption_at(corner);
        writer.point(polygons.corners[corner].approx);
      }
      writer.point(polygons.corners[first].approx);
    }
  }
  return std::move(writer).take();
}

}  // namespace algebra3d
