#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/values/conversions/json_tree.h"
#include "queries/streams/detail/json_records.h"
#include "queries/streams/mapping.h"

namespace queries {

/// The options of the user for reading a JSON file.
struct JsonOptions {
  std::vector<std::string> path;      ///< members that lead to the array of records
  bool errors_are_undefined = false;  ///< false: a wrong value is an error
};
/// Parses `records=data.items; errors=undefined`. Errors: invalid_value.
Result<JsonOptions> parse_json_options(std::string_view text);

/// The mapping from the members of JSON records to the attributes of a relation. Records that are not objects have a
/// single column, `Value`.
struct JsonLayout {
  TypeExpr tuple;
  std::vector<std::string> columns;                       ///< the member of each attribute; of stated types, its name
  std::optional<algebra3d::FileState> guessed_from = {};  ///< the file, if the types are guessed
};

/// Parses a record to a tree, one level deep. Errors: file_format with the line in the file, also for a duplicate
/// member.
Result<algebra3d::JsonTree> tree_of_record(const JsonRecord& record, const Context& context);

/// Name of the only attribute of records that are not objects.
inline constexpr std::string_view kJsonValueColumn = "Value";

/// Guesses columns and types from the whole file. Columns are the members of all records, in order of first occurrence.
/// Whole numbers are int, numbers real, booleans bool, objects and arrays text (as JSON), strings and mixed columns
/// string. Errors: those of the records; file_format for a file without records.
Result<JsonLayout> guess_json_layout(const std::filesystem::path& path, const JsonOptions& options,
                                     const Context& context);

}  // namespace queries
