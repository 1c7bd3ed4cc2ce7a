// The commands of a session that restore a database or an object from a nested list. It is read object by object and
// tuple by tuple; everything happens in one transaction.
#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "algebra3d/values/types/file_atom.h"
#include "base/propagate.h"
#include "base/text.h"
#include "queries/language/checker.h"
#include "queries/language/list_pieces.h"
#include "queries/language/nested_reader.h"
#include "queries/language/parser.h"
#include "queries/language/syntax_tree.h"
#include "queries/session/detail/effects.h"
#include "queries/session/detail/objects.h"
#include "queries/session/detail/restore_guard.h"
#include "queries/session/detail/saved_list.h"
#include "queries/session/detail/saved_text.h"
#include "queries/session/session.h"
#include "queries/store/database_creation.h"
#include "queries/store/database_draft.h"
#include "queries/store/store_options.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

/// An error of the interim file as one of the database that the user named.
Error told_of(const std::filesystem::path& file, const std::filesystem::path& interim, Error error) {
  error.subject = algebra3d::with_replaced(std::move(error.subject), interim.string(), file.string());
  return error;
}

/// Whether an error of an expression is about the machine or the database, so that others would meet it, too.
bool ends_restoring(ErrorCode code) {
  switch (code) {
    case ErrorCode::interrupted:
    case ErrorCode::out_of_memory:
    case ErrorCode::disk_full:
    case ErrorCode::internal:
    case ErrorCode::database_corrupt:
    case ErrorCode::database_busy:
    case ErrorCode::database_read_only:
      return true;
    default:
      return false;
  }
}

/// Whether what the expression lacks may be there when other objects have been made.
bool may_wait_for_another(ErrorCode code) {
  return code == ErrorCode::unknown_name || code == ErrorCode::syntax_error || code == ErrorCode::type_error ||
         code == ErrorCode::not_evaluable;
}

/// Asks for each file in a value that was refused because of one, so that the guard knows all. Recursion follows the
/// nesting, which the parser of lists bounds. NOLINTNEXTLINE(misc-no-recursion)
void ask_for_files(const NestedList& list, const Context& context) {
  if (algebra3d::is_file_atom(list)) static_cast<void>(algebra3d::file_atom_content(list, context));
  if (!list.is_list()) return;
  for (const NestedList& element : list.elements()) ask_for_files(element, context);
}

}  // namespace

/// Reads objects out of a saved list into the store. Lives for one statement. Its evaluations change nothing else, and
/// read the files that the guard allows; after a refusal it goes on, so that the guard knows all files, and the result
/// is to be dropped.
class Session::Restorer {
 public:
  Restorer(const algebra3d::Registry& registry, Store& store, ListPieces& pieces, RestoreGuard& guard,
           const Context& context)
      : registry_(registry),
        store_(store),
        pieces_(pieces),
        guard_(guard),
        context_(within(context, guard)),
        objects_(registry, &store, context_) {}

  /// `(DATABASE name (DESCRIPTIVE ALGEBRA) (TYPES ...) (OBJECTS ...))`
  Status database();
  /// `(OBJECT name () type value ())`, under another name if one is given.
  Status object(const std::string& new_name);
  /// The objects that could not be derived again, by name; the reasons are in the context.
  const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  struct Dependent {
    std::string name;
    NestedList expression;
    std::optional<TypeExpr> index_type;  // of an index, which is an object as any other; none: derived
    SourcePlace place;
    bool was_defined = false;
  };
  struct Evaluated {
    TypeExpr type;
    Datum value;
  };

  static Context within(Context context, RestoreGuard& guard) {
    context.reads = &guard;
    context.unchanging = "a saved file is being restored";
    return context;
  }

