#include "queries/streams/detail/json_layout.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/propagate.h"
#include "queries/streams/detail/import_columns.h"
#include "queries/streams/plain_text.h"

namespace queries {
namespace {

using algebra3d::JsonKind;
using algebra3d::JsonTree;

enum class JsonColumn : std::uint8_t { boolean, integer, real, string, tree };

std::optional<JsonColumn> column_kind_of(const JsonTree& tree, std::size_t part) {
  switch (tree.kind(part)) {
    case JsonKind::null:
      return std::nullopt;
    case JsonKind::boolean:
      return JsonColumn::boolean;
    case JsonKind::number: {
      const PlainKind kind = plain_kind(tree.text(part));
      return kind == PlainKind::integer ? JsonColumn::integer
             : kind == PlainKind::real  ? JsonColumn::real
                                        : JsonColumn::string;
    }
    case JsonKind::string:
      return JsonColumn::string;
    default:
      return JsonColumn::tree;
  }
}

JsonColumn mixed(JsonColumn a, JsonColumn b) {
  if (a == b) return a;
  if (a == JsonColumn::tree || b == JsonColumn::tree) return JsonColumn::tree;
  const auto is_number = [](JsonColumn c) { return c == JsonColumn::integer || c == JsonColumn::real; };
  return is_number(a) && is_number(b) ? JsonColumn::real : JsonColumn::string;
}

TypeExpr type_of(std::optional<JsonColumn> column) {
  if (!column || *column == JsonColumn::string) return "string";
  if (*column == JsonColumn::boolean) return "bool";
  if (*column == JsonColumn::tree) return "text";
  return *column == JsonColumn::integer ? "int" : "real";
}

/// The members that records have had so far.
class JsonColumns {
 public:
  void add(std::string name, std::optional<JsonColumn> kind) {
    const auto [place, is_new] = positions_.emplace(std::move(name), kinds_.size());
    if (is_new) {
      names_.push_back(place->first);
      kinds_.push_back(kind);
      return;
    }
    std::optional<JsonColumn>& known = kinds_[place->second];
    if (kind) known = known ? mixed(*known, *kind) : *kind;
  }
  JsonLayout layout() && {
    const std::vector<std::string> attributes = attribute_names_of(names_);
    std::vector<TypeExpr::Attribute> typed;
    for (std::size_t i = 0; i < names_.size(); ++i) typed.push_back({attributes[i], type_of(kinds_[i])});
    return {.tuple = TypeExpr::tuple(std::move(typed)), .columns = std::move(names_)};
  }
  bool empty() const { return names_.empty(); }

 private:
  std::map<std::string, std::size_t, std::less<>> positions_;
  std::vector<std::string> names_;
  std::vector<std::optional<JsonColumn>> kinds_;
};

void add_record(const JsonTree& tree, JsonColumns& columns) {
  if (tree.kind(0) != JsonKind::object) {
    columns.add(std::string(kJsonValueColumn), column_kind_of(tree, 0));
    return;
  }
  for (std::size_t key = JsonTree::first(0); key != tree.end(0); key = tree.after(tree.after(key)))
    columns.add(tree.content(key), column_kind_of(tree, tree.after(key)));
}

// Either value could be meant, so none is taken.
Status check_no_duplicate(const JsonTree& tree, const JsonRecord& record) {
  if (tree.kind(0) != JsonKind::object) return {};
  std::vector<std::pair<std::string, std::size_t>> keys;
  for (std::size_t key = JsonTree::first(0); key != tree.end(0); key = tree.after(tree.after(key)))
    keys.emplace_back(tree.content(key), key);
  std::ranges::sort(keys);
  const auto same = std::ranges::adjacent_find(keys, {}, &std::pair<std::string, std::size_t>::first);
  if (same == keys.end()) return {};
  const std::string_view before = std::string_view(record.text).substr(0, tree.begin(std::next(same)->second));
  const auto line = record.line + static_cast<std::size_t>(std::ranges::count(before, '\n'));
  return Error{ErrorCode::file_format, "line {}, record {}: duplicate member {}", line, record.number,
               quoted_excerpt(same->first)};
}

std::vector<std::string> path_of(std::string_view text) {
  std::vector<std::string> path;
  while (!text.empty()) {
    const std::size_t dot = text.find('.');
    path.emplace_back(text.substr(0, dot));
    text.remove_prefix(dot == std::string_view::npos ? text.size() : dot + 1);
  }
  return path;
}

}  // namespace

Result<JsonOptions> parse_json_options(std::string_view text) {
  JsonOptions options;
  A3D_ASSIGN(const auto pairs, split_options(text));
  for (const auto& [key, value] : pairs) {
    if (key == "records") {
      options.path = path_of(value);
    } else if (key == "errors") {
      if (value != "undefined" && value != "stop")
        return Error{ErrorCode::invalid_value, "errors: expected undefined or stop, found {}", quoted_excerpt(value)};
      options.errors_are_undefined = value == "undefined";
    } else {
      return Error{ErrorCode::invalid_value, "unknown option '{}'; there are records and errors", key};
    }
  }
  return options;
}

Result<JsonTree> tree_of_record(const JsonRecord& record, const Context& context) {
  A3D_ASSIGN(JsonTree tree, JsonTree::parse(record.text, 1, context.monitor(), {record.line, false}));
  A3D_TRY(check_no_duplicate(tree, record));
  return tree;
}

Result<JsonLayout> guess_json_layout(const std::filesystem::path& path, const JsonOptions& options,
                                     const Context& context) {
  A3D_ASSIGN(TextFile file, TextFile::open(path));
  const algebra3d::FileState state = file.state();
  JsonRecords records(std::move(file), options.path);
  JsonRecord record;
  JsonColumns columns;
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const bool has_record, records.next(record));
    if (!has_record) break;
    A3D_ASSIGN(const JsonTree tree, tree_of_record(record, context));
    add_record(tree, columns);
  }
  if (columns.empty())
    return Error{ErrorCode::file_format,
                 "has no records with members, so there is nothing to guess types from; expected "
                 "an array of objects, or objects that follow each other"};
  JsonLayout layout = std::move(columns).layout();
  layout.guessed_from = state;
  return layout;
}

}  // namespace queries
