#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/mesh/mesh.h"

/// Meshes made of meshes. The argument stays as it is.
namespace algebra3d::mesh {

/// The mesh after some steps of a subdivision scheme: "catmull-clark" and "doo-sabin" for any faces, "loop",
/// "butterfly", "modified-butterfly" and "sqrt3" for triangles. Rules at boundaries, numbers of the new elements and
/// values of attributes are those of the operator `subdivide` (docs/halfedge.md, Subdivision): Catmull-Clark and Loop
/// honour the attributes `Crease` of edges and `Corner` of vertices. `variant`: a name of the scheme's own; Doo-Sabin
/// has "mean", which is the default, "doo" and "open", Loop the weights "loop" and "warren". Coordinates are rounded to
/// doubles first. Errors: unknown_name for another scheme or variant; invalid_value for meshes that the scheme cannot
/// take, such as non-manifold ones; limit_exceeded; interrupted. Cost: linear in the result, on all processors.
template <AnyMesh M>
Result<PolygonMesh> subdivided(const M& mesh, std::string_view scheme, std::size_t steps, std::string_view variant = {},
                               const Monitor& monitor = {});

/// The mesh with its vertices where steps of the scheme without end move them: on the limit surface, and at the
/// boundary on the limit curve. For "catmull-clark", "loop" and "doo-sabin", but not its variant "open"; Doo-Sabin
/// makes a face of a vertex, whose corners have one limit. Errors: also invalid_value for other schemes and variants.
/// Cost: linear. Sources: [halstead1993], [loop1987].
template <AnyMesh M>
Result<PolygonMesh> limit_mesh(const M& mesh, std::string_view scheme, std::string_view variant = {},
                               const Monitor& monitor = {});

/// When a simplification ends, and what it keeps.
struct SimplificationGoal {
  std::size_t triangles = 0;  ///< the number of triangles to be left
  /// The largest distance of a point of one mesh from the other one, in coordinate units.
  double deviation = std::numeric_limits<double>::infinity();
  /// Edges with a larger angle between the normals of their faces, in degrees, are kept like the boundary; 180: none.
  double crease_degrees = 180;
};
/// The mesh with fewer triangles, by collapsing edges in order of their quadric errors; `simplify` of the query
/// language. Components, handles and boundary loops stay; attributes of elements that stay are kept. Coordinates are
/// rounded to doubles first. As many triangles as demanded are left, or one less, or more where no further edge can be
/// collapsed. Errors: invalid_value for a deviation or an angle that is negative or not a number; interrupted. Cost:
/// linear; with a deviation that of measuring it besides. Source: [garland1997], [dey1999].
Result<TriangleMesh> simplified(const TriangleMesh& mesh, const SimplificationGoal& goal, const Monitor& monitor = {});

/// The dual: a vertex in the middle of each face, and a face for each closed fan of three or more faces. Boundary
/// vertices give none. Without attributes. Errors: interrupted. Cost: linear.
template <AnyMesh M>
Result<PolygonMesh> dual(const M& mesh, const Monitor& monitor = {});

/// The faces as triangles with the same vertices; triangles have the attributes of their face. A face that is flat and
/// does not cross itself is triangulated without overlap; corners that repeat the one before them do not count. A
/// diagonal may join vertices that an edge joins already: then it is non-manifold, also if no edge was. Errors:
/// limit_exceeded, interrupted. Cost: n log n for a face of n corners.
Result<TriangleMesh> triangulated(const PolygonMesh& mesh, const Monitor& monitor = {});

}  // namespace algebra3d::mesh