  Status section();
  Status dependent_objects();
  Status named_type();
  Status object_content(std::string name);
  Status value_of(const std::string& name, const TypeExpr& type);
  Status relation_value(const std::string& name, const TypeExpr& type);
  Status rest_of_object();
  /// The value of a list, undefined if it names a refused file.
  Result<Value> read_value(const algebra3d::Type& type, const NestedList& list);
  Status restore_function(const std::string& name, const TypeExpr& type, const NestedList& list,
                          const SourcePlace& place);
  void leave_out(const std::string& name, const std::string& reason);
  Status tell_of_functions();
  Result<Evaluated> evaluate(const Dependent& dependent);
  Status store(const Dependent& dependent, const Evaluated& evaluated);
  Result<TypeExpr> type();
  Result<std::string> symbol(std::string_view what);

  const algebra3d::Registry& registry_;
  Store& store_;
  ListPieces& pieces_;
  RestoreGuard& guard_;
  Context context_;
  Objects objects_;
  std::vector<Dependent> dependents_;  // to be made when the others are there
  std::vector<std::string> left_out_;
  std::vector<std::pair<std::string, ExpressionPtr>> functions_;
};

Result<std::string> Session::Restorer::symbol(std::string_view what) {
  const SourcePlace place = pieces_.place();
  A3D_ASSIGN(const NestedList list, pieces_.read(what));
  if (list.is_symbol()) return list.as_symbol();
  return Error(ErrorCode::invalid_value, "expected {}, found {}", what, list.print_short()).at(place);
}

Result<TypeExpr> Session::Restorer::type() {
  const SourcePlace place = pieces_.place();
  A3D_ASSIGN(NestedList list, pieces_.read("a type"));
  // Types without arguments may stand in parentheses.
  if (list.is_list() && list.elements().size() == 1) list = NestedList(list.elements().front());
  // Types of indexes are made by operators and never written, so that the checker knows none.
  if (auto index = TypeExpr::from_nested(list); index && is_index(*index)) return index;
  A3D_ASSIGN(const TypeSyntax syntax, NestedReader(registry_, place).type(list));
  return Checker(registry_, objects_, context_).resolve(syntax);
}

Status Session::Restorer::database() {
  A3D_TRY(pieces_.enter());
  A3D_ASSIGN(const std::string head, symbol("DATABASE"));
  if (head != "DATABASE")
    return Error{ErrorCode::invalid_value, "restore: expected a list (DATABASE ...), found ({} ...)", head};
  A3D_TRY(symbol("the name of the database"));
  A3D_TRY(pieces_.read("(DESCRIPTIVE ALGEBRA)"));
  A3D_TRY(section());
  A3D_TRY(section());
  A3D_TRY(pieces_.leave());
  return dependent_objects();
}

// `(TYPES (TYPE name type)...)` or `(OBJECTS (OBJECT ...)...)`
Status Session::Restorer::section() {
  A3D_TRY(pieces_.enter());
  A3D_ASSIGN(const std::string head, symbol("TYPES or OBJECTS"));
  if (head != "TYPES" && head != "OBJECTS")
    return Error{ErrorCode::invalid_value, "restore: expected TYPES or OBJECTS, found {}", head};
  while (pieces_.enter()) {
    A3D_TRY(context_.check_cancelled());
    A3D_TRY(head == "TYPES" ? named_type() : object_content({}));
  }
  return pieces_.leave();
}

Status Session::Restorer::named_type() {
  A3D_TRY(symbol("TYPE"));
  A3D_ASSIGN(const std::string name, symbol("the name of a type"));
  A3D_ASSIGN(const TypeExpr named, type());
  A3D_TRY(store_.create_type(name, named));
  return pieces_.leave();
}

Status Session::Restorer::object(const std::string& new_name) {
  A3D_TRY(pieces_.enter());
  A3D_TRY(object_content(new_name));
  return dependent_objects();
}

