#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/work_memory.h"
#include "queries/language/command.h"
#include "queries/language/session_parameters.h"
#include "queries/language/syntax_tree.h"
#include "queries/language/typed_tree.h"
#include "queries/session/detail/unusable.h"
#include "queries/store/store.h"
#include "queries/store/store_options.h"
#include "queries/streams/datum.h"

namespace queries {

/// The final result of a statement: the value of a query, or the new value of an object. In the language a file that
/// cannot be read or written yields undefined or FALSE; if that is the final result, the statement has failed without
/// an error.
class OwnResult {
 public:
  /// To be constructed before the expression is evaluated; the context outlives it.
  explicit OwnResult(const algebra3d::Context& context);
  /// The failure that the value shows: "undefined" or "FALSE"; empty if there is none.
  std::string_view failure(const Datum& value) const;

 private:
  const algebra3d::Diagnostics& diagnostics_;
  std::uint64_t unreadable_before_;
  std::uint64_t unwritten_before_;
};

class SavedText;  // detail/saved_text.h

/// Receives the result of a statement while the statement runs; the presenter pulls relations from the database.
class Presenter {
 public:
  virtual ~Presenter() = default;
  Presenter() = default;
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;
  /// Receives the statement once it is read, before it runs; not called for one with a syntax error.
  virtual void begin(const Command& /*command*/) {}
  /// Receives the result of a query.
  virtual Status present(const TypeExpr& type, const Datum& value, Context& context) = 0;
  /// Receives the result list of an inquiry, `(inquiry (...))`.
  virtual Status present_inquiry(const NestedList& result) = 0;
  /// Whether the result of a query may be a stream, which `present` then pulls. If not, queries must end with `consume`
  /// or `count`.
  virtual bool takes_streams() const { return false; }
  /// Whether a sequence or loop ends at a command without an error whose result reports a failure
  /// (`Session::failed_result`).
  virtual bool ends_at_failed_result() const { return false; }
  /// Whether `present` may be called again after it has failed, because nothing was shown.
  virtual bool can_begin_again() const { return false; }
  /// Whether only queries may run: other commands end with type_error before they change anything.
  virtual bool takes_queries_only() const { return false; }
  /// Whether `present_inquiry` shows the list to somebody. If not, the findings of `check database` become notes.
  virtual bool shows_inquiries() const { return true; }
  /// Receives the progress of a long statement, for people: "42 % (Parts)". Called many times a second.
  virtual void advance(const std::string& /*how_far*/) {}
};

struct SessionOptions {
  /// Folder of the databases of `create`, `open` and `delete database N`.
  std::filesystem::path folder = ".";
  bool read_only = false;
  /// Memory limit of the session, unless `set "memory"` changes it. Operators that sort, group, hash or materialise
  /// go on in temporary files before it is reached (MemoryAccount); everything else ends with limit_exceeded there, if
  /// the program counts its heap (base/memory_limit.h). Of shared sessions: the limit of all of them together, which
  /// the host sets.
  std::size_t memory_bytes = algebra3d::WorkMemory::default_limit();
  /// Options for the shell, changed by `set`: print the time of each statement, and page long results.
  bool shows_timing = false;
  bool uses_pager = true;
  /// Whether `restore` reads the files outside of the saved file's folder, and the environment variables, that a saved
  /// file names; changed by `set`.
  bool restore_reads = false;
  /// Folders for the reports of statements that end with the error internal: the first that takes one gets it.
  /// None: no reports are written.
  std::vector<std::filesystem::path> failure_folders = {};
  /// Whether plans are rewritten (queries/language/rewriting.h); changed by `set`.
  bool rewrites_plans = true;
  /// The values of `$name` in commands.
  SessionParameters parameters = {};
  /// Whether the session runs statements of many users on one database: commands that open, close, make or delete
  /// databases, set options or take part in a transaction over several commands end with wrong_usage, and the advice
  /// what to do instead.
  bool is_shared = false;
  /// Whether `open_file` creates a database that does not exist.
  bool creates = true;
  /// Size of the cache of loaded geometry, in bytes; by default a twelfth of the memory limit.
  std::optional<std::size_t> cache_bytes = {};
};

/// One user's session, with the open database, if any. Runs statements from text to result, each as one transaction.
/// Used by one thread. The registry outlives the session.
class Session {
 public:
  Session(const algebra3d::Registry& registry, SessionOptions options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Opens a database file, and creates it if it does not exist (unless read-only).
  Status open_file(const std::filesystem::path& file);
  /// Whether `open_file` has created the database; its name may be mistyped, so the user must be notified.
  bool has_made_database() const { return has_made_database_; }
  /// Runs one command. Reasons of undefined values and remarks go to `context.diagnostics`. Never throws: exhausted
  /// memory becomes error out_of_memory, or limit_exceeded at a memory limit. After an error the database is as before
  /// the command. The message of an error internal names the report, a script that repeats the failure, or says why
  /// there is none.
  Status execute(std::string_view text, const SourcePlace& start, Presenter& presenter, Context& context);
  /// The failure that the result of the last statement shows because a file could not be read or written: "undefined"
  /// or "FALSE"; else empty. Such a statement is committed all the same.
  std::string_view failed_result() const { return failed_result_; }

  /// Null while no database is open.
  Store* store() { return store_.get(); }
  const algebra3d::Registry& registry() const { return registry_; }
  /// The present options; `set` changes some of them.
  const SessionOptions& options() const { return options_; }
  /// Sets the values of `$name` for the following commands.
  void set_parameters(SessionParameters parameters) { options_.parameters = std::move(parameters); }

 private:
  class Objects;
  class Restorer;
  class UnusableSearch;

  Status run_caught(std::string_view text, const SourcePlace& start, Presenter& presenter, Context& context);
  /// Writes the report of a failure, if there are folders for it, and names it in the message.
  void report_failure(Error& error, std::string_view text, const Context& context) const;
  Status run(const Command& command, Presenter& presenter, Context& context);

  // databases.cpp
  Status run(const CreateDatabase& command, Presenter& presenter, Context& context);
  Status run(const DeleteDatabase& command, Presenter& presenter, Context& context);
  Status run(const OpenDatabase& command, Presenter& presenter, Context& context);
  Status run(const CloseDatabase& command, Presenter& presenter, Context& context);
  Status run(const TransactionStep& command, Presenter& presenter, Context& context);
  Status run(const CheckDatabase& command, Presenter& presenter, Context& context);

  // saving.cpp, restoring.cpp
  Status run(const SaveDatabase& command, Presenter& presenter, Context& context);
  Status run(const SaveObject& command, Presenter& presenter, Context& context);
  Status run(const RestoreDatabase& command, Presenter& presenter, Context& context);
  Status run(const RestoreObject& command, Presenter& presenter, Context& context);

  // object_commands.cpp
  Status run(const CreateObject& command, Presenter& presenter, Context& context);
  Status run(const LetObject& command, Presenter& presenter, Context& context);
  Status run(const UpdateObject& command, Presenter& presenter, Context& context);
  Status run(const DeriveObject& command, Presenter& presenter, Context& context);
  Status run(const DeleteObject& command, Presenter& presenter, Context& context);
  Status run(const RenameObject& command, Presenter& presenter, Context& context);
  Status run(const DefineType& command, Presenter& presenter, Context& context);
  Status run(const DeleteType& command, Presenter& presenter, Context& context);

  // control.cpp
  Status run(const Conditional& command, Presenter& presenter, Context& context);
  Status run(const Loop& command, Presenter& presenter, Context& context);
  Status run(const Sequence& command, Presenter& presenter, Context& context);
  Status run(const SetOption& command, Presenter& presenter, Context& context);

  Status run(const Query& command, Presenter& presenter, Context& context);
  Status run(const Explain& command, Presenter& presenter, Context& context);
  Status run(const Inquiry& command, Presenter& presenter, Context& context);

  /// Runs `work` as one statement of the open database, or without one if none is open.
  Status in_transaction(bool writes, const std::function<Status()>& work);
  /// Evaluates an expression whose value is not a stream, as a statement of its own.
  Result<Value> evaluate_alone(const Expression& expression, Context& context);
  Status set_memory(const Value& value, const SourcePlace& place);
  Result<bool> holds(const Expression& condition, std::string_view command, Context& context);
  void judge(const OwnResult& result, const Datum& value);
  bool has_failed_by_result(const Presenter& presenter) const {
    return !failed_result_.empty() && presenter.ends_at_failed_result();
  }
  Result<Store*> required_store();
  static Status check_new_name(const std::string& name, const SourcePlace& place, std::string_view what = "an object");
  Status require_closed();
  Status open_store(const std::filesystem::path& file, OpenMode mode);
  Result<std::vector<Finding>> findings(Presenter& presenter, Context& context);
  Result<std::filesystem::path> database_file(const std::string& name) const;
  /// Restores objects from a file. Returns the names of the objects that had to be left out.
  Result<std::vector<std::string>> restore_into(const std::filesystem::path& file, OpenMode mode,
                                                const SavedText& saved, Context& context);
  Result<std::vector<std::string>> restore_new(const std::filesystem::path& file, const SavedText& saved,
                                               Context& context);
  Status empty_database();
  Result<TypedPtr> checked_definition(const Expression& value, bool is_derived, Objects& objects, Context& context);
  /// The value is stored under the name `interim` first, if given.
  Status define(const std::string& name, const Expression& value, bool is_derived, Context& context,
                const std::string& interim = {});
  /// The functions that fail and the objects that can no longer be derived. Call within a statement. `gone`: names of
  /// objects that are being deleted.
  Result<UnusableDefinitions> unusable_definitions(Context& context, const GoneNames& gone = {});
  /// Reports the objects that `restore` will leave out: all of them, or only `name`.
  Status note_underivable(const std::string& name, Context& context);
  /// Runs `change` and reports the definitions that it made unusable.
  Status change_definitions(std::string_view command, Context& context, const std::function<Status()>& change);
  /// Removes an object and reports what is removed with it.
  Status remove(const std::string& name, bool kills, std::string_view command, Context& context);

  const algebra3d::Registry& registry_;
  SessionOptions options_;
  algebra3d::MemoryUser memory_user_;  // not of shared sessions: each statement has its own there
  algebra3d::WorkMemory memory_;
  std::unique_ptr<Store> store_;
  std::string_view failed_result_;
  bool has_made_database_ = false;
  /// A database that is too damaged to open. Only `check database` and closing it are possible.
  struct Damaged {
    std::filesystem::path file;
    Error error;
  };
  std::optional<Damaged> damaged_;
};

/// Makes a folder for reports of failures if it does not exist. Errors: io_error if it cannot be made or takes no
/// files.
Status prepare_failure_folder(const std::filesystem::path& folder);

/// The result list `(T V)` of a query. Errors: not_evaluable for streams and tuples.
Result<NestedList> result_list(const TypeExpr& type, const Datum& value, Context& context);
/// The value list V of a result.
Result<NestedList> value_list(const TypeExpr& type, const Datum& value, Context& context);

}  // namespace queries
