#include "algebra3d/base/error.h"

#include <array>

#include <fmt/format.h>

namespace algebra3d {
namespace {

using enum ErrorCode;

// In the order of the enumerators, so that the row of a code is found by its position.
constexpr std::array kDescriptions = {
    ErrorDescription{syntax_error, "syntax_error", "42601", "The text is not a command of the language.",
                     "Correct the text at the given position; `help` shows the syntax of an operator."},
    ErrorDescription{unknown_name, "unknown_name", "42704",
                     "A name is neither an object, an attribute, a type nor an operator.",
                     "Check the spelling; `list objects` and `list operators` show what there is."},
    ErrorDescription{type_error, "type_error", "42804", "No overload of the operator takes arguments of these types.",
                     "Compare the types with the signatures that `help OPERATOR` shows."},
    ErrorDescription{reserved_name, "reserved_name", "42939", "The name belongs to the language.",
                     "Choose another name."},
    ErrorDescription{name_exists, "name_exists", "42710", "An object of this name exists.",
                     "Choose another name, or delete the object first."},
    ErrorDescription{not_evaluable, "not_evaluable", "0A000", "The query has no result that can be shown.",
                     "End a stream with `consume` or `count`; give a created object a value with `update`."},
    ErrorDescription{invalid_value, "invalid_value", "22P02",
                     "A literal does not have the form that its type requires.",
                     "Compare the literal with the notation of its type."},
    ErrorDescription{no_database, "no_database", "3D000", "The command needs an open database.",
                     "Start with `--db FILE`, or use `create database N` and `open database N`."},
    ErrorDescription{database_exists, "database_exists", "42P04", "A database of this name exists.",
                     "Open it, or choose another name."},
    ErrorDescription{database_missing, "database_missing", "3D000", "There is no database of this name.",
                     "Check the name and the folder (`--dir`), or create the database."},
    ErrorDescription{database_open, "database_open", "55006", "A database is open.",
                     "Close it first with `close database`."},
    ErrorDescription{database_corrupt, "database_corrupt", "XX001", "Stored data are damaged.",
                     "Restore the file from a backup; nothing was changed."},
    ErrorDescription{database_foreign, "database_foreign", "58P01", "The file is not an algebra3d database.",
                     "Name another file."},
    ErrorDescription{database_version, "database_version", "0A000", "The database was written by a newer version.",
                     "Use that version of algebra3d."},
    ErrorDescription{database_busy, "database_busy", "55P03", "Another process is writing to the database.",
                     "Try again when it has finished."},
    ErrorDescription{database_read_only, "database_read_only", "25006", "The database cannot be written.",
                     "Check the permissions of the file and its folder, or the option --read-only."},
    ErrorDescription{disk_full, "disk_full", "53100", "The disk is full.", "Free some space; nothing was changed."},
    ErrorDescription{file_missing, "file_missing", "58P01", "A file does not exist or cannot be read.",
                     "Check the name and the permissions."},
    ErrorDescription{file_format, "file_format", "22000", "A file does not have the announced format.",
                     "Look at the byte that the message gives."},
    ErrorDescription{io_error, "io_error", "58030", "Reading or writing failed.", "Check the device, then try again."},
    ErrorDescription{permission_denied, "permission_denied", "42501", "The host does not allow this.",
                     "Use another file within the working folder, or run the statement in the shell."},
    ErrorDescription{limit_exceeded, "limit_exceeded", "54000", "A limit of the program is exceeded.",
                     "Split the work; the message names the limit."},
    ErrorDescription{out_of_memory, "out_of_memory", "53200", "Memory is exhausted.", "Split the work or add memory."},
    ErrorDescription{interrupted, "interrupted", "57014", "The statement was interrupted.",
                     "Run it again; nothing was changed."},
    ErrorDescription{wrong_usage, "wrong_usage", "42000", "The command cannot be used like this.",
                     "The message says what is possible."},
    ErrorDescription{internal, "internal", "XX000", "An internal error.",
                     "Please report it, with the file that the message names or else with the command."},
};

constexpr bool rows_follow_enumerators() {
  for (std::size_t row = 0; row < kDescriptions.size(); ++row)
    if (static_cast<std::size_t>(kDescriptions[row].code) != row) return false;
  return kDescriptions.size() == static_cast<std::size_t>(internal) + 1;
}
static_assert(rows_follow_enumerators());

}  // namespace

const ErrorDescription& describe(ErrorCode code) {
  return kDescriptions[static_cast<std::size_t>(code)];
}

Error Error::at(SourcePlace where) && {
  if (!place.is_known()) place = std::move(where);
  return std::move(*this);
}

Error Error::about(std::string_view what) && {
  subject = subject.empty() ? std::string(what) : fmt::format("{}: {}", what, subject);
  return std::move(*this);
}

std::string Error::text() const {
  return subject.empty() ? message : fmt::format("{}: {}", subject, message);
}

}  // namespace algebra3d
