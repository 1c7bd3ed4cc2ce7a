#pragma once

#include <cstddef>
#include <cstdint>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"

namespace algebra3d {

/// A mesh that was divided where faces touch in edges or vertices.
struct DividedContacts {
  /// Manifold. Two edges may join the same vertices, if the faces of one body touch in an edge both ends of which have
  /// a single fan; a step of subdivision ends that.
  PolygonMesh mesh;
  std::size_t edge_count = 0;    ///< number of edges that were divided
  std::size_t vertex_count = 0;  ///< number of vertices that were divided
};

enum class ContactsOf : std::uint8_t {
  solids,   ///< closed and oriented outward: the faces along an edge are paired across the material between them
  surfaces  ///< along an edge of more than two faces, all of them are cut off
};

/// Divides non-manifold edges and vertices. Each fan of faces at a vertex gets a vertex of its own: the one with the
/// lowest half-edge keeps the number, the others come after all vertices, in the order of vertices and then of fans.
/// Faces keep their numbers and corners. Domain: for solids, triangles that bound a valid solid.
/// Error: invalid_value for a surface with an edge of two faces that run along it in the same direction: it is manifold
/// but for their orientation, so it must not be cut there.
/// Exact. Cost: linear, and for an edge with k faces the square of k.
Result<DividedContacts> divided_contacts(const PolygonMesh& mesh, ContactsOf kind);

}  // namespace algebra3d
