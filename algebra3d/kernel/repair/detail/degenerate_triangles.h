#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Drops degenerate triangles: those that repeat a corner, and those with collinear corners. A triangle with collinear
/// corners may have joined a long edge to two short ones; without it these are a T-junction, which `split_t_junctions`
/// (stitching.h) removes. Exact. Cost: linear.
void drop_degenerate_triangles(IndexedSoup& soup, RepairReport& report);

}  // namespace algebra3d
