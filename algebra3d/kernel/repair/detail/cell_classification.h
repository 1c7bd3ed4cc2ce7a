#pragma once

#include <map>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/detail/generalized_winding_number.h"
#include "algebra3d/kernel/repair/detail/space_cells.h"

namespace algebra3d {

/// Says of each bounded cell that has a face in common with another cell whether it belongs to the solid: it does if
/// the mean of the generalized winding numbers at points of the cell beside the middles of its 16 largest faces,
/// weighted by area, exceeds 1/2. `surface`: the divided triangles, which bound the cells; `numbers`: winding numbers
/// of the triangles before division. Rounded. Errors: interrupted; limit_exceeded beyond `max_angles` solid angles.
/// Cost: 16 winding numbers per cell. Source: [jacobson2013], with cells for tetrahedra.
Result<std::map<CellId, bool>> classify_cells(const TriangleMesh& surface, SpaceCells& cells,
                                              const GeneralizedWindingNumbers& numbers, const Monitor& monitor,
                                              double max_angles);

}  // namespace algebra3d
