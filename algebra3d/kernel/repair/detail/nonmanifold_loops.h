#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Which non-manifold loops are closed, and how they may lead.
struct NonmanifoldLoopLimits {
  double largest;                  ///< loops whose box has a longer diagonal, in coordinate units, stay open
  bool covers_interfaces = false;  ///< also closes loops without a boundary edge, around interfaces
  bool takes_shortcuts = false;    ///< loops may also use chords (missing_halfedges.h)
};

/// Closes holes with a non-manifold boundary loop: one that leads in part along unbalanced edges with more than two
/// triangles. Missing half-edges always form closed loops (missing_halfedges.h). Each loop that has a boundary edge and
/// is not a closed boundary loop is covered with triangles if its diameter is at most the largest; shortest loops are
/// found one by one. Closed boundary loops are left to `close_holes`.
///
/// An open boundary that ends at an interface is not a loop by itself. It may be closed along the edges of the
/// interface; or two such boundaries, as those of a cap and of the rim on which it should lie, are joined into one
/// loop, if covering that takes less area. With shortcuts, loops may also lead along chords: then the missing strip
/// between a cap and an interface is covered alone, without the rest of the interface. Loops around interfaces, without
/// a boundary edge, stay open unless the limits say that they are covered; then every edge is balanced in the end.
///
/// Requires oriented triangles. The reported distance is the diameter of the loop. Errors: interrupted. Cost: linear,
/// and that of the loops.
Status close_nonmanifold_loops(IndexedSoup& soup, const NonmanifoldLoopLimits& limits, RepairReport& report,
                               const Monitor& monitor = {});

}  // namespace algebra3d
