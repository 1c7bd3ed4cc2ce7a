#include "algebra3d/halfedge/mesh_image.h"

#include <utility>

#include "algebra3d/halfedge/mesh_triangles.h"

namespace algebra3d {
namespace {

FacePlanes image_planes(const AffineMap& map, const TriangleMesh& mesh) {
  const FacePlanes& planes = mesh.planes();
  FacePlanes images;
  for (std::uint32_t number = 0; number < planes.size(); ++number)
    images.add(IntegerPlane::of(map.apply(planes[number].exact())));
  for (std::size_t face = 0; face < mesh.face_count() && planes.size() > 0; ++face)
    if (planes.number(face) != FacePlanes::kUnknown) images.set(face, planes.number(face));
  return images;
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
  ASSIGN_OR_RETURN(auto points, exact_images(map, mesh.points(), cancel));
  if (!points) return Maybe<TriangleMesh>(Undefined{points.reason()});
  return Maybe<TriangleMesh>(TriangleMesh(*std::move(points), image_triangles(map, mesh), image_planes(map, mesh)));
}

}  // namespace algebra3d
