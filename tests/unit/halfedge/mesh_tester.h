#pragma once

#include <memory>
#include <utility>

#include "algebra3d/halfedge/nonmanifold_tables.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

namespace algebra3d {

/// Reaches into a mesh of triangles or polygons to damage it.
struct MeshTester {
  template <typename Mesh>
  static auto& points(Mesh& mesh) {
    return mesh.points_;
  }
  template <typename Mesh>
  static auto& origins(Mesh& mesh) {
    return mesh.origins_;
  }
  template <typename Mesh>
  static auto& opposites(Mesh& mesh) {
    return mesh.opposites_;
  }
  template <typename Mesh>
  static auto& outgoing(Mesh& mesh) {
    return mesh.outgoing_;
  }
  /// Changes a copy of the side tables and puts it in their place.
  template <typename Mesh, typename Change>
  static void change_tables(Mesh& mesh, Change change) {
    auto tables = mesh.nonmanifold_ ? *mesh.nonmanifold_ : NonManifoldTables();
    change(tables);
    mesh.nonmanifold_ = std::make_shared<const NonManifoldTables>(std::move(tables));
  }
  template <typename Mesh>
  static void drop_tables(Mesh& mesh) {
    mesh.nonmanifold_.reset();
  }
};

}  // namespace algebra3d