// The content between the parentheses of an object, and the closing one.
Status Session::Restorer::object_content(std::string name) {
  const SourcePlace place = pieces_.place();
  A3D_ASSIGN(const std::string head, symbol("OBJECT or DERIVED"));
  if (head != "OBJECT" && head != "DERIVED")
    return Error(ErrorCode::invalid_value, "expected OBJECT or DERIVED, found {}", head).at(place);
  A3D_ASSIGN(const std::string saved_name, symbol("the name of an object"));
  if (name.empty()) name = saved_name;
  if (is_reserved(name))
    return Error(ErrorCode::reserved_name, "'{}' is a word of the language and cannot name an object", name).at(place);
  if (head == "DERIVED") {
    A3D_ASSIGN(NestedList expression, pieces_.read("an expression"));
    A3D_ASSIGN(const auto mark, pieces_.next());
    dependents_.push_back({name, std::move(expression), std::nullopt, place, mark == kWasDefined});
    return mark ? rest_of_object() : pieces_.leave();
  }
  A3D_TRY(pieces_.read("the name of the type, or ()"));
  A3D_ASSIGN(const TypeExpr object_type, type());
  auto status = value_of(name, object_type);
  if (!status) {
    Error error = std::move(status).error().about("object '" + name + "'");
    return error.place.is_known() ? std::move(error) : std::move(error).at(place);
  }
  return rest_of_object();
}

// Further elements say how the object was stored elsewhere.
Status Session::Restorer::rest_of_object() {
  while (true) {
    A3D_ASSIGN(const auto piece, pieces_.next());
    if (!piece) return pieces_.leave();
  }
}

Status Session::Restorer::value_of(const std::string& name, const TypeExpr& type) {
  if (type.is_relation()) return relation_value(name, type);
  const SourcePlace place = pieces_.place();
  A3D_ASSIGN(const auto piece, pieces_.next());
  if (!piece) return store_.create(name, type);
  A3D_ASSIGN(NestedList list, pieces_.parse(*piece));
  if (is_index(type)) {
    dependents_.push_back({name, std::move(list), type, place, false});
    return {};
  }
  if (type.is_function()) return restore_function(name, type, list, place);
  A3D_TRY(store_.create(name, type));
  const algebra3d::Type* value_type = registry_.value_type(type);
  if (value_type == nullptr) return Error{ErrorCode::unknown_name, "unknown type {}", type.text()};
  A3D_ASSIGN(Value value, read_value(*value_type, list));
  return store_.assign(name, Datum{std::move(value)}, context_);
}

Result<Value> Session::Restorer::read_value(const algebra3d::Type& type, const NestedList& list) {
  const std::size_t refusals_before = guard_.refusal_count();
  auto value = algebra3d::value_from_nested(type, list, context_);
  if (value || guard_.refusal_count() == refusals_before) return value;
  ask_for_files(list, context_);
  return Value(type);
}

Status Session::Restorer::restore_function(const std::string& name, const TypeExpr& type, const NestedList& list,
                                           const SourcePlace& place) {
  A3D_ASSIGN(ExpressionPtr function, NestedReader(registry_, place).expression(list));
  functions_.emplace_back(name, std::move(function));
  return store_.create_function(name, type, list.print());
}

Status Session::Restorer::relation_value(const std::string& name, const TypeExpr& type) {
  A3D_TRY(store_.create(name, type));
  if (!pieces_.enter()) {
    A3D_ASSIGN(const auto piece, pieces_.next());
    if (!piece) return {};  // created and never given a value
    return Error{ErrorCode::invalid_value, "expected a list of tuples, found {}", piece->substr(0, 40)};
  }
  std::vector<const algebra3d::Type*> types;
  for (const auto& attribute : type.element().attributes()) types.push_back(registry_.value_type(attribute.type));
  std::size_t number = 0;
  const auto tuples = make_stream([&]() -> Result<TuplePtr> {
    A3D_ASSIGN(const auto piece, pieces_.next());
    if (!piece) return TuplePtr();
    ++number;
    A3D_ASSIGN(const NestedList row, pieces_.parse(*piece));
    if (!row.is_list() || row.elements().size() != types.size())
      return Error{ErrorCode::invalid_value, "tuple {}: expected a list of {} values, got {}", number, types.size(),
                   row.print_short()};
    auto tuple = std::make_shared<Tuple>();
    for (std::size_t index = 0; index < types.size(); ++index) {
      auto value = read_value(*types[index], row.elements()[index]);
      if (!value)
        return std::move(value).error().about(
            fmt::format("tuple {}, attribute {}", number, type.element().attributes()[index].name));
      tuple->attributes.push_back(std::move(value).value());
    }
    return TuplePtr(std::move(tuple));
  });
  A3D_TRY(store_.assign(name, Datum{tuples}, context_));
  return pieces_.leave();
}

