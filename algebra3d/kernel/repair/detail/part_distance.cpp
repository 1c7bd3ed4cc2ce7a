#include "algebra3d/kernel/repair/detail/part_distance.h"

#include <algorithm>
#include <limits>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/surface_distance.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Triangles of the mesh whose boxes are no farther than the reach from those of the parts.
std::vector<Triangle3> triangles_near(const MeasureFrame& frame, const TriangleMesh& mesh,
                                      std::span<const SurfacePart> parts, double reach) {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const SurfacePart& part : parts) {
    Box3 box;
    for (const Vec3& corner : part.polygon.corners) box.extend(corner);
    box.min = box.min - Vec3{reach, reach, reach};
    box.max = box.max + Vec3{reach, reach, reach};
    entries.push_back({box, 0});
  }
  const auto places = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::vector<Triangle3> result;
  for (const FaceId face : faces(mesh)) {
    const Triangle3 corners = frame.scale().scaled(mesh, face);
    if (places.window(box_of(corners)).next()) result.push_back(corners);
  }
  return result;
}

}  // namespace

Result<std::vector<SurfacePart>> far_parts(MeasureFrame& frame, const TriangleMesh& mesh,
                                           const std::vector<SurfacePart>& parts) {
  std::vector<SurfacePart> far;
  if (parts.empty()) return far;
  const SurfaceDistance surface(triangles_near(frame, mesh, parts, 2 * frame.tolerance()));
  const auto is_near = [&](const Triangle3& triangle) {
    return !surface.is_empty() && surface.is_near(triangle, frame.tolerance());
  };
  for (const SurfacePart& part : parts) {
    A3D_TRY(frame.pause());
    if (!std::ranges::all_of(part.polygon.triangles(), is_near)) far.push_back(part);
  }
  return far;
}

void measure_distance(const MeasureFrame& frame, const TriangleMesh& mesh, const std::vector<SurfacePart>& parts,
                      SurfaceAmount& amount) {
  std::vector<Triangle3> triangles;
  double reach = frame.tolerance();
  for (const SurfacePart& part : parts)
    for (const Triangle3& triangle : part.polygon.triangles()) {
      triangles.push_back(triangle);
      const Box3 box = box_of(triangle);
      reach = std::max(reach, length(box.max - box.min));
    }
  if (triangles.empty()) return;
  // Near triangles of the mesh give most distances; all of them are asked if something is farther away.
  const auto farthest_from = [&](double distance) {
    return SurfaceDistance(triangles_near(frame, mesh, parts, distance)).farthest(triangles);
  };
  FarthestBounds farthest = farthest_from(reach);
  if (!(farthest.at_most <= reach)) farthest = farthest_from(std::numeric_limits<double>::infinity());
  amount.distance = frame.scale().unscaled(farthest.at_most);
  amount.where = frame.scale().unscaled(farthest.where);
}

}  // namespace algebra3d
