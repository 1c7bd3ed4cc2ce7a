#pragma once

#include "algebra3d/base/strong_id.h"

/// Identifiers within a triangulation of the plane. A mesh in space has handles of its own (halfedge/handle.h).
namespace algebra3d::planar {

/// A vertex of a triangulation: one place, however many of the given points lie there (plane_points.h).
using VertexId = StrongId<struct PlanarVertexTag>;
/// A half-edge of a triangulation (subdivision.h). The other direction of the same edge is its twin.
using HalfedgeId = StrongId<struct PlanarHalfedgeTag>;
/// One of the given segments, in their order.
using SegmentId = StrongId<struct PlanarSegmentTag>;

}  // namespace algebra3d::planar