// They may depend on each other in any order: those that can be made are made, until none is left or none can. One that
// cannot, since something that it uses was renamed, made anew without a value, or lies in a file that is gone, must not
// keep the rest away.
Status Session::Restorer::dependent_objects() {
  A3D_TRY(tell_of_functions());
  std::vector<std::string> reasons;
  for (bool is_new = true; is_new;) {
    is_new = false;
    reasons.clear();
    std::vector<Dependent> later;
    for (Dependent& dependent : std::exchange(dependents_, {})) {
      const std::size_t refusals_before = guard_.refusal_count();
      const auto evaluated = evaluate(dependent);
      if (evaluated) {
        A3D_TRY(store(dependent, *evaluated));
        is_new = true;
        continue;
      }
      if (guard_.refusal_count() > refusals_before) continue;
      const ErrorCode code = evaluated.error().code;
      if (ends_restoring(code)) return Error(evaluated.error()).at(dependent.place);
      if (may_wait_for_another(code)) {
        reasons.push_back(evaluated.error().text());
        later.push_back(std::move(dependent));
      } else {
        leave_out(dependent.name, evaluated.error().text());
      }
    }
    dependents_ = std::move(later);
  }
  for (std::size_t i = 0; i < dependents_.size(); ++i) {
    if (guard_.refusal_count() > 0) guard_.add_untried(dependents_[i].name);
    leave_out(dependents_[i].name, reasons[i]);
  }
  std::ranges::sort(left_out_);
  return {};
}

// After a refusal all is dropped in the end.
void Session::Restorer::leave_out(const std::string& name, const std::string& reason) {
  left_out_.push_back(name);
  if (guard_.has_refused()) return;
  context_.diagnostics.report("restore: '" + name + "' is left out, it cannot be derived again: " + reason);
}

// A function is not evaluated now. One that changes something keeps its name, unless an operator has it: then every
// call fails.
Status Session::Restorer::tell_of_functions() {
  for (const auto& [name, function] : functions_) {
    A3D_ASSIGN(const auto change, find_change(*function, store_, registry_));
    if (!change) continue;
    const Status callable = check_operator_name(name, *function, store_, registry_);
    context_.diagnostics.show(callable ? "restore: the function '" + name + "' " + change->text() + " when it is called"
                                       : "restore: calls will fail: " + callable.error().text());
  }
  return {};
}

Result<Session::Restorer::Evaluated> Session::Restorer::evaluate(const Dependent& dependent) {
  Objects objects(registry_, &store_, context_);
  A3D_ASSIGN(const ExpressionPtr expression, NestedReader(registry_, dependent.place).expression(dependent.expression));
  A3D_ASSIGN(const auto change, find_change(*expression, store_, registry_));
  if (change) return Error{ErrorCode::wrong_usage, "its expression {}", change->text()};
  A3D_ASSIGN(const TypedPtr node, Checker(registry_, objects, context_).check_result(*expression));
  A3D_ASSIGN(Datum value, node->evaluate(nullptr, context_));
  const auto* single = std::get_if<Value>(&value.content);
  if (dependent.was_defined && single != nullptr && !single->is_defined())
    return Error{ErrorCode::invalid_value, "it had a value when it was saved and is undefined now"};
  return Evaluated{node->type(), std::move(value)};
}

Status Session::Restorer::store(const Dependent& dependent, const Evaluated& evaluated) {
  A3D_TRY(dependent.index_type ? store_.create(dependent.name, evaluated.type)
                               : store_.create_derived(dependent.name, evaluated.type, dependent.expression.print()));
  return store_.assign(dependent.name, evaluated.value, context_);
}

