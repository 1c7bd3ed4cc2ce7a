#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "queries/streams/csv_reader.h"
#include "queries/streams/mapping.h"

namespace queries {

/// How a CSV file is to be read, as far as the user says it.
struct CsvOptions {
  std::optional<char> separator;
  std::optional<bool> has_header;
  char decimal = '.';                         ///< what stands before the fraction of a number
  std::size_t skipped_lines = 0;              ///< at the beginning, before the header
  std::optional<std::string> undefined_text;  ///< stands for undefined, as an empty cell does
  bool errors_are_undefined = false;          ///< else a wrong cell or line is an error
};
/// Reads `separator=;; header=no; decimal=,; skip=2; undefined=NA; errors=undefined`. Errors: invalid_value.
Result<CsvOptions> parse_csv_options(std::string_view text);

/// A CSV file as a relation: what each attribute is made from.
struct CsvLayout {
  char separator = ',';
  bool has_header = false;
  TypeExpr tuple;
  std::vector<std::size_t> sources;                 ///< the column of each attribute
  std::vector<std::string> columns;                 ///< as the header names them; Column1, ... without one
  std::optional<stl::FileState> guessed_from = {};  ///< the file, if the types are guessed
};

/// Opens the file behind the lines to skip. Errors: those of TextFile.
Result<CsvReader> open_csv(const std::filesystem::path& path, char separator, const CsvOptions& options);

/// Reads the whole file: a column of numbers is int or real, one of TRUE and FALSE bool, any other string (plain_kind).
/// The first line is a header if all its cells are texts. Separators are looked for in the first lines; `,`, `;`,
/// tabulator and `|` are known. Errors: those of the reader; file_format for an empty file or a line of another length.
Result<CsvLayout> guess_csv_layout(const std::filesystem::path& path, const CsvOptions& options,
                                   const Context& context);

/// Reads the first lines: columns are found by their names if there is a header, else by their positions.
/// Errors: as above; unknown_name for an attribute without a column.
Result<CsvLayout> stated_csv_layout(const std::filesystem::path& path, const CsvOptions& options,
                                    const TypeExpr& tuple);

/// True for a cell that means undefined, whatever the type; a quoted empty cell is no such cell.
bool is_undefined_cell(const CsvCell& cell, const CsvOptions& options);
/// The text with a point for the decimal sign of the options; nothing to be done in most files.
std::string with_decimal_point(const std::string& text, char decimal);
/// The message for a record of another length.
std::string wrong_length_text(const CsvRecord& record, std::size_t expected);

}  // namespace queries
