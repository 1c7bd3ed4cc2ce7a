#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "queries/streams/mapping.h"

namespace queries {

// Shared by importCSV and importJSON: parsing of their arguments, and attribute names made from column names.

/// An attribute name for each column: characters that names cannot have become `_`, a leading digit gets the prefix
/// `C_`, an empty name becomes `Column3`, and a duplicate gets the suffix `_2`.
std::vector<std::string> attribute_names_of(const std::vector<std::string>& columns);

/// "importCSV: columns and their attributes: "Unit price": Unit_price, ..." for the columns whose attribute has another
/// name; empty if there are none.
std::string renaming_note(std::string_view op, const std::vector<std::string>& columns,
                          const std::vector<std::string>& attributes);

/// Splits options such as `separator=;; header=no` into pairs of key and value. The value of `separator` may be a
/// semicolon. Errors: invalid_value for a part that is not `key=value`.
Result<std::vector<std::pair<std::string, std::string>>> split_options(std::string_view text);

/// The arguments of importCSV or importJSON: the file, and in any order a relation whose tuple type states the types,
/// and a text with options.
struct ImportArguments {
  std::optional<TypeExpr> tuple;
  std::string options;
};
/// Reads the arguments. Options must be constants, which are known when the command is checked. Errors: type_error.
Result<ImportArguments> import_arguments(const MappingCheck& check);

/// The file name, which must be a defined constant because types that are not stated are guessed from the file. Errors:
/// type_error with the advice to state the types.
Result<std::string> constant_file_name(const MappingCheck& check, std::string_view op);

/// The types of the attributes.
std::vector<const algebra3d::Type*> attribute_types(const TypeExpr& tuple);

/// Converts a text to a value; see list_of_text.
Result<Value> value_of_text(const algebra3d::Type& type, std::string_view text, Context& context);

}  // namespace queries
