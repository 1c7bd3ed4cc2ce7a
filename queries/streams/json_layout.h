#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/json_tree.h"
#include "queries/streams/json_records.h"
#include "queries/streams/mapping.h"

namespace queries {

/// How a JSON file is to be read, as far as the user says it.
struct JsonOptions {
  std::vector<std::string> path;      ///< members that lead to the array of records
  bool errors_are_undefined = false;  ///< else a wrong value is an error
};
/// Reads `records=data.items; errors=undefined`. Errors: invalid_value.
Result<JsonOptions> parse_json_options(std::string_view text);

/// A JSON file as a relation. The members of its records are the columns; records that are no objects have the only
/// column `Value`.
struct JsonLayout {
  TypeExpr tuple;
  std::vector<std::string> columns;                 ///< the member of each attribute; of stated types, its name
  std::optional<stl::FileState> guessed_from = {};  ///< the file, if the types are guessed
};

/// A record as a tree, one level deep. Errors: file_format with the line in the file; also for a member that stands
/// twice in the record.
Result<algebra3d::JsonTree> tree_of_record(const JsonRecord& record, const Context& context);

/// Name of the only attribute of records that are no objects.
inline constexpr std::string_view kJsonValueColumn = "Value";

/// Reads the whole file: the columns are the members of all records in the order in which they come first; whole
/// numbers are int, numbers real, booleans bool, objects and arrays text (as JSON), strings and everything mixed
/// string. Errors: those of the records; file_format for a file without records.
Result<JsonLayout> guess_json_layout(const std::filesystem::path& path, const JsonOptions& options,
                                     const Context& context);

}  // namespace queries
