#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Flips shells (shells.h) that are inside out, largest first. A shell with a negative volume stays as a cavity if it
/// lies inside the larger shells, which are oriented already: if its triangles (of large shells the 24 largest and the
/// 6 outermost ones) are in bodies, and one of them not in a cavity of these, since cavities may overlap. Otherwise it
/// is flipped. If the smallest enclosing shell of a shell was flipped, and the two had opposite orientations, the inner
/// shell is flipped as well: a body that is inside out includes its cavities and their content. Exact where shells are
/// closed. Errors: interrupted. Cost: linear, and for each shell of negative volume that of all larger ones.
Status orient_shells(IndexedSoup& soup, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
