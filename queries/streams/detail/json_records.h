#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "queries/streams/detail/text_file.h"

namespace queries {

/// One record of a JSON file: the unchecked text of a value.
struct JsonRecord {
  std::string text;
  std::size_t line = 0;    ///< where it begins, from 1
  std::size_t number = 0;  ///< among the records of the file, from 1
};

/// Splits a JSON file into its records. These are the elements of the top-level array, or a sequence of values (JSON
/// lines). With a path they are the elements of the array that the path leads to in the top-level object; the rest of
/// the file after this array is not read. Source: [rfc8259].
class JsonRecords {
 public:
  /// `path`: names of members, outermost first; may be empty.
  JsonRecords(TextFile file, std::vector<std::string> path) : file_(std::move(file)), path_(std::move(path)) {}

  /// Reads the next record; false at the end. Errors: file_format "line 7: ..." with what was found and expected;
  /// limit_exceeded for a record of more than 64 MB; io_error.
  algebra3d::Result<bool> next(JsonRecord& record);

 private:
  algebra3d::Status begin();
  algebra3d::Status enter_member(const std::string& name);
  algebra3d::Result<bool> take_separator();
  algebra3d::Result<bool> end();
  algebra3d::Status take_value(std::string& text);
  algebra3d::Status take_string(std::string& text);
  void skip_blanks();
  int peek_value();
  algebra3d::Error expected(std::string_view what);
  algebra3d::Error not_closed(std::string_view what, std::size_t line) const;

  TextFile file_;
  std::vector<std::string> path_;
  std::size_t count_ = 0;  // records so far
  bool has_begun_ = false;
  bool is_array_ = false;
  bool is_first_ = true;
  bool is_at_end_ = false;
};

}  // namespace queries
