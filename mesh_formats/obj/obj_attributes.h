#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/soup_attributes.h"

namespace mesh_formats {

/// Collects the attributes of an OBJ file while its statements are read in order.
class ObjAttributes {
 public:
  /// An index of a corner: from 1, or below 0 counted back from the last one so far; 0 for none.
  using Index = std::int64_t;

  /// The rest of a statement `vt`: u and v; v is 0 if it is missing.
  void add_texture(std::string_view rest);
  /// The rest of a statement `vn`.
  void add_normal(std::string_view rest);
  /// The name in a statement `g`, `o` or `usemtl`, for the faces that follow; empty: none.
  void begin_group(std::string_view name) { attributes_.groups.names.emplace_back(name); }
  void begin_object(std::string_view name) { attributes_.objects.names.emplace_back(name); }
  void begin_material(std::string_view name) { attributes_.materials.names.emplace_back(name); }
  /// The file or files in a statement `mtllib`. Statements without a face in between count as one.
  void begin_library(std::string_view names);

  void add_corner(Index texture, Index normal);
  void end_face();
  /// Forgets the corners since the last face.
  void drop_corners(std::size_t count);

  /// The attributes, with empty lists for those that the file has not. Indices of corners for which there is no element
  /// become kNone; `unknown_count` is their number.
  algebra3d::SoupAttributes finish(std::size_t& unknown_count) &&;

 private:
  static void end_face(algebra3d::SoupAttributes::FaceNames& names);

  algebra3d::SoupAttributes attributes_;
  std::vector<Index> textures_, normals_;  // per corner, from 1
};

}  // namespace mesh_formats
