#pragma once

#include <functional>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A predicate: whether cells with this winding number belong to the solid. Cells with winding number 0 never do.
using WindingRule = std::function<bool(int winding)>;

/// Autorefinement with winding selection (docs/set-operations.md, "Self-intersecting meshes"): divides a mesh at its
/// own crossings, and gives the union of the cells whose winding number the rule keeps, as a valid volume. Used by
/// repair, rounding and the images of moving solids. The mesh may cross itself, overlap itself, repeat triangles and
/// have degenerate ones, but it must be closed: along every piece of an edge as many triangles run one way as the
/// other; edges that overlap only in part are compared piece by piece. Vertices of the result are vertices of the mesh,
/// or exact points in which three of its planes meet. Of the limits, those on pairs and cuts count: folded meshes may
/// have as many pairs of touching triangles as the square of their triangles. Exactness: exact. Errors: interrupted;
/// limit_exceeded. Deterministic. Cost: that of a proof, and of an arrangement of the triangles that touch others in
/// more than an edge.
Result<TriangleMesh> solid_by_winding(const TriangleMesh& mesh, const WindingRule& rule, const Monitor& monitor = {},
                                      const ArrangementOptions& limits = {});
/// As above, for a mesh that is already divided into valid parts.
Result<TriangleMesh> solid_by_winding(const ValidParts& parts, const WindingRule& rule, const Monitor& monitor = {},
                                      const ArrangementOptions& limits = {});

}  // namespace algebra3d
