#include "queries/server/detail/cell_shapes.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "algebra3d/display/glb.h"
#include "algebra3d/display/levels_of_detail.h"
#include "algebra3d/display/shape_of_value.h"
#include "algebra3d/display/triangle_tree.h"
#include "queries/server/detail/table_cells.h"

namespace queries {
namespace {

using algebra3d::GlbNode;
using algebra3d::Shape;

// The levels of detail that are kept: the first can be moved on slow machines, the last is hard to tell from the whole.
constexpr std::array<std::size_t, 3> kLevels = {2'000'000, 200'000, 20'000};

/// The place of a cell in its table.
struct CellPlace {
  std::size_t row = 0;
  std::size_t column = 0;
};

Result<const LevelCache::Entry*> levels_of(ResultTable& table, const Value& value, CellPlace place, Context& context) {
  if (const LevelCache::Entry* const known = table.levels().find(place.row, place.column)) return known;
  std::vector<std::size_t> counts;
  std::ranges::copy_if(kLevels, std::back_inserter(counts), [&](std::size_t count) { return count < value.header().size; });
  ALGEBRA3D_ASSIGN_OR_RETURN(std::vector<Shape> levels,
                             algebra3d::levels_of_detail(value, counts, context.monitor()));
  for (Shape& level : levels) algebra3d::add_tree(level);
  return &table.levels().keep({place.row, place.column, std::move(levels)});
}

// The finest level with at most that many triangles. Below the coarsest that is kept, one is made for this request.
Result<Shape> level_of(ResultTable& table, const Value& value, CellPlace place, std::size_t most, Context& context) {
  if (most >= kLevels.back()) {
    ALGEBRA3D_ASSIGN_OR_RETURN(const LevelCache::Entry* const known, levels_of(table, value, place, context));
    for (const Shape& level : known->levels)
      if (level.triangles.size() <= most) return level;
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(std::vector<Shape> levels,
                             algebra3d::levels_of_detail(value, std::array{most}, context.monitor()));
  algebra3d::add_tree(levels.front());
  return std::move(levels.front());
}

Result<Shape> shape_of_cell(ResultTable& table, const Value& value, CellPlace place, std::size_t most,
                            Context& context) {
  if (!value.is_defined()) return algebra3d::shape_of(value, context.monitor());
  const bool is_coarser = most > 0 && algebra3d::has_levels(value.type()) && value.header().size > most;
  if (is_coarser) return level_of(table, value, place, most, context);
  ALGEBRA3D_ASSIGN_OR_RETURN(Shape shape, algebra3d::shape_of(value, context.monitor()));
  algebra3d::add_tree(shape);
  return shape;
}

}  // namespace

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
    ALGEBRA3D_ASSIGN_OR_RETURN(
        Shape shape, shape_of_cell(table, tuple->attributes[column], {row, column}, request.triangles, context));
    bytes += algebra3d::glb_bytes(shape);
    shapes.push_back(std::move(shape));
  }
  std::vector<GlbNode> nodes;
  nodes.reserve(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) nodes.push_back({request.from + i, &shapes[i]});
  CellShapes result;
  ALGEBRA3D_ASSIGN_OR_RETURN(result.file, algebra3d::glb_of(nodes));
  if (row < table.count()) result.next = row;
  return result;
}

}  // namespace queries
