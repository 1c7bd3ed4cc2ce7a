#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "base/id_vector.h"

namespace algebra3d {

/// Per triangle: whether it is of an open patch with one side, as a Moebius strip: a connected component with a
/// boundary that cannot be oriented, and of which closing the holes would add more than 3/4 of its own area. (One that
/// needs less is a body with a wrong triangle somewhere.) Requires triangles that are oriented as far as possible.
/// Errors: interrupted. Cost: linear; for components that cannot be oriented that of closing their holes.
Result<IdVector<FaceId, bool>> one_sided_patches(const IndexedSoup& soup, const Monitor& monitor);

}  // namespace algebra3d
