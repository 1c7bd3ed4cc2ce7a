#pragma once

#include <vector>

#include "algebra3d/kernel/repair/detail/hole_loops.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "base/id_vector.h"
#include "rtree/rtree.h"

namespace algebra3d {

/// Tests whether triangles that close a hole would cut the surface around it.
class CoverTest {
 public:
  /// Collects the triangles near the holes. The soup must outlive this; triangles added later are ignored.
  CoverTest(const IndexedSoup& soup, const IdVector<HoleId, HoleLoop>& holes);

  /// True if a triangle of the cover is degenerate, or meets a triangle of the soup in more than common corners and
  /// edges. At most 10,000 triangles are looked at, and 100 more per triangle of the cover; others count as not cut.
  bool cuts_surface(const std::vector<TriangleMesh::Triangle>& cover) const;

 private:
  bool cuts(const TriangleMesh::Triangle& triangle, FaceId other) const;

  const IndexedSoup& soup_;
  rtree::RTree<std::uint32_t> tree_;
};

}  // namespace algebra3d
