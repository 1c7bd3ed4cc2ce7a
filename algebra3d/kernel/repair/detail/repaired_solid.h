#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/known_triangles.h"
#include "algebra3d/kernel/repair/repair_options.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/kernel/validity/report.h"

namespace algebra3d {

/// The result of a repair.
struct RepairedSolid {
  /// A valid volume, the empty one if no triangle has an area; nothing if the repair failed.
  std::optional<TriangleMesh> mesh;
  std::string reason;  ///< why there is no mesh
  RepairReport report;
  std::string_view strategy;       ///< the name of the strategy that made the solid (repair_strategy.h)
  std::size_t division_count = 0;  ///< how often triangles were divided at one another, for all attempts together
};

/// The repair, without welding (docs/import.md): makes a solid of triangles that do not bound one. Runs the strategies,
/// each as a RepairAttempt, one after the other, and chooses. `given`: the welded triangles, in spatial order; `found`:
/// the report of the proof that counted all their defects. Called by solid_from_soup. Each step works on the result of
/// the steps before it, and is skipped if not needed:
///  1. degenerate triangles are dropped (degenerate_triangles.h);
///  2. of duplicates one stays, or none where the surface does not need it (duplicate_triangles.h). If every edge is
///     balanced, but without duplicates some edge would have one triangle, or three or more that do not balance, only
///     sets with as many triangles either way are dropped, each as a whole; but not if at least half of all triangles
///     would go, since then everything is double;
///  3. boundary vertices that rounding moved apart are merged, and T-junctions split (stitching.h);
///  4. gaps are stitched (stitching.h);
///  5. triangles are oriented as their neighbours are (triangle_orientation.h);
///  6. misconnected triangles and dangling sheets are dropped (misconnected_triangles.h, dangling_sheets.h), bands
///     made if the strategy says so (bands.h), holes closed and open patches dropped (holes.h, nonmanifold_loops.h);
///  7. shells that are inside out are flipped (shell_orientation.h);
///  8. if that is not a solid yet, triangles are divided at one another. If every edge is balanced, the solid is the
///     union of the cells with a positive winding number (winding_selection.h), otherwise of those with a mean
///     generalized winding number above 1/2 (winding_segmentation.h). Coplanar triangles are brought together and
///     triangulated anew;
///  9. cavities and small shells are left out, as the options say (shell_filter.h).
/// A solid that may not enclose what the triangles do is compared with the parity estimate (parity_estimate.h). If they
/// differ much, other strategies are tried (repair_strategy.h), and the first that agrees is taken. If the solid agrees
/// but leaves out or adds much, cheaper ones are tried, whose solids have to agree, too. If none agrees, the first
/// solid is taken that does not differ in most of the estimate; if there is none, the repair fails, with the report of
/// the usual strategy. It also fails if the chosen solid leaves out more than the options allow; no other strategy is
/// tried because of that. The result is proved. Exactness: only steps 3, 4 and 6 move points or add triangles away from
/// the given ones; the report says how far. Errors: interrupted. Cost: that of a few proofs, and of an arrangement of
/// the triangles that cross others.
Result<RepairedSolid> repaired_solid(const KnownTriangles& given, const ValidityReport& found,
                                     const RepairOptions& options, const Monitor& monitor = {});

}  // namespace algebra3d
