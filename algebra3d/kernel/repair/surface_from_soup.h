#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/repair_options.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// A surface made of a triangle soup, and the changes.
struct SurfaceFromSoup {
  TriangleMesh mesh;  ///< proved to be a valid surface3d
  RepairReport repair;
};

/// Makes a surface of the triangles of a mesh file (docs/import.md, "Surfaces"): equal corners are welded; degenerate
/// triangles are dropped; triangles that cross, overlap or touch an edge in its middle are divided there, and overlaps
/// are kept once. Nothing is moved, added or flipped. A valid surface is only brought into spatial order. A soup
/// without triangles yields the empty surface. Exactness: exact. Errors: interrupted; limit_exceeded beyond
/// TriangleMesh::kMaxFaces triangles, or beyond the work limit, the only option that is used; the proof of the result
/// has it, too. Cost: that of a proof, and of an arrangement of the triangles that touch others in more than an edge.
Result<SurfaceFromSoup> surface_from_soup(const TriangleSoup& soup, const RepairOptions& options = {},
                                          const Monitor& monitor = {});

}  // namespace algebra3d
