#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"

namespace algebra3d {

/// The solid implied by triangles that are not quite closed, or not consistently oriented. The triangles are divided at
/// one another, so that they divide space into cells (space_cells.h); the solid is the union of the cells that are
/// inside by their mean generalized winding number (cell_classification.h). Faces with the same cell on both sides, as
/// beside an open hole, and faces between two cells that are both inside or both outside are not part of the boundary.
/// `parts`: the ValidParts of soup.mesh(). For triangles of which an edge is not balanced; solid_by_winding serves if
/// all are. The result is a valid volume, perhaps an empty one. Exactness: all but the winding numbers is exact.
/// Errors: interrupted; limit_exceeded beyond the limits, or `max_angles` solid angles. Source: [jacobson2013].
Result<TriangleMesh> solid_by_generalized_winding(const IndexedSoup& soup, const ValidParts& parts,
                                                  const Monitor& monitor, const ArrangementOptions& limits,
                                                  double max_angles);

}  // namespace algebra3d
