#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/database/rows.h"
#include "algebra3d/database/value.h"

namespace algebra3d::database {

/// Values of the parameters `$name` of a statement. They are bound as values, so quotes and brackets in strings have no
/// meaning. An undefined one passes on its reason where it is used.
using Parameters = std::map<std::string, Value, std::less<>>;

struct OpenOptions {
  bool read_only = false;
  bool creates = true;  ///< create the file if it does not exist, unless `read_only`
  /// Folder of relative file names in statements; empty: the working directory of the process.
  std::filesystem::path folder = {};
  /// Memory limit in bytes of operators that sort, group and hash; beyond it they use temporary files. By default
  /// three quarters of what the machine or the process's control group has.
  std::optional<std::size_t> memory_bytes = {};
  /// Where a statement that ends with the error internal leaves a script that repeats the failure with the program
  /// `algebra3d`; the message names the file. Empty: nothing is written.
  std::filesystem::path failure_folder = {};
};

/// The effects of a statement or script besides its results.
struct Report {
  // Numbers of tuples of stored relations that operators have inserted, deleted and updated. Assignments of whole
  // objects by `let` and `update` do not count.
  std::uint64_t inserted = 0;
  std::uint64_t deleted = 0;
  std::uint64_t updated = 0;
  /// Reasons of undefined values, and remarks; equal ones appear once, with their number.
  std::vector<std::string> notes = {};
};

/// An open database: a file with relations, solids, indexes and other objects, and a query language (docs/language.md,
/// docs/operators.md). Several may be open in one process, also of the same file: readers never wait; a second writer
/// waits for the first, up to 5 seconds, and then ends with the error database_busy.
///
/// Each statement is a transaction of its own, except between `begin transaction` and `commit transaction`. After an
/// error the database is as before the statement. No function throws: exhausted memory is the error out_of_memory.
/// Errors in statements have the position in the text.
///
/// Movable. Used by one thread at a time, except for `cancel`; statements run on a thread that the database owns.
class Database {
 public:
  /// Receives the progress of a long statement, for people: "importing, 42 %".
  using Progress = std::function<void(const std::string& how_far)>;

  /// Opens a database. Errors: database_missing, database_foreign (another program's file), database_version (of a
  /// newer version), database_corrupt, database_busy (after 5 seconds), database_read_only, file_missing (also for an
  /// empty name or one with a zero byte), io_error.
  static Result<Database> open(const std::filesystem::path& file, const OpenOptions& options = {});
  /// Creates an empty database in a temporary folder, which is deleted when the database is closed. Ignores `read_only`
  /// and `creates`.
  static Result<Database> temporary(const OpenOptions& options = {});
  /// Closes the database. Rows that are being read keep it open.
  ~Database();
  Database(Database&& other) noexcept;
  Database& operator=(Database&& other) noexcept;

  /// Runs one statement and returns its rows: the tuples of a relation or stream, or a value as a row with one column,
  /// `value`. Rows have their values loaded; use `project` to drop columns. Changes are kept when the rows have been
  /// read to their end, see Rows. Errors: those of the statement up to its first row; later ones are returned by Rows.
  Result<Rows> query(std::string_view statement, const Parameters& parameters = {});
  /// Runs one query whose result is a single value. Errors: those of the query; type_error for any other result and any
  /// other statement, which has then changed nothing.
  Result<Value> value(std::string_view statement, const Parameters& parameters = {});
  /// Runs the statements of a script, which end with `;` or an empty line, up to the first that fails. Results are
  /// discarded; the findings of `check database` become notes of the report. Errors: those of the statement; io_error
  /// also if its result says that a file was not read or written.
  Status execute(std::string_view script, const Parameters& parameters = {});
  /// The report of the last statement or script; also after an error, which has undone the changes.
  const Report& report() const;

  /// Sets the callback for the progress of statements. It is called on the thread that waits for results, and must not
  /// throw.
  void on_progress(Progress progress);
  /// Ends the running statement with the error `interrupted`, if there is one, also while it waits for another writer.
  /// Any thread may call it at any time.
  void cancel() const noexcept;

  /// True after `begin transaction` until its end.
  bool is_in_transaction() const;
  const std::filesystem::path& file() const;
  /// A notice for the user about what opening did to the file, such as an upgrade; may be empty.
  const std::string& opening_notice() const;

 private:
  explicit Database(std::shared_ptr<detail::Engine> engine);

  std::shared_ptr<detail::Engine> engine_;  // null after a move
};

}  // namespace algebra3d::database
