#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/mesh/mesh.h"
#include "base/large_allocator.h"

namespace algebra3d::mesh::detail {

/// The mesh of the kernel behind a mesh of the interface.
template <AnyMesh M>
using KernelMesh = std::conditional_t<std::same_as<M, TriangleMesh>, algebra3d::TriangleMesh, algebra3d::PolygonMesh>;

/// The content that the copies of a mesh share.
template <typename M>
struct MeshContent {
  std::shared_ptr<const KernelMesh<M>> mesh;  ///< of this mesh alone, or of a solid or surface
  EdgeNumbers edge_numbers;
  LargeVector<HalfedgeId> first_halfedges;  ///< per edge

  explicit MeshContent(std::shared_ptr<const KernelMesh<M>> shared) : mesh(std::move(shared)), edge_numbers(*mesh) {
    first_halfedges.reserve(edge_numbers.count());
    for (const HalfedgeId h : algebra3d::edges(*mesh)) first_halfedges.push_back(h);
  }
};

/// Converts between the meshes of the interface and those of the kernel.
struct MeshAccess {
  static TriangleMesh outer(std::shared_ptr<const algebra3d::TriangleMesh> mesh,
                            const MeshAttributes& attributes = {}) {
    return outer_as<TriangleMesh>(std::move(mesh), attributes);
  }
  static PolygonMesh outer(std::shared_ptr<const algebra3d::PolygonMesh> mesh, const MeshAttributes& attributes = {}) {
    return outer_as<PolygonMesh>(std::move(mesh), attributes);
  }
  static TriangleMesh outer(algebra3d::TriangleMesh mesh, const MeshAttributes& attributes = {}) {
    return outer(std::make_shared<const algebra3d::TriangleMesh>(std::move(mesh)), attributes);
  }
  static PolygonMesh outer(algebra3d::PolygonMesh mesh, const MeshAttributes& attributes = {}) {
    return outer(std::make_shared<const algebra3d::PolygonMesh>(std::move(mesh)), attributes);
  }

  template <typename Derived, typename Layout>
  static const KernelMesh<Derived>& content(const Mesh<Derived, Layout>& mesh) {
    static const KernelMesh<Derived> empty;
    return mesh.content_ == nullptr ? empty : *mesh.content_->mesh;
  }
  template <typename Derived, typename Layout>
  static MeshAttributes attributes(const Mesh<Derived, Layout>& mesh) {
    return mesh.attributes_ == nullptr ? MeshAttributes() : *mesh.attributes_;
  }
  /// The same mesh with other attributes, which must fit.
  template <AnyMesh M>
  static M with_attributes(M mesh, const MeshAttributes& attributes) {
    mesh.attributes_ = attributes.is_empty() ? nullptr : std::make_shared<const MeshAttributes>(attributes);
    return mesh;
  }

 private:
  template <AnyMesh M>
  static M outer_as(std::shared_ptr<const KernelMesh<M>> mesh, const MeshAttributes& attributes);
};

/// The kernel's polygons of a mesh. Half-edges and edges have the same numbers. Cost: a copy for triangles.
inline const algebra3d::PolygonMesh& polygons_of(const PolygonMesh& mesh) {
  return MeshAccess::content(mesh);
}
algebra3d::PolygonMesh polygons_of(const TriangleMesh& mesh);

/// Polygons of three corners each as triangles, with the same numbers. Cost: linear.
algebra3d::TriangleMesh triangles_of(const algebra3d::PolygonMesh& polygons);

/// Polygons and their attributes as triangles. Errors: invalid_value if a face has another number of corners.
Result<TriangleMesh> triangle_mesh_of(const algebra3d::PolygonMesh& polygons, const MeshAttributes& attributes);

}  // namespace algebra3d::mesh::detail
