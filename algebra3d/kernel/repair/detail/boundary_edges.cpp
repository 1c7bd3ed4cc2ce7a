#include "algebra3d/kernel/repair/detail/boundary_edges.h"

#include <algorithm>

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {

BoundaryEdges::BoundaryEdges(const IndexedSoup& soup) {
  const auto mesh = soup.mesh();
  for (const HalfedgeId h : halfedges(*mesh)) {
    if (!mesh->is_boundary(h)) continue;
    edges.push_back({h, mesh->origin(h), mesh->target(h)});
    vertices.push_back(edges.back().from);
    vertices.push_back(edges.back().to);
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

rtree::RTree<std::uint32_t> BoundaryEdges::vertex_tree(const IndexedSoup& soup) const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  entries.reserve(vertices.size());
  for (const VertexId v : vertices) entries.push_back({Box3::of(soup.point(v)), v.index()});
  return rtree::RTree<std::uint32_t>::bulk_load(entries);
}

Box3 widened(Box3 box, double by) {
  box.min = box.min - Vec3{by, by, by};
  box.max = box.max + Vec3{by, by, by};
  return box;
}

}  // namespace algebra3d
