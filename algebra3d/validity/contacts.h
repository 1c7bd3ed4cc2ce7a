#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/validity/face_set.h"

namespace algebra3d {

/// A vertex that lies in a face, or in an edge of it, without being its corner. Valid surfaces and volumes may have
/// such points of contact; programs that read a mesh often take them for crossings.
struct VertexContact {
  VertexId vertex;
  FaceId face;

  friend bool operator==(const VertexContact&, const VertexContact&) = default;
};

/// All contacts of vertices in a valid surface or volume, ascending by face, then vertex. Exact. Errors: interrupted.
/// Cost: that of the pairs of faces whose boxes meet.
Result<std::vector<VertexContact>> vertex_contacts(const TriangleMesh& mesh, const std::atomic<bool>* cancel);

/// The same without the contacts in known faces of vertices that have known faces only. `hierarchy`: over all faces;
/// its groups, if it has any, are of faces without contacts (detail/intersections.h).
Result<std::vector<VertexContact>> vertex_contacts(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                                   const FaceSet& known, const std::atomic<bool>* cancel);

/// The number of different vertices in contacts.
std::size_t vertex_count_of(const std::vector<VertexContact>& contacts);

}  // namespace algebra3d
