#pragma once

#include <string>
#include <vector>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Lists every violated invariant of `mesh`, one sentence each with the elements concerned; empty if all hold. Edges
/// and fans are recomputed, independent of the code that built the mesh. Checked are: sizes of the arrays and bounds of
/// the faces; origins below the vertex count; each half-edge's state (manifold, boundary, non-manifold) as its edge
/// demands; opposites mutual and in reverse direction; the outgoing half-edge leaves its vertex and starts its first
/// fan, and only isolated vertices have none; non-manifold edges and vertices listed, each once, sorted and complete,
/// with one entry for each fan of a non-manifold vertex; no side tables where nothing is non-manifold; and, if all that
/// holds, that known planes are those of the corners. If sizes or origins are wrong, the rest is not checked. Cost: O(n
/// log n).
std::vector<std::string> audit(const TriangleMesh& mesh);
std::vector<std::string> audit(const PolygonMesh& mesh);

}  // namespace algebra3d
