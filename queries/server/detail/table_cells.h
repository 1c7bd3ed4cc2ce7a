#pragma once

#include <string>

#include "queries/server/detail/result_table.h"

namespace queries {

/// The number of a column. Errors: unknown_name, with the columns that there are.
Result<std::size_t> column_index(const ResultTable& table, const std::string& column);
/// The value of a cell, perhaps deferred. Errors: unknown_name for a column, invalid_value for a row that is not there,
/// those of the store.
Result<Value> cell(ResultTable& table, std::size_t row, const std::string& column);

}  // namespace queries
