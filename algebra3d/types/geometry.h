#pragma once

#include <compare>
#include <memory>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/types/canonical_facets.h"
#include "algebra3d/types/nested_list.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {

// What surface3d and volume3d share: texts, order and hash.

/// `mesh` with its box: the smallest box of doubles around all triangles. Points that no triangle uses do not count.
/// Cost: linear.
std::shared_ptr<const Geometry> make_geometry(TriangleMesh mesh);

/// Reads `(tri*)`, tri = `(p1 p2 p3)`; equal corners become one point, exactly. Triangles and corners keep their order.
/// Errors: invalid_value with the number of the triangle, counted from 1; `type_name` begins the message.
Result<TriangleMesh> mesh_from_nested(const NestedList& list, std::string_view type_name);
/// The triangles in their order, with exact coordinates.
NestedList mesh_to_nested(const TriangleMesh& mesh);

/// Total order of point sets that are valid volumes (orientation counts) or surfaces: equal means the same points,
/// whatever the triangulation. By box first (corner min, then max), then by the canonical facets (canonical_facets.h).
/// Exact. Cost: constant if the boxes differ, else n log n.
std::strong_ordering compare_point_sets(const Geometry& a, const Geometry& b, Orientation orientation);
/// Agrees with `compare_point_sets`. Cost: n log n.
std::size_t hash_point_set(const Geometry& geometry, Orientation orientation);

/// True if two points of the mesh are the same point, which no proof of validity allows. Cost: n log n.
bool has_equal_points(const TriangleMesh& mesh);

}  // namespace algebra3d
