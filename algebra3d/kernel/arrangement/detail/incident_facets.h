#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"

namespace algebra3d::arrangement {

/// The sub-edges with the incident facets added that only operands with boundary need; arrangements of closed operands
/// skip this. Along a boundary edge no further face of the operand says which facets of the same plane hold it, so
/// facets of other operands are asked for the middle of each sub-edge. Exact. Errors: interrupted. Cost: that of
/// looking up each sub-edge in a tree over the faces of its plane.
Result<SubEdges> with_all_incident_facets(const Operands& operands, const Facets& facets, const SegmentComplex& complex,
                                          SubEdges sub_edges, const Monitor& monitor);

}  // namespace algebra3d::arrangement
