#include "algebra3d/planar/subdivision.h"

namespace algebra3d::planar {

void Subdivision::link_vertices() {
  for (std::uint32_t h = 0; h < halfedge_count(); ++h)
    if (origin(h) != kNone) halfedges_of_vertices_[origin(h)] = h;
}

}  // namespace algebra3d::planar
