#include "algebra3d/kernel/repair/detail/cover_test.h"

#include <algorithm>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/search/boxes.h"

namespace algebra3d {
namespace {

TriangleRef corners_of(const IndexedSoup& soup, const TriangleMesh::Triangle& t) {
  return {soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]};
}

}  // namespace

CoverTest::CoverTest(const IndexedSoup& soup, const IdVector<HoleId, HoleLoop>& holes) : soup_(soup) {
  std::vector<rtree::Entry<std::uint32_t>> hole_boxes, boxes;
  for (const HoleLoop& hole : holes) hole_boxes.push_back({hole.box(), 0});
  const auto hole_tree = rtree::RTree<std::uint32_t>::bulk_load(hole_boxes);
  const auto mesh = soup.mesh();
  for (const FaceId face : faces(*mesh)) {
    const Box3 box = box_of_triangle(mesh->corners(face));
    auto near = hole_tree.window(box);
    if (near.next()) boxes.push_back({box, face.index()});
  }
  tree_ = rtree::RTree<std::uint32_t>::bulk_load(boxes);
}

bool CoverTest::cuts(const TriangleMesh::Triangle& triangle, FaceId other) const {
  const TriangleMesh::Triangle& corners = soup_.triangles[other];
  const auto is_common = [&](std::uint32_t corner) { return std::ranges::find(corners, corner) != corners.end(); };
  const auto common = std::ranges::count_if(triangle, is_common);
  const Contact contact = intersect_triangles(corners_of(soup_, triangle), corners_of(soup_, corners));
  if (common == 0) return contact != Contact::none;
  return common == 1 ? contact > Contact::point : contact > Contact::segment;
}

bool CoverTest::cuts_surface(const std::vector<TriangleMesh::Triangle>& cover) const {
  std::size_t looks_left = 10'000 + 100 * cover.size();
  for (const TriangleMesh::Triangle& triangle : cover) {
    const TriangleRef corners = corners_of(soup_, triangle);
    if (collinear(corners[0], corners[1], corners[2])) return true;
    for (const std::uint32_t other : tree_.window(box_of_triangle(corners))) {
      if (looks_left-- == 0) return false;
      if (cuts(triangle, FaceId(other))) return true;
    }
  }
  return false;
}

}  // namespace algebra3d
