#pragma once

#include <compare>
#include <memory>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/values/types/detail/canonical_facets.h"
#include "algebra3d/values/types/nested_list.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

// Shared by surface3d and volume3d: texts, order and hash.

/// Computes the box of a mesh: the smallest box of doubles around all triangles, without unused points. Cost: linear.
std::shared_ptr<const Geometry> make_geometry(TriangleMesh mesh);

/// Reads `(tri*)`, tri = `(p1 p2 p3)`; exactly equal corners become one point. Triangles and corners keep their order.
/// Errors: invalid_value with the number of the triangle, counted from 1; `type_name` begins the message.
Result<TriangleMesh> mesh_from_nested(const NestedList& list, std::string_view type_name);
/// The triangles in their order, with exact coordinates.
NestedList mesh_to_nested(const TriangleMesh& mesh);
/// Appends the text of that list. Cost: a number is converted once for each vertex.
void append_mesh_text(const TriangleMesh& mesh, std::string& text);

/// A total order of valid volumes (orientation counts) or surfaces as point sets, independent of the triangulation: by
/// box (corner min, then max), then by the canonical facets (canonical_facets.h). Exact. Cost: constant if the boxes
/// differ, else n log n.
std::strong_ordering compare_point_sets(const Geometry& a, const Geometry& b, Orientation orientation);
/// A hash that agrees with `compare_point_sets`. Cost: n log n.
std::size_t hash_point_set(const Geometry& geometry, Orientation orientation);

/// True if two points of the mesh are equal, which makes it invalid. Cost: linear expected.
bool has_equal_points(const TriangleMesh& mesh);

}  // namespace algebra3d
