#pragma once

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "base/id_vector.h"

namespace algebra3d {

/// Lost patches: manifold patches of a mesh none of whose corners is a corner of the solid that was made of it.
struct LostPatches {
  bool is_any = false;
  IdVector<FaceId, bool> is_in_closed_one;  ///< per face: whether it is in a lost patch without a boundary
};

/// Finds lost patches, and reports the closed ones as inner shells, wherever they lie. `given`: the mesh before it was
/// divided, not the file. Called by RepairAttempt, which takes a lost patch beside a hole left open for a body that is
/// not closed. Cost: linear.
LostPatches report_lost_patches(const TriangleMesh& given, const TriangleMesh& solid, RepairReport& report);

/// Reports how many bodies became parts of others: closed connected components of `given` (as above) of which a corner
/// is left, minus the components of the solid. `where`: the place to report. Cost: linear.
void report_united_bodies(const TriangleMesh& given, const TriangleMesh& solid, const Vec3& where,
                          RepairReport& report);

}  // namespace algebra3d
