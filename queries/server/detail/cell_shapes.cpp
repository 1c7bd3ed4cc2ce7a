#include "queries/server/detail/cell_shapes.h"

#include <algorithm>
#include <vector>

#include "algebra3d/display/glb.h"
#include "algebra3d/display/shape_of_value.h"
#include "queries/server/detail/table_cells.h"

namespace queries {

using algebra3d::GlbNode;
using algebra3d::Shape;

Result<CellShapes> shapes_of(ResultTable& table, const ShapeRequest& request, Context& context) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const Value first, cell(table, request.from, request.column));
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::size_t column, column_index(table, request.column));
  if (!algebra3d::is_drawable(first.type()))
    return Error{ErrorCode::invalid_value, "the column '{}' has values of type {}, which cannot be drawn",
                 request.column, first.type().name()};
  std::vector<Shape> shapes;
  std::size_t bytes = 0;
  const std::size_t end = std::min(table.count(), request.from + request.count);
  std::size_t row = request.from;
  for (; row < end && (shapes.empty() || bytes < request.bytes); ++row) {
    ALGEBRA3D_RETURN_IF_ERROR(context.check_cancelled());
    ALGEBRA3D_ASSIGN_OR_RETURN(const TuplePtr tuple, table.row(row));
    ALGEBRA3D_ASSIGN_OR_RETURN(Shape shape, algebra3d::shape_of(tuple->attributes[column], context.monitor()));
    bytes += algebra3d::glb_bytes(shape);
    shapes.push_back(std::move(shape));
  }
  std::vector<GlbNode> nodes;
  for (std::size_t i = 0; i < shapes.size(); ++i) nodes.push_back({request.from + i, &shapes[i]});
  CellShapes result;
  ALGEBRA3D_ASSIGN_OR_RETURN(result.file, algebra3d::glb_of(nodes));
  if (row < table.count()) result.next = row;
  return result;
}

}  // namespace queries
