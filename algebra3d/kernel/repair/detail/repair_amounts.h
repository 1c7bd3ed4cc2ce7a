#pragma once

#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/known_triangles.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "base/id_vector.h"

namespace algebra3d {

/// The measurements of a repair.
struct MeasuredRepair {
  RepairAmounts amounts;
  /// Per cover: whether the boundary of the solid has a part of it, judged by six points of each of its triangles.
  std::vector<bool> are_added;
};

/// Measures the parts that a repair left out and added. `recognised`: faces of `given` known to be in the solid; others
/// with the same corners are found. `moved`: the largest distance by which a corner was moved, in coordinate units, for
/// MeasureFrame::tolerance. Faces of `given` may cross, repeat and be degenerate; the solid is valid. Exactness: inside
/// tests are exact, at the middle of each part; areas are rounded sums over parts cut in doubles; distances are upper
/// bounds. Errors: interrupted. Cost: linear, and n log n in the faces that only one of the two has. Deterministic.
Result<MeasuredRepair> measure_repair(const TriangleMesh& given, const TriangleMesh& solid,
                                      const FaceMatches& recognised, double moved, std::span<const HoleCover> covers,
                                      const Monitor& monitor = {});

/// The relation of each triangle, before it was divided, to the solid.
struct TriangleClasses {
  IdVector<FaceId, bool> are_divided;  ///< at least a part of it is in the solid, as other faces
  IdVector<FaceId, bool> are_outside;  ///< at least a part of it lies outside the solid
};

/// Classifies triangles relative to the solid that was made of them, with the tolerance of measure_repair. Here `given`
/// has the triangles after the steps before division (SoupRepair), not those of the file. For the entries
/// `intersections` and `outer triangles` of the report. Errors: interrupted. Cost: as before.
Result<TriangleClasses> classify_triangles(const TriangleMesh& given, const TriangleMesh& solid, double moved,
                                           const Monitor& monitor = {});

}  // namespace algebra3d
