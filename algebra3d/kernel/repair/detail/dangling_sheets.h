#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Drops dangling sheets: manifold patches with a boundary that hang on a surface which is balanced without them. Along
/// every non-manifold edge of the patch, the other triangles run as often one way as the other, and have more area
/// together than the patch. Requires oriented triangles. Exact but for the areas. Cost: linear, and in each further
/// round that of the non-manifold edges.
void drop_dangling_sheets(IndexedSoup& soup, RepairReport& report);

}  // namespace algebra3d
