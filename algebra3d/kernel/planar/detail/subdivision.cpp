#include "algebra3d/kernel/planar/detail/subdivision.h"

namespace algebra3d::planar {

void Subdivision::link_vertices() {
  for (const HalfedgeId h : halfedges())
    if (!is_taken_out(h)) halfedges_of_vertices_[origin(h)] = h;
}

}  // namespace algebra3d::planar
