#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/face_pairs.h"

namespace algebra3d {

/// A vertex that lies in a face, or in an edge of it, without being its corner. Valid surfaces and volumes may have
/// such points of contact; programs that read a mesh often take them for crossings.
struct VertexContact {
  VertexId vertex;
  FaceId face;

  friend bool operator==(const VertexContact&, const VertexContact&) = default;
};

/// The pairs of faces of a valid surface or volume that have one point in common and no corner. Exact. Errors:
/// interrupted. Cost: that of a proof (validity.h).
Result<FacePairs> touching_faces(const TriangleMesh& mesh, const std::atomic<bool>* cancel);

/// The contacts of vertices of `touching` faces in each other, ascending by face, then vertex; of all contacts of
/// vertices in a mesh, if these are all its touching faces. Exact. Cost: near-linear in the pairs.
std::vector<VertexContact> vertex_contacts(const TriangleMesh& mesh, const FacePairs& touching);

/// The number of different vertices in contacts.
std::size_t vertex_count_of(const std::vector<VertexContact>& contacts);

}  // namespace algebra3d
