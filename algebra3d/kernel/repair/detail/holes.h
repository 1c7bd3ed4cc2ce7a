#pragma once

#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Which holes are closed, and how open patches are treated.
struct HoleLimits {
  double largest;                  ///< holes whose box has a longer diagonal, in coordinate units, stay open
  bool drops_open_patches = true;  ///< open patches are dropped, unless there is nothing else; false: they stay
  /// How thick an open patch is at most; without a value the rounding noise of its own size (rounding_noise.h).
  std::optional<double> tolerance = {};
};

/// Closes holes: triangulates each closed boundary loop up to the largest diameter, with triangles oriented like their
/// neighbours (loop_triangulation.h). The cover is the one that bends the surface least; if it would cut the surface,
/// the one with the least area; if both would, the first, and the intersections are divided later. A connected
/// component with one loop is an open patch, and not a solid with a hole, if the cover cuts the surface or lies upon it
/// and has more than 3/4 of the area of the component. So is one with any number of loops that is flat, or whose covers
/// lie upon it, within the tolerance (thin_patches.h). It is left open, or dropped if the limits say so and there are
/// other components. Requires oriented triangles. The reported distance bounds the distance of new points from the
/// loop. Returns the triangles of the thin patches. Errors: interrupted. Cost: linear, and that of the loops.
Result<std::vector<Triangle3>> close_holes(IndexedSoup& soup, const HoleLimits& limits, RepairReport& report,
                                           const Monitor& monitor = {});

}  // namespace algebra3d
