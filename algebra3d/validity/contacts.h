#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A vertex that lies in a face, or in an edge of it, without being its corner. Valid surfaces and volumes may have
/// such points of contact; programs that read a mesh often take them for crossings.
struct VertexContact {
  VertexId vertex;
  FaceId face;

  friend bool operator==(const VertexContact&, const VertexContact&) = default;
};

/// All contacts of vertices in a valid surface or volume, ascending by face, then vertex. With `is_new`, one flag per
/// face: only those with a new face, or with a vertex of one. Exact. Errors: interrupted. Cost: a scan, and that of the
/// pairs of boxes of new faces and others.
Result<std::vector<VertexContact>> vertex_contacts(const TriangleMesh& mesh, const std::atomic<bool>* cancel,
                                                   const std::vector<bool>& is_new = {});

/// The number of different vertices in contacts.
std::size_t vertex_count_of(const std::vector<VertexContact>& contacts);

}  // namespace algebra3d
