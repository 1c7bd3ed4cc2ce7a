#pragma once

#include <optional>
#include <string>
#include <vector>

#include "queries/streams/detail/text_file.h"

namespace queries {

struct CsvCell {
  std::string text;
  bool is_quoted = false;
};

/// The cells of one record of a CSV file: one line, or several if a quoted cell has line breaks.
struct CsvRecord {
  std::vector<CsvCell> cells;
  std::size_t line = 0;  ///< line where the record begins, from 1
  /// True for an empty line.
  bool is_blank() const { return cells.size() == 1 && cells[0].text.empty() && !cells[0].is_quoted; }
};

/// Reads the records of a CSV file one by one. Cells in double quotes may contain separators, line breaks and doubled
/// quotes; in other cells a quote is an ordinary character. Lines end with LF, CRLF or CR. Source: [rfc4180].
class CsvReader {
 public:
  CsvReader(TextFile file, char separator) : file_(std::move(file)), separator_(separator) {}

  /// Reads the next record into `record`, whose memory is reused; false at the end. Errors: file_format "line 7: ..."
  /// (a quote that is not closed, text after a closing quote, invalid UTF-8); limit_exceeded for a record of more than
  /// 64 MB; io_error.
  algebra3d::Result<bool> next(CsvRecord& record);
  const TextFile& file() const { return file_; }
  /// Skips `count` lines without parsing them.
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
