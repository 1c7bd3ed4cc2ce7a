#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/c.h"

/// Which functions of the library the extension has, and what they are called in SQL.
namespace algebra3d_postgres {

/// The types of the extension, each before those whose functions need it.
inline constexpr std::array<std::string_view, 9> kTypes = {"point3d", "points3d",  "vector3d", "plane3d", "rect3",
                                                           "region",  "surface3d", "volume3d", "mesh3d"};

inline const std::map<std::string_view, std::string_view>& plain_types() {
  static const std::map<std::string_view, std::string_view> types = {{"int", "bigint"},   {"real", "float8"},
                                                                     {"bool", "boolean"}, {"string", "text"},
                                                                     {"text", "text"},    {"bytes", "bytea"}};
  return types;
}

/// Words that a name of a column must not be.
inline const std::map<std::string_view, std::string_view>& column_names() {
  static const std::map<std::string_view, std::string_view> names = {
      {"from", "from_t"}, {"to", "to_t"}, {"position", "place"}};
  return names;
}

inline bool is_own(std::string_view type) {
  return std::ranges::find(kTypes, type) != kTypes.end();
}

/// Empty for types that the extension has not.
inline std::string sql_type(std::string_view type) {
  const auto plain = plain_types().find(type);
  if (plain != plain_types().end()) return std::string(plain->second);
  return is_own(type) ? std::string(type) : "";
}

inline std::string snake_case(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    const bool begins_word =
        std::isupper(c) != 0 && i > 0 && std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
    if (begins_word) result += '_';
    result += static_cast<char>(std::tolower(c));
  }
  const auto other = column_names().find(result);
  return other == column_names().end() ? result : std::string(other->second);
}

inline std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// A function of SQL: one of the library whose types are all known here.
struct SqlFunction {
  const a3d_function* function;
  std::vector<std::string> sql_types;
  std::string symbol;  ///< of the C function

  std::string signature() const { return signature(function->name); }
  std::string signature(std::string_view name) const {
    std::string text = std::string(name) + "(";
    for (std::size_t i = 0; i < sql_types.size(); ++i) text += (i > 0 ? ", " : "") + sql_types[i];
    return text + ")";
  }
};

inline std::vector<std::string_view> results_of(const a3d_function& function) {
  if (function.kind != A3D_TABLE) return {function.result_type};
  std::vector<std::string_view> types;
  for (std::size_t i = 0; i < function.column_count; ++i) types.emplace_back(function.columns[i].type);
  return types;
}

inline bool has_own_type(const a3d_function& function) {
  const auto results = results_of(function);
  return std::ranges::any_of(results, is_own) ||
         std::any_of(function.parameters, function.parameters + function.parameter_count,
                     [](const a3d_parameter& parameter) { return is_own(parameter.type); });
}

/// What reads and writes files for others, as bytes.
inline bool is_about_files(std::string_view family) {
  return family == "mesh files" || family == "well-known binary";
}

inline bool has_known_types(const a3d_function& function) {
  const auto results = results_of(function);
  return std::ranges::none_of(results, [](std::string_view type) { return sql_type(type).empty(); }) &&
         std::none_of(function.parameters, function.parameters + function.parameter_count,
                      [](const a3d_parameter& parameter) { return sql_type(parameter.type).empty(); });
}

/// What SQL has of its own for values of any type.
inline bool is_generic(std::string_view family) {
  return family == "comparison" || family == "undefined values";
}

inline bool is_exported(const a3d_function& function) {
  return function.reads_files == 0 && function.writes_files == 0 && !is_generic(function.family) &&
         (has_own_type(function) || is_about_files(function.family)) && has_known_types(function);
}

inline std::vector<SqlFunction> exported() {
  std::vector<SqlFunction> result;
  std::set<std::string> known;
  for (std::size_t i = 0; i < a3d_function_count(); ++i) {
    const a3d_function& function = *a3d_function_at(i);
    if (!is_exported(function)) continue;
    SqlFunction made{&function, {}, "algebra3d_" + std::string(function.name)};
    for (std::size_t p = 0; p < function.parameter_count; ++p) {
      made.sql_types.push_back(sql_type(function.parameters[p].type));
      made.symbol += "_" + std::string(function.parameters[p].type);
    }
    if (known.insert(made.signature()).second) result.push_back(std::move(made));
  }
  return result;
}

}  // namespace algebra3d_postgres
