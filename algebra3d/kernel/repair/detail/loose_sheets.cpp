#include "algebra3d/kernel/repair/detail/loose_sheets.h"

#include <algorithm>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/unmatched_triangles.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"
#include "algebra3d/kernel/search/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

class SheetSearch {
 public:
  explicit SheetSearch(const TriangleMesh& mesh)
      : mesh_(mesh), scale_(largest_coordinate(mesh)), components_(connected_components(mesh)) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    for (const FaceId face : faces(mesh)) entries.push_back({box_of(corners(face)), face.index()});
    tree_ = decltype(tree_)::bulk_load(entries);
  }

  IdVector<FaceId, bool> run(const std::vector<Triangle3>& sheets);

 private:
  Triangle3 corners(FaceId face) const { return scale_.scaled(mesh_, face); }
  std::size_t component(FaceId face) const { return components_.of_face[face.index()]; }
  bool has_neighbour(FaceId face, double reach) const;

  const TriangleMesh& mesh_;
  BinaryScale scale_;
  FaceComponents components_;
  rtree::RTree<std::uint32_t> tree_;  // of all faces
};

bool are_near(const Triangle3& a, const Triangle3& b, double reach) {
  const auto is_near = [reach](const Triangle3& corners, const Triangle3& triangle) {
    return std::ranges::any_of(corners, [&](const Vec3& corner) { return distance(corner, triangle) <= reach; });
  };
  return is_near(a, b) || is_near(b, a);
}

bool SheetSearch::has_neighbour(FaceId face, double reach) const {
  Box3 around = box_of(corners(face));
  around.min = around.min - Vec3{reach, reach, reach};
  around.max = around.max + Vec3{reach, reach, reach};
  for (const auto other : tree_.window(around))
    if (component(FaceId(other)) != component(face) && are_near(corners(face), corners(FaceId(other)), reach))
      return true;
  return false;
}

IdVector<FaceId, bool> SheetSearch::run(const std::vector<Triangle3>& sheets) {
  constexpr double kReachPerDiagonal = 0.01;
  std::vector<Triangle3> keys;
  for (const Triangle3& triangle : sheets) keys.push_back(key_of(triangle));
  std::ranges::sort(keys);
  const auto is_of_sheet = [&](FaceId face) {
    const TriangleRef c = mesh_.corners(face);
    return std::ranges::binary_search(keys, key_of({c[0].approx, c[1].approx, c[2].approx}));
  };
  std::vector<bool> is_sheet(components_.count, true);
  std::vector<Box3> boxes(components_.count);
  for (const FaceId face : faces(mesh_)) {
    if (!is_of_sheet(face)) is_sheet[component(face)] = false;
    for (const Vec3& corner : corners(face)) boxes[component(face)].extend(corner);
  }
  for (const FaceId face : faces(mesh_)) {
    const std::size_t c = component(face);
    if (is_sheet[c]) is_sheet[c] = !has_neighbour(face, kReachPerDiagonal * length(boxes[c].max - boxes[c].min));
  }
  IdVector<FaceId, bool> result;
  for (const FaceId face : faces(mesh_)) result.push_back(is_sheet[component(face)]);
  return result;
}

}  // namespace

IdVector<FaceId, bool> loose_sheets(const TriangleMesh& mesh, const std::vector<Triangle3>& sheets) {
  if (sheets.empty()) return IdVector<FaceId, bool>(mesh.face_count());
  return SheetSearch(mesh).run(sheets);
}

}  // namespace algebra3d
