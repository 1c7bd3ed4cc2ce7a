#pragma once

#include <array>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Triangles without connectivity, as a mesh file gives them: the corners in the order of the file (counter-clockwise
/// seen from outside, if the file is right). Nothing is checked beyond finiteness: corners may repeat or be collinear.
struct TriangleSoup {
  using Triangle = std::array<Vec3, 3>;

  std::vector<Triangle> triangles;
  /// One per triangle, or empty if the file has none; any length, zero where the file leaves it open.
  std::vector<Vec3> normals;
  /// Name of the first solid, as written; may be empty.
  std::string name;
};

}  // namespace algebra3d
