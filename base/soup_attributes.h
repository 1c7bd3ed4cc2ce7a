#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// Attributes of the corners, points and faces of a mesh file. A list is empty if the file has no such attribute; a
/// number is kNone (indices.h) for a corner or face without one.
struct SoupAttributes {
  using TextureCoordinate = std::array<double, 2>;

  /// Red, green and blue, from 0 to 1, and opacity; NaN for what the file does not say.
  struct Colour {
    Vec3 rgb;
    double opacity;
  };

  /// Names that faces have, such as groups: `of_face` has the number of a name.
  struct FaceNames {
    std::vector<std::string> names;
    std::vector<std::uint32_t> of_face;
  };

  std::vector<TextureCoordinate> textures;  ///< NaN if the file has no number there
  std::vector<std::uint32_t> corner_textures;
  std::vector<Vec3> normals;  ///< likewise
  std::vector<std::uint32_t> corner_normals;
  /// `libraries` are the files that describe the materials.
  FaceNames groups, objects, materials, libraries;
  std::array<FaceNames*, 4> face_names() { return {&groups, &objects, &materials, &libraries}; }
  std::array<const FaceNames*, 4> face_names() const { return {&groups, &objects, &materials, &libraries}; }

  // One per point or face; NaN where the file has no number.
  std::vector<Vec3> point_normals;
  std::vector<TextureCoordinate> point_textures;
  std::vector<Colour> point_colours, face_colours;
};

}  // namespace algebra3d
