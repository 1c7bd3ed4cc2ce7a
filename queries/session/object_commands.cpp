// The commands of a session that make, change, rename and remove objects and named types.
#include <algorithm>

#include "queries/language/checker.h"
#include "queries/language/parser.h"
#include "queries/session/definitions.h"
#include "queries/session/objects.h"
#include "queries/session/session.h"

namespace queries {
namespace {

bool can_be_stored(const TypeExpr& type, const algebra3d::Registry& registry) {
  if (type.is_relation() || type.is_function() || is_index(type)) return true;
  return type.arguments().empty() && registry.find_type(type.name()) != nullptr;
}

Error cannot_be_stored(std::string_view command, const TypeExpr& type) {
  const std::string_view hint = type.is_stream() ? "; end the stream with consume" : "";
  return {ErrorCode::not_evaluable, "{}: a value of type {} cannot be stored{}", command, type.text(), hint};
}

// What a function object keeps. Another one's name stands for what that one keeps, so that it may be deleted.
Result<std::string> function_text(const Expression& value, Store& store) {
  if (const auto* use = std::get_if<NameUse>(&value.node)) {
    ASSIGN_OR_RETURN(const auto named, store.find(use->name));
    if (named && !named->function_text.empty()) return named->function_text;
  }
  return to_nested(value).print();
}

std::string named_in_note(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() <= kMost ? text : fmt::format("{} and {} more", text, names.size() - kMost);
}

// The functions and derived objects that are left without something that they use.
void report_users(const Users& users, std::string_view command, Context& context) {
  if (!users.functions.empty())
    context.diagnostics.report(
        fmt::format("{}: these functions use it and fail from now on: {}", command, named_in_note(users.functions)));
  if (!users.derived.empty())
    context.diagnostics.report(fmt::format(
        "{}: these objects are derived from it; they keep their values, and `restore` will leave them out: {}", command,
        named_in_note(users.derived)));
}

Error no_object(const std::string& name) {
  return {ErrorCode::unknown_name, "there is no object '{}'", name};
}

}  // namespace

Status Session::check_new_name(const std::string& name, std::string_view what) {
  if (is_reserved(name, registry_))
    return Error{ErrorCode::reserved_name, "'{}' is {} and cannot name {}", name, why_reserved(name, registry_), what};
  return {};
}

Status Session::run(const CreateObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  RETURN_IF_ERROR(check_new_name(command.name));
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context);
    ASSIGN_OR_RETURN(const TypeExpr type, Checker(registry_, objects, context).resolve(command.type));
    if (!can_be_stored(type, registry_) || type.is_function() || is_index(type))
      return cannot_be_stored("create", type);
    return store->create(command.name, type);
  });
}

Status Session::run(const LetObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  RETURN_IF_ERROR(check_new_name(command.name));
  return in_transaction(true, [&]() -> Status {
    ASSIGN_OR_RETURN(const auto existing, store->find(command.name));
    if (!existing) return define(command.name, *command.value, false, context);
    if (!command.replaces)
      return Error{ErrorCode::name_exists, "there is an object '{}' already; delete it first, or use let_",
                   command.name};
    // The new value may come out of the old one, so it is made under another name before the old one goes.
    const std::string interim = " " + command.name;
    RETURN_IF_ERROR(define(command.name, *command.value, false, context, interim));
    RETURN_IF_ERROR(remove(command.name, false, "let_", context));
    return store->rename(interim, command.name);
  });
}

Status Session::run(const DeriveObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  RETURN_IF_ERROR(check_new_name(command.name));
  return in_transaction(true, [&]() -> Status {
    ASSIGN_OR_RETURN(const auto existing, store->find(command.name));
    if (existing)
      return Error{ErrorCode::name_exists, "there is an object '{}' already; delete it first", command.name};
    return define(command.name, *command.value, true, context);
  });
}

// Functions and derived objects keep the nested-list form of what was written: it is read back whatever notation the
// command was in.
Status Session::define(const std::string& final_name, const Expression& value, bool is_derived, Context& context,
                       const std::string& interim) {
  const std::string& name = interim.empty() ? final_name : interim;
  Objects objects(registry_, store_.get(), context);
  ASSIGN_OR_RETURN(const TypedPtr node, Checker(registry_, objects, context).check(value));
  const TypeExpr& type = node->type();
  if (!can_be_stored(type, registry_)) return cannot_be_stored(is_derived ? "derive" : "let", type);
  if (is_derived || type.is_function())
    RETURN_IF_ERROR(
        check_no_circle({final_name, is_derived && !type.is_function(), used_names(value)}, *store_, registry_));
  if (type.is_function()) {
    ASSIGN_OR_RETURN(const std::string text, function_text(value, *store_));
    return store_->create_function(name, type, text);
  }
  ASSIGN_OR_RETURN(const Datum datum, node->evaluate(nullptr, context));
  if (is_derived && store_->has_written())
    return Error{
        ErrorCode::wrong_usage,
        "derive: the expression changes a relation, which it would do again whenever it is evaluated; use let"};
  RETURN_IF_ERROR(is_derived ? store_->create_derived(name, type, to_nested(value).print())
                             : store_->create(name, type));
  return store_->assign(name, datum, context);
}

