#include "queries/shell/detail/table.h"

#include <algorithm>

#include <fmt/format.h>

#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/utf8.h"
#include "base/text.h"
#include "queries/exchange/exchange_values.h"
#include "queries/shell/detail/screen.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::TypeOf;

std::string cut(std::string_view text, std::size_t width) {
  if (display_width(text) <= width) return std::string(text);
  std::size_t end = 0;
  for (std::size_t shown = 0; end < text.size() && shown + 1 < width; ++shown) do
      ++end;
    while (end < text.size() && (text[end] & 0xC0) == 0x80);
  return std::string(text.substr(0, end)) + "…";
}

std::string box_text(const Box3& box) {
  return fmt::format("({:.6g} {:.6g}) ({:.6g} {:.6g}) ({:.6g} {:.6g})", box.min.x, box.max.x, box.min.y, box.max.y,
                     box.min.z, box.max.z);
}

std::string summary(const Value& value) {
  const auto header = value.header();
  if (header.box.is_empty()) return fmt::format("{}: empty", value.type().name());
  return fmt::format("{}: {}, box {}", value.type().name(),
                     algebra3d::counted(header.size, value.type().summary_unit()), box_text(header.box));
}

// The number of tuples and the first of them: `3 tuples: (bolt, 2.5), (nut, 1), ...`
std::string nested_text(const Value& value, std::size_t longest) {
  constexpr std::size_t kShownTuples = 3;
  std::string text = algebra3d::counted(value.header().size, "tuple");
  const auto loaded = value.loaded();
  if (!loaded) return text;
  const auto& relation = loaded->get<algebra3d::NestedRelation>();
  for (std::size_t i = 0; i < std::min(relation.size(), kShownTuples); ++i) {
    text += i == 0 ? ": (" : ", (";
    for (std::size_t k = 0; k < relation.width(); ++k)
      text += (k > 0 ? ", " : "") + display_text(relation.tuple(i)[k], longest);
    text += ")";
  }
  if (relation.size() > kShownTuples) text += ", …";
  return one_line(text, longest);
}

// Long columns share what the short ones leave, none falls below a readable width.
constexpr std::size_t kSmallestColumn = 6;

// Lists that are cut show their beginning alone.
constexpr std::size_t kLongestList = 120;

}  // namespace

std::string one_line(std::string_view text, std::size_t longest) {
  const std::string_view kept = algebra3d::utf8_prefix(text, longest);
  std::string line = printable(kept);
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return kept.size() < text.size() ? line + "…" : line;
}

std::string display_text(const Value& value, std::size_t longest) {
  if (!value.is_defined()) return "undefined";
  if (algebra3d::as_nested_relation(value.type()) != nullptr) return nested_text(value, longest);
  if (is_summarised(value)) return summary(value);
  const algebra3d::Type* type = &value.type();
  if (type == &TypeOf<std::string>::type()) return one_line(value.get<std::string>(), longest);
  if (type == &TypeOf<algebra3d::Text>::type()) return one_line(value.get<algebra3d::Text>().content, longest);
  if (type == &TypeOf<double>::type()) return fmt::format("{:.6g}", value.get<double>());
  if (type == &TypeOf<Box3>::type()) return box_text(value.get<Box3>());
  const NestedList list = value.to_nested();
  return one_line(longest == kNoLimit ? list.print() : list.print_short(kLongestList), longest);
}

std::vector<std::size_t> TextTable::column_widths(std::size_t width) const {
  std::vector<std::size_t> widths;
  for (const std::string& title : header_) widths.push_back(display_width(title));
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], display_width(row[i]));
  const std::size_t separators = 3 * (widths.empty() ? 0 : widths.size() - 1);
  const auto total = [&] {
    std::size_t sum = separators;
    for (const std::size_t column : widths) sum += column;
    return sum;
  };
  while (total() > width) {
    auto widest = std::ranges::max_element(widths);
    if (*widest <= kSmallestColumn) break;
    --*widest;
  }
  return widths;
}

std::string TextTable::print(std::size_t width) const {
  const std::vector<std::size_t> widths = column_widths(width);
  std::string text;
  const auto add_line = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string shown = cut(cells[i], widths[i]);
      const std::string padding(widths[i] - std::min(widths[i], display_width(shown)), ' ');
      line += (i > 0 ? " | " : "") + (is_number_[i] ? padding + shown : shown + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  add_line(header_);
  for (std::size_t i = 0; i < widths.size(); ++i) text += (i > 0 ? "-+-" : "") + std::string(widths[i], '-');
  text += "\n";
  for (const auto& row : rows_) add_line(row);
  return text;
}

}  // namespace queries
