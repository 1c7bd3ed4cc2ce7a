#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// What a mesh file says of corners and faces besides positions. Lists are empty where it says nothing; numbers are
/// kNone (indices.h) for corners and faces of which it says nothing.
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
