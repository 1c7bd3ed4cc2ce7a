#pragma once

#include <cstddef>
#include <string_view>

namespace stl {

/// What a statement of an OBJ file says, as far as its reader cares.
enum class ObjStatement {
  vertex,
  face,
  object,
  group,
  texture_coordinates,
  normal,
  line,
  point,
  free_form,  ///< curves, surfaces and what belongs to them
  display,    ///< materials, smoothing and the like: nothing about shapes
  unknown,
};
inline constexpr std::size_t kObjStatementCount = static_cast<std::size_t>(ObjStatement::unknown) + 1;

/// The statement that begins with `keyword`. Keywords are lower case. Cost: linear in their number.
ObjStatement obj_statement(std::string_view keyword);

/// True if `word` could be the keyword of some statement: letters, digits and `_`, the first no digit.
bool is_obj_keyword(std::string_view word);

}  // namespace stl
