#pragma once

#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/detail/patches.h"
#include "algebra3d/kernel/arrangement/detail/sub_edges.h"
#include "algebra3d/kernel/arrangement/detail/uncut_edges.h"
#include "algebra3d/kernel/arrangement/operand.h"

namespace algebra3d::arrangement {

/// Operands divided at one another: the output of stages 0 to 7.
struct Subdivision {
  Operands operands;
  Facets facets;
  SegmentComplex complex;
  SubEdges sub_edges;
  Patches patches;
  UncutEdges uncut_edges;

  const Plane& plane_of(SubEdgeId sub_edge) const { return facets.planes[sub_edges[sub_edge].plane]; }
};

/// Whether operands have boundaries: `none` for solids (Closure::each), `possible` for surfaces and for
/// Closure::together. Along a boundary the facets that hold a sub-edge have to be searched for (incident_facets.h).
enum class Boundaries : std::uint8_t { none, possible };

/// Runs stages 0 to 7. The list of operands, their meshes and the hierarchies given with them must outlive the result.
/// Exact. Errors: interrupted; limit_exceeded beyond a limit of the options; internal as find_facet_contacts. Cost:
/// near-linear in the faces of operands whose boxes meet, linear in those of the others.
Result<Subdivision> subdivide(std::span<const Operand> list, Boundaries boundaries, const ArrangementOptions& options,
                              const Monitor& monitor);

}  // namespace algebra3d::arrangement
