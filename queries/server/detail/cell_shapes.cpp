#include "queries/server/detail/cell_shapes.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/values/display/glb.h"
#include "algebra3d/values/display/levels_of_detail.h"
#include "algebra3d/values/display/shape_codec.h"
#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/values/display/triangle_tree.h"
#include "base/propagate.h"
#include "queries/server/detail/table_cells.h"
#include "queries/store/levels.h"

namespace queries {
namespace {

using algebra3d::Context;
using algebra3d::DrawnShape;
using algebra3d::GlbNode;

// The levels of detail that are kept: the first can be moved on slow machines, the last is hard to distinguish from the
// whole.
constexpr std::array<std::size_t, 3> kLevels = {2'000'000, 200'000, 20'000};

/// The number under which the whole shape is kept, and the least triangles of a value of which it is.
constexpr std::uint64_t kWhole = 0;
constexpr std::size_t kLeastKeptWhole = 2'000'000;

/// The place of a cell in its table.
struct CellPlace {
  std::size_t row = 0;
  std::size_t column = 0;
};

/// The counts of the levels that a value has.
std::vector<std::size_t> counts_of(const Value& value) {
  std::vector<std::size_t> counts;
  std::ranges::copy_if(kLevels, std::back_inserter(counts),
                       [&](std::size_t count) { return count < value.header().size; });
  return counts;
}

/// A level that is kept in the database. If it cannot be read it is made anew, so that the value is still drawn.
std::optional<DrawnShape> stored_level(const Value& value, std::size_t count) {
  std::optional<DrawnShape> shape;
  const auto found = with_level(value, count, [&](std::string_view bytes) -> Status {
    A3D_ASSIGN(shape, algebra3d::decode_shape(bytes));
    return {};
  });
  return found && *found ? std::move(shape) : std::nullopt;
}

/// Makes all levels of a value and keeps them in the database if that is possible. Whatever is in the way, the next one
/// who asks makes them again.
Result<std::vector<DrawnShape>> made_levels(const Value& value, Context& context) {
  const std::vector<std::size_t> counts = counts_of(value);
  A3D_ASSIGN(std::vector<DrawnShape> levels, algebra3d::levels_of_detail(value, counts, context.monitor()));
  for (DrawnShape& level : levels) algebra3d::add_tree(level);
  for (std::size_t i = 0; i < levels.size() && is_stored(value); ++i)
    if (!keep_level(value, counts[i], algebra3d::encode_shape(levels[i]))) break;
  return levels;
}

// From the memory, from the database, or made now.
Result<DrawnShape> kept_level(ResultTable& table, const Value& value, CellPlace place, std::size_t count,
                              Context& context) {
  const std::vector<std::size_t> counts = counts_of(value);
  const auto index = static_cast<std::size_t>(std::ranges::find(counts, count) - counts.begin());
  if (const LevelCache::Entry* const known = table.levels().find(place.row, place.column)) return known->levels[index];
  if (auto stored = stored_level(value, count)) return *std::move(stored);
  A3D_ASSIGN(std::vector<DrawnShape> levels, made_levels(value, context));
  return table.levels().keep({place.row, place.column, std::move(levels)}).levels[index];
}

// The finest level with at most that many triangles. Below the coarsest that is kept, one is made for this request.
Result<DrawnShape> coarser_shape(ResultTable& table, const Value& value, CellPlace place, std::size_t most,
                                 Context& context) {
  for (const std::size_t count : kLevels)
    if (count <= most) return kept_level(table, value, place, count, context);
  A3D_ASSIGN(std::vector<DrawnShape> levels, algebra3d::levels_of_detail(value, std::array{most}, context.monitor()));
  algebra3d::add_tree(levels.front());
  return std::move(levels.front());
}

// Makes the whole shape of a large value and keeps it. The shares of the work are those of ten million triangles.
Result<DrawnShape> made_whole_shape(const Value& value, const Context& context) {
  const algebra3d::Monitor monitor = context.monitor();
  const auto tell = [&](int percent) { monitor.tell(fmt::format("all triangles, {} %", percent)); };
  tell(0);
  A3D_ASSIGN(const Value loaded, value.loaded());
  tell(20);
  A3D_ASSIGN(DrawnShape shape, algebra3d::shape_of(loaded, monitor.silent()));
  tell(45);
  algebra3d::add_tree(shape);
  tell(55);
  static_cast<void>(keep_level(value, kWhole, algebra3d::encode_shape(shape)));
  tell(95);
  return shape;
}

// That of a large value is kept, too: making it takes longer than reading it.
Result<DrawnShape> whole_shape(const Value& value, Context& context) {
  const bool is_large =
      is_stored(value) && algebra3d::has_levels(value.type()) && value.header().size >= kLeastKeptWhole;
  if (is_large) {
    if (auto stored = stored_level(value, kWhole)) return *std::move(stored);
    return made_whole_shape(value, context);
  }
  A3D_ASSIGN(DrawnShape shape, algebra3d::shape_of(value, context.monitor()));
  algebra3d::add_tree(shape);
  return shape;
}

Result<DrawnShape> shape_of_cell(ResultTable& table, const Value& value, CellPlace place, std::size_t most,
                                 Context& context) {
  if (!value.is_defined()) return algebra3d::shape_of(value, context.monitor());
  const bool is_coarser = most > 0 && algebra3d::has_levels(value.type()) && value.header().size > most;
  if (is_coarser) return coarser_shape(table, value, place, most, context);
  return whole_shape(value, context);
}

}  // namespace

Result<CellShapes> shapes_of(ResultTable& table, const ShapeRequest& request, Context& context) {
  A3D_ASSIGN(const Value first, cell(table, request.from, request.column));
  A3D_ASSIGN(const std::size_t column, column_index(table, request.column));
  if (!algebra3d::is_drawable(first.type()))
    return Error{ErrorCode::invalid_value, "the column '{}' has values of type {}, which cannot be drawn",
                 request.column, first.type().name()};
  std::vector<DrawnShape> shapes;
  std::size_t bytes = 0;
  const std::size_t end = std::min(table.count(), request.from + request.count);
  std::size_t row = request.from;
  for (; row < end && (shapes.empty() || bytes < request.bytes); ++row) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr tuple, table.row(row));
    A3D_ASSIGN(DrawnShape shape,
               shape_of_cell(table, tuple->attributes[column], {row, column}, request.triangles, context));
    bytes += algebra3d::glb_bytes(shape);
    shapes.push_back(std::move(shape));
  }
  std::vector<GlbNode> nodes;
  nodes.reserve(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) nodes.push_back({request.from + i, &shapes[i]});
  CellShapes result;
  A3D_ASSIGN(result.file, algebra3d::glb_of(nodes));
  if (row < table.count()) result.next = row;
  return result;
}

}  // namespace queries
