#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Attributes of the corners and faces of a mesh file. A list is empty if the file has no such attribute; a number is
/// kNone (indices.h) for a corner or face without one.
struct SoupAttributes {
  using TextureCoordinate = std::array<double, 2>;

  /// Names that faces have, such as groups: `of_face` has the number of a name.
  struct FaceNames {
    std::vector<std::string> names;
    std::vector<std::uint32_t> of_face;
  };

  std::vector<TextureCoordinate> textures;  ///< NaN if the file has no number there
  std::vector<std::uint32_t> corner_textures;
  std::vector<Vec3> normals;  ///< likewise
  std::vector<std::uint32_t> corner_normals;
  FaceNames groups, objects, materials;
};

}  // namespace algebra3d
