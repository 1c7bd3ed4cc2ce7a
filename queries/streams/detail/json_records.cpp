#include "queries/streams/detail/json_records.h"

#include <fmt/format.h>

#include "algebra3d/values/conversions/json_tree.h"
#include "base/propagate.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

constexpr std::size_t kMostJsonBytes = std::size_t{64} << 20U;

bool is_json_space(int c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool ends_scalar(int c) {
  return c == TextFile::kEnd || is_json_space(c) || c == ',' || c == ']' || c == '}' || c == '[' || c == '{' ||
         c == '"';
}

}  // namespace

Error JsonRecords::expected(std::string_view what) {
  const int found = file_.peek();
  std::string shown = "the end of the file";
  if (found > ' ' && found < 0x7F) shown = fmt::format("'{}'", static_cast<char>(found));
  if (found >= 0x7F || (found >= 0 && found < ' ')) shown = fmt::format("the byte 0x{:02x}", found);
  return {ErrorCode::file_format, "line {}: expected {}, found {}", file_.line(), what, shown};
}

void JsonRecords::skip_blanks() {
  while (is_json_space(file_.peek()))
    if (file_.take() == '\n') file_.count_line();
}

int JsonRecords::peek_value() {
  skip_blanks();
  return file_.peek();
}

// For a file that was cut short while it was read the error is that of the file.
Error JsonRecords::not_closed(std::string_view what, std::size_t line) const {
  if (!file_.status().ok()) return file_.status().error();
  return {ErrorCode::file_format, "line {}: the {} that begins here is not closed", line, what};
}

Status JsonRecords::take_string(std::string& text) {
  const std::size_t line = file_.line();
  text += static_cast<char>(file_.take());
  while (true) {
    const int next = file_.take();
    if (next == TextFile::kEnd) return not_closed("string", line);
    if (next == '\n') file_.count_line();
    text += static_cast<char>(next);
    if (text.size() > kMostJsonBytes)
      return Error{ErrorCode::limit_exceeded, "line {}: a value of more than 64 MB", line};
    if (next == '"') return {};
    if (next == '\\' && file_.peek() != TextFile::kEnd) text += static_cast<char>(file_.take());
  }
}

// Brackets are counted alone: whether they belong to each other is found when the text is read.
Status JsonRecords::take_value(std::string& text) {
  text.clear();
  const std::size_t line = file_.line();
  std::size_t depth = 0;
  do {
    const int next = file_.peek();
    if (next == TextFile::kEnd) return not_closed("value", line);
    if (next == '"') {
      A3D_TRY(take_string(text));
      continue;
    }
    if (next == '{' || next == '[') ++depth;
    if (next == '}' || next == ']') --depth;
    if (next == '\n') file_.count_line();
    text += static_cast<char>(file_.take());
    if (text.size() > kMostJsonBytes)
      return Error{ErrorCode::limit_exceeded, "line {}: a record of more than 64 MB", line};
    // A number or a word has no brackets.
    while (depth == 0 && next != '}' && next != ']' && !ends_scalar(file_.peek()))
      text += static_cast<char>(file_.take());
  } while (depth > 0);
  return {};
}

Status JsonRecords::enter_member(const std::string& name) {
  if (peek_value() != '{') return expected(fmt::format("an object with the member \"{}\"", name));
  file_.take();
  while (true) {
    if (peek_value() != '"') return expected(fmt::format("the member \"{}\"", name));
    std::string key;
    A3D_TRY(take_string(key));
    if (peek_value() != ':') return expected("':'");
    file_.take();
    const auto read = algebra3d::JsonTree::parse(key);
    if (read && read->content(0) == name) return {};
    if (ends_scalar(peek_value()) && file_.peek() != '{' && file_.peek() != '[' && file_.peek() != '"')
      return expected("a value");
    A3D_TRY(take_value(key));
    if (peek_value() == ',') file_.take();
  }
}

Status JsonRecords::begin() {
  has_begun_ = true;
  for (const std::string& name : path_) A3D_TRY(enter_member(name));
  is_array_ = peek_value() == '[';
  if (!path_.empty() && !is_array_) return expected(fmt::format("an array as \"{}\"", path_.back()));
  if (is_array_) file_.take();
  return {};
}

// False at the end of the array.
Result<bool> JsonRecords::take_separator() {
  const int next = peek_value();
  if (next == ']') {
    file_.take();
    return false;
  }
  if (is_first_) return true;
  if (next != ',') return expected("',' or ']'");
  file_.take();
  peek_value();
  return true;
}

Result<bool> JsonRecords::end() {
  is_at_end_ = true;
  A3D_TRY(file_.status());
  if (path_.empty() && peek_value() != TextFile::kEnd) return expected("the end of the file after the array");
  return false;
}

Result<bool> JsonRecords::next(JsonRecord& record) {
  if (is_at_end_) return false;
  if (!has_begun_) A3D_TRY(begin());
  if (is_array_) {
    A3D_ASSIGN(const bool has_more, take_separator());
    if (!has_more) return end();
  }
  const int next = peek_value();
  if (next == TextFile::kEnd && !is_array_) return end();
  is_first_ = false;
  record.line = file_.line();
  record.number = ++count_;
  if (ends_scalar(next) && next != '{' && next != '[' && next != '"') return expected("a value");
  A3D_TRY(take_value(record.text));
  A3D_TRY(file_.status());
  return true;
}

}  // namespace queries
