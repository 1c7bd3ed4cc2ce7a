#pragma once

#include <cstddef>
#include <string_view>

namespace mesh_formats {

/// The kind of a statement of an OBJ file, for its reader.
enum class ObjStatement {
  vertex,
  face,
  object,
  group,
  texture_coordinates,
  normal,
  line,
  point,
  free_form,  ///< curves, surfaces and their parts
  display,    ///< materials, smoothing and the like, without effect on shapes
  unknown,
};
inline constexpr std::size_t kObjStatementCount = static_cast<std::size_t>(ObjStatement::unknown) + 1;

/// The statement that begins with `keyword`. Keywords are lower case. Cost: linear in their number.
ObjStatement obj_statement(std::string_view keyword);

/// True if `word` could be a keyword: letters, digits and `_`, not beginning with a digit.
bool is_obj_keyword(std::string_view word);

}  // namespace mesh_formats
