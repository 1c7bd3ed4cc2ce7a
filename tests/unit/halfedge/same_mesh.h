#pragma once

#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::samples {

inline std::vector<HalfedgeId> listed(std::span<const HalfedgeId> halfedges) {
  return {halfedges.begin(), halfedges.end()};
}

/// With the same numbers throughout.
inline void expect_same_mesh(const TriangleMesh& mesh, const TriangleMesh& expected) {
  ASSERT_EQ(audit(mesh), std::vector<std::string>());
  ASSERT_EQ(mesh.vertex_count(), expected.vertex_count());
  ASSERT_EQ(mesh.halfedge_count(), expected.halfedge_count());
  ASSERT_EQ(mesh.nonmanifold_edge_count(), expected.nonmanifold_edge_count());
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    ASSERT_EQ(listed(mesh.nonmanifold_edge(n)), listed(expected.nonmanifold_edge(n)));
  for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    ASSERT_EQ(mesh.origin(h), expected.origin(h));
    ASSERT_EQ(mesh.opposite(h), expected.opposite(h));
    ASSERT_EQ(mesh.is_boundary(h), expected.is_boundary(h));
    ASSERT_EQ(mesh.is_nonmanifold(h), expected.is_nonmanifold(h));
  }
  ASSERT_EQ(mesh.nonmanifold_vertices(), expected.nonmanifold_vertices());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_EQ(mesh.outgoing(VertexId(v)), expected.outgoing(VertexId(v)));
    ASSERT_EQ(listed(mesh.fans(VertexId(v))), listed(expected.fans(VertexId(v))));
  }
}

}  // namespace algebra3d::samples
