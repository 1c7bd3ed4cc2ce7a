#pragma once

#include <optional>
#include <string>
#include <vector>

#include "queries/streams/text_file.h"

namespace queries {

struct CsvCell {
  std::string text;
  bool is_quoted = false;
};

/// The cells of one line of a CSV file, or of several where a quoted cell has line breaks.
struct CsvRecord {
  std::vector<CsvCell> cells;
  std::size_t line = 0;  ///< where it begins, from 1
  /// An empty line.
  bool is_blank() const { return cells.size() == 1 && cells[0].text.empty() && !cells[0].is_quoted; }
};

/// Reads the records of a CSV file one after the other. Cells in double quotes may hold separators, line breaks and
/// doubled quotes; a quote within a cell that does not begin with one stands for itself. Lines end with LF, CRLF or CR.
/// Source: [rfc4180].
class CsvReader {
 public:
  CsvReader(TextFile file, char separator) : file_(std::move(file)), separator_(separator) {}

  /// The next record, or nothing at the end. `record` is used again, with the memory that it has.
  /// Errors: file_format "line 7: ..." (a quote that is not closed, something behind a closing quote, bytes that are no
  /// UTF-8); limit_exceeded for a record of more than 64 MB; io_error.
  algebra3d::Result<bool> next(CsvRecord& record);
  const TextFile& file() const { return file_; }
  /// Skips that many lines, whatever they hold.
  void skip_lines(std::size_t count);

 private:
  algebra3d::Status read_cell(CsvCell& cell, std::size_t number);
  algebra3d::Status read_quoted(CsvCell& cell, std::size_t number);
  algebra3d::Status check_cell(const CsvCell& cell, std::size_t number) const;
  algebra3d::Status check_size() const;
  bool is_at_line_end();
  void take_line_end();

  TextFile file_;
  char separator_;
  std::size_t record_bytes_ = 0;
};

/// A separator as messages name it: `','`, `a tabulator`.
std::string separator_text(char separator);

}  // namespace queries
