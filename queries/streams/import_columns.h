#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "queries/streams/mapping.h"

namespace queries {

// What importCSV and importJSON have in common: their arguments, and how names of columns become attributes.

/// An attribute name for each column: characters that no name has become `_`, a digit in front gets `C_` before it, an
/// empty name is `Column3`, and one that stands twice gets `_2`.
std::vector<std::string> attribute_names_of(const std::vector<std::string>& columns);

/// "importCSV: columns and their attributes: "Unit price": Unit_price, ..." for those that are not the same; empty if
/// all are.
std::string renaming_note(std::string_view op, const std::vector<std::string>& columns,
                          const std::vector<std::string>& attributes);

/// Options such as `separator=;; header=no`, as pairs of key and value. The value of `separator` may be a semicolon.
/// Errors: invalid_value for what is no `key=value`.
Result<std::vector<std::pair<std::string, std::string>>> split_options(std::string_view text);

/// The arguments of such an operator: the file, and in any order a relation whose tuple type states the types, and a
/// text with options.
struct ImportArguments {
  std::optional<TypeExpr> tuple;
  std::string options;
};
/// Options must be constants, which are known when the command is checked. Errors: type_error.
Result<ImportArguments> import_arguments(const MappingCheck& check);

/// The name of the file, if it is known when the command is checked and defined. Types that are not stated are guessed
/// from it. Errors: type_error with the advice to state them.
Result<std::string> constant_file_name(const MappingCheck& check, std::string_view op);

/// The types of the attributes.
std::vector<const algebra3d::Type*> attribute_types(const TypeExpr& tuple);

/// The value that a text means; see list_of_text.
Result<Value> value_of_text(const algebra3d::Type& type, std::string_view text, Context& context);

}  // namespace queries
