#include "algebra3d/arrangement/point_location.h"

#include <algorithm>

#include "algebra3d/arrangement/boxes.h"
#include "algebra3d/exact/vertical_line.h"

namespace algebra3d::arrangement {
namespace {

int step_above(const PointRef& point, const TriangleRef& triangle) {
  const LineCrossing crossing = cross_vertical_line(point, triangle);
  return crossing.side == -1 ? crossing.sign : 0;
}

}  // namespace

int PointLocation::winding(std::uint32_t operand, const PointRef& point) {
  const TriangleMesh& mesh = operands_.mesh(operand);
  Tree& tree = trees_[operand];
  Box3 above = box_of_point(point);
  above.max.z = Box3::kInfinity;
  int winding = 0;
  if (tree.asked++ < kFewPoints) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const TriangleRef triangle = mesh.corners(FaceId(f));
      if (box_of_triangle(triangle).intersects(above)) winding += step_above(point, triangle);
    }
    return winding;
  }
  if (!tree.faces) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      entries.push_back({box_of_triangle(mesh.corners(FaceId(f))), f});
    tree.faces = std::make_unique<rtree::RTree<std::uint32_t>>(rtree::RTree<std::uint32_t>::bulk_load(entries));
  }
  for (const std::uint32_t face : tree.faces->window(above)) winding += step_above(point, mesh.corners(FaceId(face)));
  return winding;
}

std::vector<std::uint32_t> PointLocation::near(const PointRef& point) {
  if (!boxes_) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    for (std::uint32_t i = 0; i < operands_.count(); ++i) entries.push_back({box_of_mesh(operands_.mesh(i)), i});
    boxes_ = std::make_unique<rtree::RTree<std::uint32_t>>(rtree::RTree<std::uint32_t>::bulk_load(entries));
  }
  std::vector<std::uint32_t> result;
  for (const std::uint32_t operand : boxes_->window(box_of_point(point))) result.push_back(operand);
  std::ranges::sort(result);
  return result;
}

}  // namespace algebra3d::arrangement
