#include "queries/streams/detail/import_columns.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "queries/streams/plain_text.h"

namespace queries {
namespace {

bool is_name_character(char c) {
  return c == '_' || (static_cast<unsigned char>(c) < 0x80 && std::isalnum(static_cast<unsigned char>(c)) != 0);
}

// A run of characters that no name has is one `_`, at the ends none.
std::string name_of_column(std::string_view column, std::size_t number) {
  std::string name;
  bool has_gap = false;
  for (const char c : column) {
    if (is_name_character(c)) {
      if (has_gap && !name.empty()) name += '_';
      name += c;
    }
    has_gap = !is_name_character(c);
  }
  if (name.empty()) return fmt::format("Column{}", number);
  return name.front() >= '0' && name.front() <= '9' ? "C_" + name : name;
}

}  // namespace

std::vector<std::string> attribute_names_of(const std::vector<std::string>& columns) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& column : columns) {
    const std::string plain = name_of_column(column, names.size() + 1);
    std::string name = plain;
    for (std::size_t copy = 2; !taken.insert(name).second; ++copy) name = fmt::format("{}_{}", plain, copy);
    names.push_back(std::move(name));
  }
  return names;
}

std::string renaming_note(std::string_view op, const std::vector<std::string>& columns,
                          const std::vector<std::string>& attributes) {
  constexpr std::size_t kMostShown = 20;
  std::string renamed;
  std::size_t count = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == attributes[i]) continue;
    if (++count > kMostShown) continue;
    renamed += fmt::format("{}{} to {}", count == 1 ? "" : ", ", quoted_excerpt(columns[i]), attributes[i]);
  }
  if (count == 0) return {};
  if (count > kMostShown) renamed += fmt::format(" and {} more", count - kMostShown);
  return fmt::format("{}: names that attributes cannot have were changed: {}", op, renamed);
}

Result<std::vector<std::pair<std::string, std::string>>> split_options(std::string_view text) {
  std::vector<std::pair<std::string, std::string>> options;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n;"), text.size()));
    if (text.empty()) return options;
    const std::size_t equals = text.find('=');
    const std::size_t end = text.find(';', equals == std::string_view::npos ? 0 : equals + 2);
    if (equals == std::string_view::npos || equals > text.find(';'))
      return Error{ErrorCode::invalid_value, "expected options such as 'header=no', found {}",
                   quoted_excerpt(text.substr(0, text.find(';')))};
    const std::string_view value = text.substr(equals + 1, end == std::string_view::npos ? end : end - equals - 1);
    // A separator may be a blank.
    options.emplace_back(without_blanks(text.substr(0, equals)), value.size() == 1 ? value : without_blanks(value));
    text.remove_prefix(std::min(end, text.size()));
  }
}

namespace {

bool is_characters(const TypeExpr& type) {
  return type.is("text") || type.is("string");
}

}  // namespace

Result<ImportArguments> import_arguments(const MappingCheck& check) {
  A3D_TRY(check.argument_count(1, 3));
  if (!is_characters(check[0].type)) return check.expected("text", check[0].type);
  ImportArguments arguments;
  bool has_options = false;
  for (std::size_t place = 1; place < check.count(); ++place) {
    const TypeExpr& type = check[place].type;
    if (type.is_relation() && !arguments.tuple) {
      arguments.tuple = type.element();
      continue;
    }
    if (!is_characters(type) || has_options)
      return check.expected("a relation that states the types, or a text with options", type);
    has_options = true;
    if (!check[place].constant) return check.error("expected options that are a constant");
    A3D_ASSIGN(const Value options, check[place].constant());
    if (!options.is_defined()) return check.error("the options are undefined");
    arguments.options = algebra3d::characters_of(options);
  }
  return arguments;
}

Result<std::string> constant_file_name(const MappingCheck& check, std::string_view op) {
  if (!check[0].constant)
    return check.error(
        fmt::format("the file is not known before the query runs, so its types cannot be guessed; state "
                    "them, as in {}(FILE, [const rel(tuple([Name: string, X: real])) value ()])",
                    op));
  A3D_ASSIGN(const Value name, check[0].constant());
  if (!name.is_defined()) return check.error("the name of the file is undefined, so its types cannot be guessed");
  return algebra3d::characters_of(name);
}

std::vector<const algebra3d::Type*> attribute_types(const TypeExpr& tuple) {
  std::vector<const algebra3d::Type*> types;
  for (const auto& attribute : tuple.attributes()) types.push_back(&undefined_of(attribute.type).type());
  return types;
}

Result<Value> value_of_text(const algebra3d::Type& type, std::string_view text, Context& context) {
  A3D_ASSIGN(const algebra3d::NestedList list, list_of_text(type, text));
  return algebra3d::value_from_nested(type, list, context);
}

}  // namespace queries
