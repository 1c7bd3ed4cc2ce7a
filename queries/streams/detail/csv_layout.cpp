#include "queries/streams/detail/csv_layout.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/propagate.h"
#include "queries/streams/detail/import_columns.h"
#include "queries/streams/plain_text.h"

namespace queries {
namespace {

Error wrong_option(std::string_view key, std::string_view expected, std::string_view found) {
  return {ErrorCode::invalid_value, "{}: expected {}, found {}", key, expected, quoted_excerpt(found)};
}

Result<char> separator_named(const std::string& value) {
  static const std::map<std::string, char, std::less<>> names = {{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'},
                                                                 {"pipe", '|'},  {"blank", ' '},     {"\\t", '\t'}};
  if (const auto named = names.find(value); named != names.end()) return named->second;
  const bool is_sign = value.size() == 1 && std::string_view("\"\r\n.-+").find(value[0]) == std::string_view::npos &&
                       (value[0] < '0' || value[0] > '9');
  if (is_sign) return value[0];
  return wrong_option("separator", "one character, or comma, semicolon, tab, pipe or blank", value);
}

Status read_csv_option(const std::string& key, const std::string& value, CsvOptions& options) {
  if (key == "separator") {
    A3D_ASSIGN(options.separator, separator_named(value));
  } else if (key == "header") {
    if (value != "yes" && value != "no") return wrong_option(key, "yes or no", value);
    options.has_header = value == "yes";
  } else if (key == "decimal") {
    if (value != "," && value != ".") return wrong_option(key, "',' or '.'", value);
    options.decimal = value[0];
  } else if (key == "skip") {
    const auto count = algebra3d::parse_int(value);
    if (!count || *count < 0) return wrong_option(key, "a number of lines", value);
    options.skipped_lines = static_cast<std::size_t>(*count);
  } else if (key == "undefined") {
    options.undefined_text = value;
  } else if (key == "errors") {
    if (value != "undefined" && value != "stop") return wrong_option(key, "undefined or stop", value);
    options.errors_are_undefined = value == "undefined";
  } else {
    return Error{ErrorCode::invalid_value,
                 "unknown option '{}'; there are separator, header, decimal, skip, undefined and errors", key};
  }
  return {};
}

/// What is known of the type of a column.
struct ColumnKind {
  std::optional<PlainKind> kind;  // nothing as long as all cells are undefined

  void add(PlainKind next) {
    const bool are_numbers = kind != PlainKind::boolean && kind != PlainKind::text && next != PlainKind::boolean;
    if (!kind || *kind == next)
      kind = next;
    else
      kind = are_numbers && next != PlainKind::text ? PlainKind::real : PlainKind::text;
  }
  TypeExpr type() const {
    if (kind == PlainKind::boolean) return "bool";
    if (kind == PlainKind::integer) return "int";
    return kind == PlainKind::real ? "real" : "string";
  }
};

PlainKind kind_of_cell(const CsvCell& cell, const CsvOptions& options) {
  if (options.decimal == '.') return plain_kind(cell.text);
  return plain_kind(with_decimal_point(cell.text, options.decimal));
}

// How many of the first records have as many cells as the first one, and how many these are.
struct SeparatorScore {
  std::size_t agreeing = 0, cells = 1;
  friend auto operator<=>(const SeparatorScore&, const SeparatorScore&) = default;
};

Result<SeparatorScore> score_of(const std::filesystem::path& path, char separator, const CsvOptions& options) {
  constexpr std::size_t kRecords = 200;
  A3D_ASSIGN(CsvReader reader, open_csv(path, separator, options));
  CsvRecord record;
  SeparatorScore score;
  std::size_t count = 0;
  while (count < kRecords) {
    const auto read = reader.next(record);
    if (!read) return SeparatorScore{};  // quotes do not fit this separator
    if (!*read) break;
    if (record.is_blank()) continue;
    if (count++ == 0) score.cells = record.cells.size();
    score.agreeing += record.cells.size() == score.cells ? 1 : 0;
  }
  const bool is_likely = score.cells > 1 && score.agreeing * 2 > count;
  return is_likely ? score : SeparatorScore{};
}

Result<char> separator_of(const std::filesystem::path& path, const CsvOptions& options) {
  if (options.separator) return *options.separator;
  char best = options.decimal == ',' ? ';' : ',';
  SeparatorScore best_score;
  for (const char candidate : {',', ';', '\t', '|'}) {
    if (candidate == options.decimal) continue;
    A3D_ASSIGN(const SeparatorScore score, score_of(path, candidate, options));
    if (score > best_score) {
      best = candidate;
      best_score = score;
    }
  }
  return best;
}

bool is_header(const CsvRecord& record, const CsvOptions& options) {
  if (options.has_header) return *options.has_header;
  return std::ranges::all_of(record.cells, [&](const CsvCell& cell) {
    return !without_blanks(cell.text).empty() && kind_of_cell(cell, options) == PlainKind::text;
  });
}

std::vector<std::string> column_names(const CsvRecord& first, bool has_header) {
  std::vector<std::string> names;
  for (const CsvCell& cell : first.cells)
    names.push_back(has_header ? std::string(without_blanks(cell.text)) : fmt::format("Column{}", names.size() + 1));
  return names;
}

/// A file that is open behind its first record.
struct OpenCsv {
  CsvReader reader;
  CsvRecord first;
  CsvLayout layout;  // without types
};

Result<OpenCsv> begin_csv(const std::filesystem::path& path, const CsvOptions& options) {
  A3D_ASSIGN(const char separator, separator_of(path, options));
  A3D_ASSIGN(CsvReader reader, open_csv(path, separator, options));
  OpenCsv open{std::move(reader), {}, {}};
  A3D_ASSIGN(const bool has_record, open.reader.next(open.first));
  if (!has_record) return Error{ErrorCode::file_format, "is empty: expected a header or a line of values"};
  open.layout.separator = separator;
  open.layout.has_header = is_header(open.first, options);
  open.layout.columns = column_names(open.first, open.layout.has_header);
  return open;
}

void add_kinds(const CsvRecord& record, const CsvOptions& options, std::vector<ColumnKind>& kinds) {
  for (std::size_t i = 0; i < std::min(record.cells.size(), kinds.size()); ++i) {
    const CsvCell& cell = record.cells[i];
    const bool is_settled = kinds[i].kind == PlainKind::text;
    if (!is_settled && !is_undefined_cell(cell, options) && !cell.text.empty())
      kinds[i].add(kind_of_cell(cell, options));
  }
}

Status add_all_kinds(OpenCsv& open, const CsvOptions& options, const Context& context, std::vector<ColumnKind>& kinds) {
  CsvRecord record;
  for (std::size_t step = 1;; ++step) {
    if (step % 1024 == 0) A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const bool has_record, open.reader.next(record));
    if (!has_record) return {};
    if (record.is_blank()) continue;
    if (record.cells.size() != kinds.size() && !options.errors_are_undefined)
      return Error{ErrorCode::file_format, "{}", wrong_length_text(record, kinds.size())};
    add_kinds(record, options, kinds);
  }
}

// Where each attribute stands, by the names of the columns or the attribute names that are made from them.
Result<std::vector<std::size_t>> sources_by_name(const CsvLayout& layout, const TypeExpr& tuple) {
  const std::vector<std::string> names = attribute_names_of(layout.columns);
  std::vector<std::size_t> sources;
  for (const auto& [attribute, type] : tuple.attributes()) {
    auto found = std::ranges::find(layout.columns, attribute) - layout.columns.begin();
    if (static_cast<std::size_t>(found) == names.size()) found = std::ranges::find(names, attribute) - names.begin();
    if (static_cast<std::size_t>(found) == names.size())
      return Error{ErrorCode::unknown_name, "has no column '{}'; the columns are {}", attribute,
                   algebra3d::enumerate(names, 20)};
    sources.push_back(static_cast<std::size_t>(found));
  }
  return sources;
}

std::vector<std::size_t> all_columns(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

}  // namespace

Result<CsvOptions> parse_csv_options(std::string_view text) {
  CsvOptions options;
  A3D_ASSIGN(const auto pairs, split_options(text));
  for (const auto& [key, value] : pairs) A3D_TRY(read_csv_option(key, value, options));
  if (options.separator == options.decimal)
    return wrong_option("separator", "another sign than that of decimals", std::string(1, options.decimal));
  return options;
}

Result<CsvReader> open_csv(const std::filesystem::path& path, char separator, const CsvOptions& options) {
  A3D_ASSIGN(TextFile file, TextFile::open(path));
  CsvReader reader(std::move(file), separator);
  reader.skip_lines(options.skipped_lines);
  return reader;
}

bool is_undefined_cell(const CsvCell& cell, const CsvOptions& options) {
  if (cell.text.empty()) return !cell.is_quoted;
  return options.undefined_text && cell.text == *options.undefined_text;
}

std::string with_decimal_point(const std::string& text, char decimal) {
  if (decimal == '.') return text;
  // A point would separate thousands: such a cell is not a number.
  if (text.find('.') != std::string::npos) return "no number";
  std::string changed = text;
  std::ranges::replace(changed, decimal, '.');
  return changed;
}

std::string wrong_length_text(const CsvRecord& record, std::size_t expected) {
  return fmt::format("line {}: expected {} cell{}, found {}", record.line, expected, expected == 1 ? "" : "s",
                     record.cells.size());
}

Result<CsvLayout> guess_csv_layout(const std::filesystem::path& path, const CsvOptions& options,
                                   const Context& context) {
  A3D_ASSIGN(OpenCsv open, begin_csv(path, options));
  std::vector<ColumnKind> kinds(open.first.cells.size());
  if (!open.layout.has_header) add_kinds(open.first, options, kinds);
  A3D_TRY(add_all_kinds(open, options, context, kinds));
  const std::vector<std::string> names = attribute_names_of(open.layout.columns);
  std::vector<TypeExpr::Attribute> attributes;
  for (std::size_t i = 0; i < kinds.size(); ++i) attributes.push_back({names[i], kinds[i].type()});
  open.layout.tuple = TypeExpr::tuple(std::move(attributes));
  open.layout.sources = all_columns(kinds.size());
  open.layout.guessed_from = open.reader.file().state();
  return std::move(open.layout);
}

Result<CsvLayout> stated_csv_layout(const std::filesystem::path& path, const CsvOptions& options,
                                    const TypeExpr& tuple) {
  A3D_ASSIGN(OpenCsv open, begin_csv(path, options));
  CsvLayout& layout = open.layout;
  layout.tuple = tuple;
  const std::size_t attribute_count = tuple.attributes().size();
  if (layout.has_header) {
    A3D_ASSIGN(layout.sources, sources_by_name(layout, tuple));
  } else if (layout.columns.size() == attribute_count) {
    layout.sources = all_columns(attribute_count);
  } else {
    return Error{ErrorCode::file_format, "{} (and no header)", wrong_length_text(open.first, attribute_count)};
  }
  return std::move(layout);
}

}  // namespace queries
