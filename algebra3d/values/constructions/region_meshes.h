#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/types/planar.h"

namespace algebra3d {

// Conversions between regions and triangles. All are exact for all regions; errors are `interrupted` and
// `limit_exceeded`.

/// The region at z = 0, its front up: a valid surface, the constrained Delaunay triangulation of each face.
Result<TriangleMesh> flat_mesh(const Region& region, const Monitor& monitor = {});

/// The prism of the region between z = 0 and z = height, which is not 0: a valid volume.
Result<TriangleMesh> prism(const Region& region, double height, const Monitor& monitor = {});

/// The vertical projection of triangles as a region. They must face upwards and not overlap in projection; shared edges
/// become part of the inside.
Result<Region> covered_region(const TriangleMesh& mesh, const Monitor& monitor = {});

/// The regularised set operation on two regions, without parts of lower dimension.
Result<Region> combined_regions(const Region& a, const Region& b, SurfaceRule rule, const Monitor& monitor = {});

/// The vertical projection of the triangles that face upwards, which may overlap, as a region.
Result<Region> shadow(const TriangleMesh& mesh, const Monitor& monitor = {});

}  // namespace algebra3d
