#pragma once

#include <array>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Triangles without connectivity: the corners in the order of a mesh file (counter-clockwise seen from outside, if the
/// file is correct). Coordinates are finite; corners may repeat or be collinear.
struct TriangleSoup {
  using Triangle = std::array<Vec3, 3>;

  std::vector<Triangle> triangles;
  /// One normal per triangle, or empty if the file has none; of any length, zero if the file does not say.
  std::vector<Vec3> normals;
  /// Name of the first solid, as written; may be empty.
  std::string name;
};

}  // namespace algebra3d
