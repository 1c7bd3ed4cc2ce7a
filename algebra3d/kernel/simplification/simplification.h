#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// When a simplification ends: at the number of triangles, or when the next step would exceed the deviation; and what
/// it keeps.
struct SimplificationTarget {
  std::size_t triangles = 0;
  /// The largest distance of a point of one mesh from the other one (Hausdorff distance), in coordinate units.
  double deviation = std::numeric_limits<double>::infinity();
  /// Edges with a larger angle between the normals of their faces, in degrees, are creases, which are kept like the
  /// boundary: vertices on a crease stay on its line of edges, and ends and meeting points of creases stay in their
  /// places. 180: there are none.
  double crease_degrees = 180;
};

/// A simplified mesh.
struct Simplification {
  TriangleMesh mesh;
  /// For each vertex the one of the mesh before at whose place it is, or one of those that became it if it is at none;
  /// for each face the one that it was, with its corners in the same order.
  std::vector<std::uint32_t> vertices, faces;
  /// A bound of the Hausdorff distance of the two meshes; infinite if no deviation was demanded.
  double deviation = std::numeric_limits<double>::infinity();
  /// How often steps were taken back, because the result crossed itself or deviated too much.
  std::size_t repetitions = 0;
};

/// The mesh with fewer triangles: edges are collapsed, those first that cost the least quadric error. Topology stays:
/// components, handles, boundary loops; edges of non-manifold vertices are not touched, isolated vertices stay. No face
/// turns by more than 78 degrees in a step. Vertices are original ones or computed in rounded arithmetic; exact
/// coordinates are rounded. The result may cross itself. As many triangles as demanded are left, or one less, or more
/// where no further edge can be collapsed. A deviation is measured, and holds but for 2^-43 of the largest coordinate.
/// Deterministic, whatever the number of threads. `locked`: empty, or for each vertex whether it and its edges stay as
/// they are. Errors: interrupted. Cost: linear for each attempt; with a deviation, that of farthest_point besides.
/// Source: [garland1997], [dey1999] for the link condition.
Result<Simplification> simplified(const TriangleMesh& mesh, const SimplificationTarget& target,
                                  const Monitor& monitor = {}, std::span<const std::uint8_t> locked = {});

/// Simplifies a valid surface with double coordinates; the result is one, too. It is proved, and where it crosses
/// itself, the steps around the crossing are taken back, or fewer steps taken, whichever leaves fewer triangles. Cost:
/// proofs besides.
Result<Simplification> simplified_surface(const TriangleMesh& surface, const SimplificationTarget& target,
                                          const Monitor& monitor = {});
/// Simplifies a valid volume with double coordinates in this way; the result is one, too.
Result<Simplification> simplified_volume(const TriangleMesh& volume, const SimplificationTarget& target,
                                         const Monitor& monitor = {});

/// The attributes of a mesh after its simplification. `before` had them; `after` has the faces of the result, of which
/// vertices and faces are used up. Corners of merged vertices as taken_over_merged. Cost: linear.
MeshAttributes attributes_after(const MeshAttributes& attributes, const PolygonMesh& before, const PolygonMesh& after,
                                Simplification& simplification);

}  // namespace algebra3d
