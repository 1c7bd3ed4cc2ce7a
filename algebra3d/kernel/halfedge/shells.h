#pragma once

#include <cstdint>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {

/// Number of handles, summed over the shells: components of faces that are connected across manifold edges. A vertex or
/// edge that shells share belongs to each of them. 0 for the empty mesh. Undefined, with the reason, if a shell is not
/// closed or meets itself in an edge or vertex. Cost: linear.
template <typename Layout>
Maybe<std::int64_t> genus_of_shells(const HalfedgeMesh<Layout>& mesh);

}  // namespace algebra3d
