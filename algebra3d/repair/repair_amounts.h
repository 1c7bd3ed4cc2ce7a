#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// A measured repair.
struct MeasuredRepair {
  RepairAmounts amounts;
  /// Per group of triangles: whether some part of it lies where the solid has something that was added.
  std::vector<bool> are_added;
};

/// Measures what a repair left out and added. `recognised` names, per face of the solid, a face of `given` with the
/// same corners, or KnownFacets::kNone; others with the same corners are found. `moved` is the largest distance by
/// which any corner was moved: nothing nearer than that, or than rounding leaves equal corners, counts as left out or
/// added. Faces of `given` may cross, repeat and be degenerate; the solid is valid. Exactness: what is inside is
/// decided exactly for middles of parts; areas are rounded sums of parts that are cut in doubles; distances are upper
/// bounds. Errors: interrupted. Cost: linear, and n log n in the faces that the two have not in common. Deterministic.
Result<MeasuredRepair> measure_repair(const TriangleMesh& given, const TriangleMesh& solid,
                                      const std::vector<std::uint32_t>& recognised, double moved,
                                      std::span<const HoleCover> covers, const Monitor& monitor = {});

/// What became of facets that were divided at one another, or left out. Each flag is per facet.
struct FacetFates {
  std::vector<bool> are_divided;  ///< the solid has it, at least in part, in other pieces than that facet
  std::vector<bool> are_outside;  ///< at least in part
};

/// Compares all facets of a mesh with a solid that was made of them, as measure_repair does.
Result<FacetFates> facet_fates(const TriangleMesh& facets, const TriangleMesh& solid, double moved,
                               const Monitor& monitor = {});

}  // namespace algebra3d
