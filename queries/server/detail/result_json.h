#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "base/context.h"
#include "queries/server/detail/result_table.h"

namespace queries {

/// `text` as a JSON string in quotes.
std::string json_string(std::string_view text);
/// The strings as a JSON array.
std::string json_strings(const std::vector<std::string>& texts);

/// Maximum number of rows of an answer.
inline constexpr std::size_t kMostRows = 10000;
/// Maximum text of the rows of an answer, in bytes.
inline constexpr std::size_t kMostRowBytes = std::size_t{16} << 20U;

/// Rows as an array of objects; at most `count`, fewer if their text exceeds kMostRowBytes. Errors: those of the store.
Result<std::string> json_of_rows(ResultTable& table, std::size_t from, std::size_t count, algebra3d::Context& context);
/// The value of a table of one row and one column.
Result<std::string> json_of_single(ResultTable& table, algebra3d::Context& context);
/// Functions and indexes.
Result<std::string> json_of_other(const TypeExpr& type, const Datum& value, algebra3d::Context& context);
/// The result of `list objects` and its like, as an array of objects.
std::string json_of_inquiry(const algebra3d::NestedList& result);

/// `[{"name", "type", "shape"}]`
std::string json_of_columns(const TypeExpr& tuple, const algebra3d::Registry& registry);
/// Whether values of the type can be drawn.
bool is_drawn(const TypeExpr& type, const algebra3d::Registry& registry);
/// Whether a column has values that can be drawn.
bool has_drawn_column(const TypeExpr& tuple, const algebra3d::Registry& registry);
/// Whether a column has values that can be drawn, or that rows may show as a summary.
bool has_geometry(const TypeExpr& tuple, const algebra3d::Registry& registry);

}  // namespace queries
