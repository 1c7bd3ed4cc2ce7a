#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/context.h"
#include "queries/server/detail/result_table.h"

namespace queries {

/// Which cells of a column are to be drawn, and how finely.
struct ShapeRequest {
  std::string column;
  std::size_t from = 0;
  std::size_t count = 1;
  std::size_t triangles = 0;  ///< of one shape at most; 0: all
  std::size_t bytes = 0;      ///< of the file, about; at least one shape is given
};

/// The shapes of cells as binary glTF, and the row to go on with, if there are more than fit.
struct CellShapes {
  std::string file;
  std::optional<std::size_t> next;
};

/// Errors: unknown_name for a column, invalid_value for one that cannot be drawn or a first row that is not there;
/// those of the store; interrupted.
Result<CellShapes> shapes_of(ResultTable& table, const ShapeRequest& request, algebra3d::Context& context);

}  // namespace queries
