#include "queries/server/detail/table_cells.h"

#include <vector>

#include <fmt/format.h>

#include "base/propagate.h"

namespace queries {

Result<std::size_t> column_index(const ResultTable& table, const std::string& column) {
  std::vector<std::string> names;
  const auto& attributes = table.tuple_type().attributes();
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    if (attributes[i].name == column) return i;
    names.push_back(attributes[i].name);
  }
  return Error{ErrorCode::unknown_name, "there is no column '{}'; there are {}", column,
               fmt::format("{}", fmt::join(names, ", "))};
}

Result<Value> cell(ResultTable& table, std::size_t row, const std::string& column) {
  A3D_ASSIGN(const std::size_t index, column_index(table, column));
  if (row >= table.count())
    return Error{ErrorCode::invalid_value, "there is no row {}; the result has {}", row, table.count()};
  A3D_ASSIGN(const TuplePtr tuple, table.row(row));
  return tuple->attributes[index];
}

}  // namespace queries
