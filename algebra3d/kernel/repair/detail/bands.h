#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Closes pairs of nearby boundary loops, such as those of a body and of its lid, by a band of triangles between them.
/// A band must have less than half the area that closing both loops takes, and must not be folded back onto the
/// surface. Of two connected components with opposite orientations the smaller one is flipped. Nearby means: the lower
/// corners of their boxes are no farther apart than half the smaller diameter, and so are the upper ones. Pairs with
/// more than 4 million pairs of vertices are left out. Pairs whose box has a diameter above `largest`, in coordinate
/// units, stay open. Requires oriented triangles. Returns whether a band was made. The reported distance bounds the
/// distance of new points from the loops. Errors: interrupted. Cost: linear, n log n in the loops, n * m for two loops
/// of n and m vertices. Deterministic.
Result<bool> close_bands(IndexedSoup& soup, double largest, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