Status Session::run(const UpdateObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context);
    ASSIGN_OR_RETURN(const auto existing, store->find(command.name));
    if (!existing)
      return Error{ErrorCode::unknown_name, "there is no object '{}'; use let to create one", command.name};
    if (!existing->derived_text.empty())
      return Error{ErrorCode::wrong_usage,
                   "update: '{}' is derived from other objects; delete it and use let for a value of its own",
                   command.name};
    ASSIGN_OR_RETURN(const TypedPtr node, Checker(registry_, objects, context).check(*command.value));
    if (!(node->type() == existing->type))
      return Error{ErrorCode::type_error, "update: '{}' is of type {}, the new value of type {}", command.name,
                   existing->type.text(), node->type().text()};
    if (existing->type.is_function()) {
      RETURN_IF_ERROR(check_no_circle({command.name, false, used_names(*command.value)}, *store, registry_));
      ASSIGN_OR_RETURN(const std::string text, function_text(*command.value, *store));
      RETURN_IF_ERROR(store->remove(command.name));
      return store->create_function(command.name, existing->type, text);
    }
    ASSIGN_OR_RETURN(const Datum value, node->evaluate(nullptr, context));
    return store->assign(command.name, value, context);
  });
}

// Indexes go with their relation; functions and derived objects stay, and those that are left without something that
// they use are named. A replaced object is still there for them.
Status Session::remove(const std::string& name, bool kills, std::string_view command, Context& context) {
  ASSIGN_OR_RETURN(const auto before, store_->objects());
  RETURN_IF_ERROR(kills ? store_->kill(name) : store_->remove(name));
  std::set<std::string> gone;
  for (const ObjectInfo& info : before) {
    ASSIGN_OR_RETURN(const auto found, store_->find(info.name));
    if (!found && info.name != name) gone.insert(info.name);
  }
  if (!gone.empty())
    context.diagnostics.report(
        fmt::format("{}: its indexes are deleted, too: {}", command, named_in_note({gone.begin(), gone.end()})));
  if (command != "let_") gone.insert(name);
  ASSIGN_OR_RETURN(const Users users, users_of_objects(gone, *store_, registry_));
  report_users(users, command, context);
  return {};
}

Status Session::run(const DeleteObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    ASSIGN_OR_RETURN(const auto existing, store->find(command.name));
    if (!existing) return no_object(command.name);
    return remove(command.name, command.kills, command.kills ? "kill" : "delete", context);
  });
}

Status Session::run(const RenameObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  RETURN_IF_ERROR(check_new_name(command.new_name));
  return in_transaction(true, [&]() -> Status {
    ASSIGN_OR_RETURN(const auto existing, store->find(command.old_name));
    if (!existing) return no_object(command.old_name);
    RETURN_IF_ERROR(store->rename(command.old_name, command.new_name));
    RETURN_IF_ERROR(check_no_circle(command.new_name, *store, registry_));
    ASSIGN_OR_RETURN(const Users users, users_of_objects({command.old_name}, *store, registry_));
    report_users(users, "changename", context);
    return {};
  });
}

Status Session::run(const DefineType& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  RETURN_IF_ERROR(check_new_name(command.name, "a type"));
  if (registry_.find_type(command.name) != nullptr)
    return Error{ErrorCode::name_exists, "there is a type '{}' already", command.name};
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context);
    ASSIGN_OR_RETURN(const TypeExpr type, Checker(registry_, objects, context).resolve(command.type));
    return store->create_type(command.name, type);
  });
}

// Objects keep the type that the name stood for; only what is written down keeps the name.
Status Session::run(const DeleteType& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    RETURN_IF_ERROR(store->remove_type(command.name));
    ASSIGN_OR_RETURN(const Users users, users_of_type(command.name, *store, registry_));
    report_users(users, "delete type", context);
    return {};
  });
}

}  // namespace queries
