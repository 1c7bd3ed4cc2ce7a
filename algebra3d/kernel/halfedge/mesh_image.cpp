#include "algebra3d/kernel/halfedge/mesh_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

FacePlanes image_planes(const AffineMap& map, const TriangleMesh& mesh) {
  const FacePlanes& planes = mesh.planes();
  FacePlanes images;
  for (std::uint32_t number = 0; number < planes.size(); ++number)
    images.add(IntegerPlane::of(map.apply(planes[number].exact())));
  for (std::size_t face = 0; face < mesh.face_count() && planes.size() > 0; ++face)
    if (planes.number(face) != kNone) images.set(face, planes.number(face));
  return images;
}

/// Sum over the triangles of the volumes of boxes round them: a search for pairs that meet looks at more where they are
/// larger. Rounded.
double volume_of_boxes(const TriangleMesh& mesh, std::span<const Vec3> points) {
  double sum = 0;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    poll_interruption_at(face);
    Box3 box;
    for (const std::uint32_t corner : mesh.triangle(FaceId(face))) box.extend(points[corner]);
    const Vec3 extent = box.max - box.min;
    sum += extent.x * extent.y * extent.z;
  }
  return sum;
}

/// No coordinate was moved farther by rounding it to the nearest double.
double largest_rounding(std::span<const Vec3> rounded) {
  double largest = 0;
  for (const Vec3& point : rounded)
    largest = std::max({largest, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  return largest * 0x1p-53 + std::numeric_limits<double>::denorm_min();
}

}  // namespace

std::vector<TriangleMesh::Triangle> image_triangles(const AffineMap& map, const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> triangles = triangles_of(mesh);
  if (map.orientation() < 0)
    for (auto& [a, b, c] : triangles) std::swap(b, c);
  return triangles;
}

Result<Maybe<PointArray>> exact_images(const AffineMap& map, const PointArray& points,
                                       const std::atomic<bool>* cancel) {
  PointArray images;
  images.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 8192 == 0 && cancel != nullptr && cancel->load(std::memory_order_relaxed))
      return Error{ErrorCode::interrupted, "interrupted"};
    const auto image = map.apply(points.point(i));
    if (!image) return Maybe<PointArray>(Undefined{kImageOutOfRange});
    images.push_back(*image);
  }
  return Maybe<PointArray>(std::move(images));
}

Result<Maybe<TriangleMesh>> exact_image(const AffineMap& map, const TriangleMesh& mesh,
                                        const std::atomic<bool>* cancel) {
  A3D_ASSIGN(auto points, exact_images(map, mesh.points(), cancel));
  if (!points) return Maybe<TriangleMesh>(Undefined{points.reason()});
  return Maybe<TriangleMesh>(TriangleMesh(*std::move(points), image_triangles(map, mesh), image_planes(map, mesh)));
}

Preimage preimage_of(const AffineMap& map, const TriangleMesh& mesh, std::span<const Vec3> rounded) {
  // Less than half, measured in one scale; false too where a volume is beyond the range of doubles.
  const double room = volume_of_boxes(mesh, mesh.points().approx()) * map.determinant().abs().nearest_double();
  if (!(room < volume_of_boxes(mesh, rounded) / 2)) return {};
  // Points of both triangles were moved by up to sqrt(3) roundings; 4 of them leave room for the roundings here.
  const double reach = 4 * largest_rounding(rounded) / map.least_stretch();
  return std::isfinite(reach) ? Preimage{&mesh, reach, map.orientation()} : Preimage{};
}

}  // namespace algebra3d
