#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A mesh as a graphics card takes it: vertices with positions and normals, and triangles of them. A vertex of the mesh
/// appears once for each of its corner normals. Positions are floats relative to `origin`, so that models far from the
/// origin of coordinates keep their shape.
struct RenderBuffers {
  Vec3 origin;
  std::vector<std::array<float, 3>> positions;          ///< per vertex
  std::vector<std::array<float, 3>> normals;            ///< per vertex
  std::vector<std::uint32_t> mesh_vertices;             ///< per vertex: the vertex of the mesh
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of vertices, counter-clockwise seen from the front
  std::vector<std::uint32_t> faces;                     ///< per triangle: the face of the mesh, for picking
};

/// The buffers of a mesh whose faces are divided into `triangles`, each given by the half-edges that leave its corners;
/// `normals` is what corner_normals makes. The origin is the middle of the box around all vertices. Exactness:
/// positions have an error of 2^-24 of their distance from the origin, and of the coordinates' rounding to doubles.
/// Domain: boxes smaller than the largest float. Cost: linear.
template <typename Layout>
RenderBuffers render_buffers(const HalfedgeMesh<Layout>& mesh, std::span<const std::array<HalfedgeId, 3>> triangles,
                             const CornerNormals& normals);
/// The buffers of a triangle mesh.
RenderBuffers render_buffers(const TriangleMesh& mesh, const CornerNormals& normals);

}  // namespace algebra3d
