#include "queries/streams/detail/csv_reader.h"

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

/// A quote that is closed nowhere must not swallow a large file.
constexpr std::size_t kMostRecordBytes = std::size_t{64} << 20U;

std::string shown_byte(int byte) {
  if (byte == TextFile::kEnd) return "the end of the file";
  if (byte > ' ' && byte < 0x7F) return fmt::format("'{}'", static_cast<char>(byte));
  return fmt::format("the byte 0x{:02x}", byte);
}

}  // namespace

std::string separator_text(char separator) {
  return separator == '\t' ? "a tabulator" : separator == ' ' ? "a blank" : fmt::format("'{}'", separator);
}

bool CsvReader::is_at_line_end() {
  const int next = file_.peek();
  return next == '\n' || next == '\r' || next == TextFile::kEnd;
}

void CsvReader::take_line_end() {
  const int first = file_.take();
  if (first == TextFile::kEnd) return;
  if (first == '\r' && file_.peek() == '\n') file_.take();
  file_.count_line();
}

void CsvReader::skip_lines(std::size_t count) {
  for (; count > 0 && file_.peek() != TextFile::kEnd; --count) {
    while (!is_at_line_end()) file_.take();
    take_line_end();
  }
}

Result<bool> CsvReader::next(CsvRecord& record) {
  record.line = file_.line();
  record_bytes_ = 0;
  std::size_t count = 0;
  if (file_.peek() == TextFile::kEnd) {
    A3D_TRY(file_.status());
    return false;
  }
  while (true) {
    if (count == record.cells.size()) record.cells.emplace_back();
    CsvCell& cell = record.cells[count++];
    A3D_TRY(read_cell(cell, count));
    if (file_.peek() != static_cast<unsigned char>(separator_)) break;
    file_.take();
  }
  take_line_end();
  record.cells.resize(count);
  A3D_TRY(file_.status());
  return true;
}

Status CsvReader::read_cell(CsvCell& cell, std::size_t number) {
  cell.text.clear();
  cell.is_quoted = file_.peek() == '"';
  if (cell.is_quoted) {
    A3D_TRY(read_quoted(cell, number));
  } else {
    while (!is_at_line_end() && file_.peek() != static_cast<unsigned char>(separator_)) {
      cell.text += static_cast<char>(file_.take());
      if (++record_bytes_ % 4096 == 0) A3D_TRY(check_size());
    }
  }
  return check_cell(cell, number);
}

Status CsvReader::read_quoted(CsvCell& cell, std::size_t number) {
  const std::size_t line = file_.line();
  file_.take();
  while (true) {
    const int next = file_.take();
    if (next == TextFile::kEnd && !file_.status().ok()) return file_.status();
    if (next == TextFile::kEnd)
      return Error{ErrorCode::file_format, "line {}, column {}: the quote that begins the cell is not closed", line,
                   number};
    if (next == '"') {
      if (file_.peek() != '"') break;
      file_.take();
    }
    if (next == '\n') file_.count_line();
    cell.text += static_cast<char>(next);
    if (++record_bytes_ % 4096 == 0) A3D_TRY(check_size());
  }
  if (is_at_line_end() || file_.peek() == static_cast<unsigned char>(separator_)) return {};
  return Error{ErrorCode::file_format,
               "line {}, column {}: expected {} or the end of the line after a cell in quotes, found {}",
               file_.line(),
               number,
               separator_text(separator_),
               shown_byte(file_.peek())};
}

Status CsvReader::check_size() const {
  if (record_bytes_ <= kMostRecordBytes) return {};
  return Error{ErrorCode::limit_exceeded, "line {}: a record of more than 64 MB; is a quote not closed?", file_.line()};
}

Status CsvReader::check_cell(const CsvCell& cell, std::size_t number) const {
  const std::size_t wrong = algebra3d::first_no_text(cell.text);
  if (wrong == std::string::npos) return {};
  const bool is_foreign = cell.text[wrong] != '\0';
  return Error{ErrorCode::file_format,
               "line {}, column {}: {}{}",
               file_.line(),
               number,
               algebra3d::no_text_message(cell.text[wrong]),
               is_foreign ? "; convert the file, as with iconv -f WINDOWS-1252 -t UTF-8" : ""};
}

}  // namespace queries
