#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/rounding_method.h"

namespace algebra3d {

/// A solid or surface rounded to a grid, or the reason why it cannot be.
struct RoundedMesh {
  /// A valid solid or surface with all coordinates on the grid.
  std::optional<TriangleMesh> mesh;
  std::string reason = {};         ///< why it cannot be rounded, without a mesh
  std::size_t moved_vertices = 0;  ///< of the given ones
  /// In coordinate units: no point of the new boundary, or of the surface, is farther from the given one. Parts that
  /// vanished are not counted.
  double largest_movement = 0;
  RoundingMethod method = RoundingMethod::none;  ///< that found the mesh
  /// How many vertices lie inside edges or faces of others, if their faces or these are among those that changed:
  /// valid, but other programs may take them for crossings (divided_contacts.h).
  std::size_t contact_vertices = 0;
  /// In coordinate units: where triangles crossed after the vertices had moved, features nearer to each other than this
  /// were joined. 0 if none were.
  double reach = 0;
};

}  // namespace algebra3d
