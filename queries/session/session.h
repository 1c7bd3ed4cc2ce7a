#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/context.h"
#include "algebra3d/base/work_memory.h"
#include "algebra3d/registry/registry.h"
#include "queries/language/command.h"
#include "queries/language/session_parameters.h"
#include "queries/language/typed_tree.h"
#include "queries/session/own_result.h"
#include "queries/session/unusable.h"
#include "queries/store/store.h"

namespace queries {

/// Takes the result of a statement while it is being run: relations are pulled from the database by the presenter.
class Presenter {
 public:
  virtual ~Presenter() = default;
  Presenter() = default;
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;
  /// The result of a query.
  virtual Status present(const TypeExpr& type, const Datum& value, Context& context) = 0;
  /// The result list of an inquiry, `(inquiry (...))`.
  virtual Status present_inquiry(const NestedList& result) = 0;
  /// Whether a command of a sequence or loop that had no error has failed all the same by its result
  /// (`Session::failed_result`), so that the rest does not run.
  virtual bool ends_at_failed_result() const { return false; }
  /// How far a long statement has come, for people: "42 % (Parts)". Comes many times a second.
  virtual void advance(const std::string& /*how_far*/) {}
};

struct SessionOptions {
  /// Folder of the databases that `create`, `open` and `delete database N` mean.
  std::filesystem::path folder = ".";
  bool read_only = false;
  /// What operators that sort, group, hash or materialise may keep in memory, as long as `set "memory"` says nothing
  /// else.
  std::size_t memory_bytes = algebra3d::WorkMemory::default_limit();
  /// What the face of a session does with results, as `set` says: tell how long each statement took, and page long
  /// ones.
  bool shows_timing = false;
  bool uses_pager = true;
  /// What `$name` stands for in commands.
  SessionParameters parameters = {};
};

/// One user's state: the open database, if any. Runs statements from text to result; each is one transaction, which
/// happens or does not. Used by one thread. The registry outlives the session.
class Session {
 public:
  Session(const algebra3d::Registry& registry, SessionOptions options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Opens that file, and creates it if it is not there (unless read-only).
  Status open_file(const std::filesystem::path& file);
  /// Runs one command. Reasons of undefined values and remarks go to `context.diagnostics`. Never throws: exhausted
  /// memory becomes error out_of_memory. After an error the database is as before the command.
  Status execute(std::string_view text, const SourcePlace& start, Presenter& presenter, Context& context);
  /// How the statement that was executed last tells by its own result that it has failed, since a file could not be
  /// read or written: "undefined" or "FALSE"; empty if it does not. The statement has happened all the same.
  std::string_view failed_result() const { return failed_result_; }

  /// Null while no database is open.
  Store* store() { return store_.get(); }
  const algebra3d::Registry& registry() const { return registry_; }
  /// As they are now: `set` changes some of them.
  const SessionOptions& options() const { return options_; }

 private:
  class Objects;
  class Restorer;
  class UnusableSearch;

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
  /// Evaluates an expression whose value is no stream, as a statement of its own.
  Result<Value> evaluate_alone(const Expression& expression, Context& context);
  Status set_memory(const Value& value, const SourcePlace& place);
  Result<bool> holds(const Expression& condition, std::string_view command, Context& context);
  void judge(const OwnResult& result, const Datum& value);
  bool has_failed_by_result(const Presenter& presenter) const {
    return !failed_result_.empty() && presenter.ends_at_failed_result();
  }
  Result<Store*> required_store();
  Status check_new_name(const std::string& name, std::string_view what = "an object");
  Status require_closed();
  Status open_store(const std::filesystem::path& file, OpenMode mode);
  Result<std::vector<Finding>> findings(Presenter& presenter, Context& context);
  Result<std::filesystem::path> database_file(const std::string& name) const;
  /// The names of the objects that had to be left out.
  Result<std::vector<std::string>> restore_into(const std::filesystem::path& file, OpenMode mode, std::string_view text,
                                                const std::string& name, Context& context);
  Result<std::vector<std::string>> restore_new(const std::filesystem::path& file, std::string_view text,
                                               const std::string& name, Context& context);
  Status empty_database();
  /// The value is made under the name `interim`, if there is one.
  Status define(const std::string& name, const Expression& value, bool is_derived, Context& context,
                const std::string& interim = {});
  /// The functions that fail and the objects that cannot be derived again, within a statement.
  /// `gone` are names that were those of objects until now.
  Result<UnusableDefinitions> unusable_definitions(Context& context, const GoneNames& gone = {});
  /// Notes of all objects, or of one, which of them `restore` will leave out.
  Status note_underivable(const std::string& name, Context& context);
  /// Runs `change` and notes which of them it made so.
  Status change_definitions(std::string_view command, Context& context, const std::function<Status()>& change);
  /// Removes an object and notes what goes with it.
  Status remove(const std::string& name, bool kills, std::string_view command, Context& context);

  const algebra3d::Registry& registry_;
  SessionOptions options_;
  algebra3d::WorkMemory memory_;
  std::unique_ptr<Store> store_;
  std::string_view failed_result_;
  /// A database that did not open since it is damaged: `check database` looks at it, and nothing else is done before it
  /// is closed.
  struct Damaged {
    std::filesystem::path file;
    Error error;
  };
  std::optional<Damaged> damaged_;
};

/// The result list `(T V)` of a query. Streams and tuples have none: error not_evaluable.
Result<NestedList> result_list(const TypeExpr& type, const Datum& value, Context& context);
/// The value list V alone.
Result<NestedList> value_list(const TypeExpr& type, const Datum& value, Context& context);

}  // namespace queries
