#include "algebra3d/kernel/arrangement/detail/faces_above.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/exact/intersection_point.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/search/boxes.h"

namespace algebra3d::arrangement {
namespace {

/// Where the vertical line through the point meets the plane of the triangle.
ExactPoint point_above(const PointRef& point, const TriangleRef& triangle) {
  const RationalVec3 from = point.rational();
  const ExactPoint up(RationalVec3(from.x, from.y, from.z + 1));
  return intersect_line_plane(point, up, triangle);
}

}  // namespace

const IdTree<InputFaceId>& FaceTree::get() {
  if (!tree_) {
    IdTree<InputFaceId>::Boxes boxes;
    boxes.reserve(operands_.face_count());
    for (const InputFaceId face : operands_.faces()) boxes.add(box_of_triangle(operands_.corners(face)), face);
    tree_.emplace(boxes.tree());
  }
  return *tree_;
}

bool is_cell_above_in_front(const TriangleRef& triangle) {
  // The signs of the normal's coordinates, the one that counts most first.
  for (const Projection projection : {Projection::xy, Projection::yz, Projection::zx})
    if (const int sign = orient2d(projection, triangle[0], triangle[1], triangle[2]); sign != 0) return sign > 0;
  return false;
}

/// A face that the ray hits.
struct FacesAbove::Hit {
  ExactPoint place;
  InputFaceId face;
  int sign;

  bool is_below(const Hit& other) const { return compare(2, place, other.place) < 0; }
};

/// The hits within a slab of the column of boxes above the point, ascending. Those at its bottom belong to the slab
/// below, if there is one.
std::vector<FacesAbove::Hit> FacesAbove::hits_in(const Box3& slab, bool is_lowest_slab, const PointRef& point) {
  std::vector<Hit> hits;
  faces_.get().for_each_in(slab, [&](InputFaceId face) {
    const LineCrossing crossing = cross_vertical_line(point, operands_.corners(face));
    if (crossing.side != -1) return;
    Hit hit{point_above(point, operands_.corners(face)), face, crossing.sign};
    const auto is_up_to = [&](double z) { return compare(2, hit.place, Vec3{0, 0, z}) <= 0; };
    if (is_up_to(slab.max.z) && (is_lowest_slab || !is_up_to(slab.min.z))) hits.push_back(std::move(hit));
  });
  std::ranges::sort(hits, [](const Hit& a, const Hit& b) { return a.is_below(b); });
  return hits;
}

bool FacesAbove::for_each(const PointRef& point, const Visit& visit) {
  const Box3 all = faces_.get().bounds();
  // Slabs of the column, each higher than the one before. A face is hit in one of them.
  Box3 slab = box_of(point);
  double height = (all.max.z - all.min.z) / static_cast<double>(operands_.face_count());
  for (bool is_lowest = true; slab.min.z <= all.max.z; is_lowest = false, slab.min.z = slab.max.z, height *= 2) {
    slab.max.z = slab.min.z + height > slab.min.z ? slab.min.z + height : all.max.z;
    const std::vector<Hit> hits = hits_in(slab, is_lowest, point);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (i + 1 < hits.size() && !hits[i].is_below(hits[i + 1])) return false;
      if (!visit(hits[i].face, hits[i].sign)) return true;
    }
    if (slab.max.z >= all.max.z) break;
  }
  return true;
}

}  // namespace algebra3d::arrangement
