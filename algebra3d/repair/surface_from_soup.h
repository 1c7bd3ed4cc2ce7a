#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/triangle_soup.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/repair_options.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// A surface, and what was changed to make it one.
struct SurfaceFromSoup {
  TriangleMesh mesh;  ///< proved to be a valid surface3d
  RepairReport repair;
};

/// A surface from the triangles of a mesh file: equal corners are welded; facets without area are dropped; facets that
/// pass through each other, lie upon each other or touch an edge in its middle are divided there, and what several
/// cover is there once. Nothing moves, nothing is added, nothing is turned over; a soup that is a surface comes out
/// untouched, with its triangles in spatial order. A soup without triangles gives the empty surface. Exactness: exact.
/// Errors: interrupted; limit_exceeded beyond TriangleMesh::kMaxFaces triangles, or the work limit of the options,
/// which alone count. Cost: that of a proof, and of an arrangement of what touches more than it may.
Result<SurfaceFromSoup> surface_from_soup(const TriangleSoup& soup, const RepairOptions& options = {},
                                          const Monitor& monitor = {});

}  // namespace algebra3d
