#pragma once

#include "algebra3d/base/id_vector.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Lost patches: manifold patches of the given mesh none of whose corners is in the solid.
struct LostPatches {
  bool is_any = false;
  IdVector<FaceId, bool> is_in_closed_one;  ///< per face: whether it is in a lost patch without a boundary
};

/// Finds lost patches, and reports the closed ones as inner shells, wherever they lie. Cost: linear.
LostPatches report_lost_patches(const TriangleMesh& given, const TriangleMesh& solid, RepairReport& report);

/// Reports how many bodies became parts of others: closed connected components of which something is left, minus the
/// components of the solid. `where`: the place to report. Cost: linear.
void report_united_bodies(const TriangleMesh& given, const TriangleMesh& solid, const Vec3& where,
                          RepairReport& report);

}  // namespace algebra3d
