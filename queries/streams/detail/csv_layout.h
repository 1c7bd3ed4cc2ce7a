#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "queries/streams/detail/csv_reader.h"
#include "queries/streams/mapping.h"

namespace queries {

/// The options of the user for reading a CSV file.
struct CsvOptions {
  std::optional<char> separator;
  std::optional<bool> has_header;
  char decimal = '.';                         ///< decimal sign of numbers
  std::size_t skipped_lines = 0;              ///< at the beginning, before the header
  std::optional<std::string> undefined_text;  ///< text that means undefined, as an empty cell does
  bool errors_are_undefined = false;          ///< false: a wrong cell or line is an error
};
/// Parses `separator=;; header=no; decimal=,; skip=2; undefined=NA; errors=undefined`. Errors: invalid_value.
Result<CsvOptions> parse_csv_options(std::string_view text);

/// The mapping from the columns of a CSV file to the attributes of a relation.
struct CsvLayout {
  char separator = ',';
  bool has_header = false;
  TypeExpr tuple;
  std::vector<std::size_t> sources;                       ///< the column of each attribute
  std::vector<std::string> columns;                       ///< names in the header; Column1, ... without a header
  std::optional<algebra3d::FileState> guessed_from = {};  ///< the file, if the types are guessed
};

/// Opens the file and skips the lines that the options say. Errors: those of TextFile.
Result<CsvReader> open_csv(const std::filesystem::path& path, char separator, const CsvOptions& options);

/// Guesses the types from the whole file: a column of numbers is int or real, one of TRUE and FALSE bool, any other
/// string (plain_kind). The first line is a header if all its cells are texts. The separator is found in the first
/// lines: `,`, `;`, tab or `|`. Errors: those of the reader; file_format for an empty file or a line with another
/// number of cells.
Result<CsvLayout> guess_csv_layout(const std::filesystem::path& path, const CsvOptions& options,
                                   const Context& context);

/// Finds the columns of given attributes: by their names if there is a header, else by their positions. Reads the first
/// lines only. Errors: as above; unknown_name for an attribute without a column.
Result<CsvLayout> stated_csv_layout(const std::filesystem::path& path, const CsvOptions& options,
                                    const TypeExpr& tuple);

/// True for a cell that means undefined for every type. A quoted empty cell does not.
bool is_undefined_cell(const CsvCell& cell, const CsvOptions& options);
/// The text with its decimal sign replaced by a point.
std::string with_decimal_point(const std::string& text, char decimal);
/// The error message for a record with another number of cells.
std::string wrong_length_text(const CsvRecord& record, std::size_t expected);

}  // namespace queries