Status Session::run(const RestoreObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(check_new_name(command.name, command.name_place));
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(command.file));
  A3D_ASSIGN(const SavedText saved, SavedText::open(path, command.file, context.cancel));
  return in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto existing, store->find(command.name));
    if (existing)
      return Error(ErrorCode::name_exists, "there is an object '{}' already; delete it first", command.name)
          .at(command.name_place);
    ListPieces pieces(saved.text(), saved.name());
    RestoreGuard guard(saved, options_.restore_reads);
    Restorer restorer(registry_, *store, pieces, guard, context);
    A3D_TRY(restorer.object(command.name));
    A3D_TRY(guard.verdict(options_.is_shared, context));
    if (restorer.left_out().empty()) return {};
    return Error{ErrorCode::not_evaluable, "restore: '{}' cannot be derived again; nothing was restored", command.name};
  });
}

// A new database is made beside its place and appears when it is complete; an existing one is emptied and filled in one
// transaction. Either way it is open afterwards. Objects that cannot be derived again are missing in a new database,
// and the command fails all the same; in place of an existing one that still has their values it does nothing.
Status Session::run(const RestoreDatabase& command, Presenter&, Context& context) {
  A3D_TRY(require_closed());
  if (options_.read_only) return Error{ErrorCode::database_read_only, "restore database: the session is read-only"};
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(command.file));
  A3D_ASSIGN(const SavedText saved, SavedText::open(path, command.file, context.cancel));
  A3D_ASSIGN(const auto file, database_file(command.name));
  std::error_code error;
  const bool is_new = !std::filesystem::exists(file, error);
  if (!is_new) A3D_TRY(check_not_open_elsewhere(file, "restore"));
  A3D_ASSIGN(const auto left_out,
             is_new ? restore_new(file, saved, context) : restore_into(file, OpenMode::read_write, saved, context));
  A3D_ASSIGN(store_, Store::open(file, OpenMode::read_write, registry_));
  if (left_out.empty()) return {};
  return Error{ErrorCode::not_evaluable,
               "restore: the database '{}' was restored and is open, without these objects, which cannot be derived "
               "again: {}",
               command.name, fmt::join(left_out, ", ")};
}

Result<std::vector<std::string>> Session::restore_new(const std::filesystem::path& file, const SavedText& saved,
                                                      Context& context) {
  remove_database_leftovers(file);
  A3D_ASSIGN(DatabaseDraft draft, DatabaseDraft::create(file, kRestoreEnding));
  auto left_out = restore_into(draft.path(), OpenMode::draft, saved, context);
  if (!left_out) return told_of(file, draft.path(), std::move(left_out).error());
  A3D_TRY(draft.publish(false));
  return left_out;
}

Result<std::vector<std::string>> Session::restore_into(const std::filesystem::path& file, OpenMode mode,
                                                       const SavedText& saved, Context& context) {
  A3D_ASSIGN(store_, Store::open(file, mode, registry_));
  std::vector<std::string> left_out;
  const Status status = in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto before, store_->objects());
    A3D_TRY(empty_database());
    ListPieces pieces(saved.text(), saved.name());
    RestoreGuard guard(saved, options_.restore_reads);
    Restorer restorer(registry_, *store_, pieces, guard, context);
    A3D_TRY(restorer.database());
    A3D_TRY(guard.verdict(false, context));
    left_out = restorer.left_out();
    const bool loses_some = std::ranges::any_of(
        before, [&](const ObjectInfo& info) { return std::ranges::find(left_out, info.name) != left_out.end(); });
    if (!loses_some) return {};
    return Error{ErrorCode::not_evaluable,
                 "restore: nothing was changed, since these objects cannot be derived again, and the existing database "
                 "would lose those that it has: {}; delete it first, or restore under another name",
                 fmt::join(left_out, ", ")};
  });
  store_.reset();
  if (!status) return status.error();
  return left_out;
}

Status Session::empty_database() {
  A3D_ASSIGN(const auto objects, store_->objects());
  for (const ObjectInfo& info : objects) {
    A3D_ASSIGN(const auto present, store_->find(info.name));  // indexes go with their relation
    if (present) A3D_TRY(store_->kill(info.name));
  }
  A3D_ASSIGN(const auto types, store_->types());
  for (const NamedType& type : types) A3D_TRY(store_->remove_type(type.name));
  return {};
}

}  // namespace queries
