#pragma once

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// Drops misconnected triangles: those written with one wrong corner, which leave a hole of the size of one triangle
/// beside them. Two edges of the triangle end in the wrong corner and lack a neighbour, or one lacks a neighbour and
/// the other has one too many. The triangle is dropped, so that the hole with it can be closed by one triangle in its
/// place, if its wrong corner lies behind that triangle, so that a dent would remain; or if the two triangles that
/// would close the hole beside it have no less area than it and the new one together. Requires oriented triangles.
/// Decisions: rounded. Cost: linear, n log n in the missing half-edges.
void drop_misconnected_triangles(IndexedSoup& soup, RepairReport& report);

}  // namespace algebra3d
