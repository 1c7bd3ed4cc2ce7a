// The commands of a session that make, change, rename and remove objects and named types.
#include <fmt/format.h>

#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/parser.h"
#include "queries/language/syntax_tree.h"
#include "queries/session/detail/definitions.h"
#include "queries/session/detail/effects.h"
#include "queries/session/detail/objects.h"
#include "queries/session/session.h"

namespace queries {
namespace {

bool can_be_stored(const TypeExpr& type, const algebra3d::Registry& registry) {
  if (type.is_relation() || type.is_function() || is_index(type)) return true;
  return registry.value_type(type) != nullptr;
}

Error cannot_be_stored(std::string_view command, const TypeExpr& type) {
  const std::string_view hint = type.is_stream() ? "; end the stream with consume" : "";
  return {ErrorCode::not_evaluable, "{}: a value of type {} cannot be stored{}", command, type.text(), hint};
}

// The text that a function object keeps. The name of another function object stands for that object's text, so that it
// may be deleted.
Result<std::string> function_text(const Expression& value, Store& store, const algebra3d::Registry& registry) {
  if (const auto* use = std::get_if<NameUse>(&value.node)) {
    A3D_ASSIGN(const auto named, store.find(use->name));
    if (named && !named->function_text.empty()) return named->function_text;
  }
  return text_to_keep(value, registry);
}

// All of them: a name that is left out here could be lost without a word.
std::string named_in_note(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

Status check_derivable(const Expression& value, Store& store, const algebra3d::Registry& registry) {
  A3D_ASSIGN(const auto change, find_change(value, store, registry));
  if (!change) return {};
  return Error{ErrorCode::wrong_usage,
               "derive: the expression {}, which it would do again whenever it is evaluated; use let", change->text()};
}

/// The expression that is evaluated for an object that is to be stored: of `consume` its stream, which the store takes
/// in columns if it has them.
TypedPtr stored_part(const TypedPtr& node, bool rewrites_plans) {
  const NodeView view = node->view();
  const auto* const call = std::get_if<StreamCallView>(&view);
  const bool collects = call != nullptr && std::holds_alternative<CollectsTuples>(call->bound.role);
  return collects && rewrites_plans ? call->arguments[0] : node;
}

/// The status of a command that gives a name, with the position of the name if that exists already.
Status at_name(Status status, const SourcePlace& place) {
  if (!status && status.error().code == ErrorCode::name_exists) return std::move(status).error().at(place);
  return status;
}

// A new function whose name an operator has, if it is not null.
void report_operator(const algebra3d::Operator* op, std::string_view command, Context& context) {
  if (op == nullptr) return;
  context.diagnostics.report(
      fmt::format("{0}: '{1}' is an operator, too; {1}(...) is from now on a call of the function wherever its "
                  "parameters take the arguments",
                  command, op->name));
}

}  // namespace

Status Session::check_new_name(const std::string& name, const SourcePlace& place, std::string_view what) {
  if (is_reserved(name))
    return Error(ErrorCode::reserved_name, "'{}' is a word of the language and cannot name {}", name, what).at(place);
  return {};
}

Status Session::run(const CreateObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(check_new_name(command.name, command.name_place));
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context, options_.rewrites_plans);
    A3D_ASSIGN(const TypeExpr type, Checker(registry_, objects, context).resolve(command.type));
    if (!can_be_stored(type, registry_) || type.is_function() || is_index(type))
      return cannot_be_stored("create", type);
    return at_name(store->create(command.name, type), command.name_place);
  });
}

Status Session::run(const LetObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(check_new_name(command.name, command.name_place));
  return in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto existing, store->find(command.name));
    if (!existing) return define(command.name, *command.value, false, context);
    if (!command.replaces)
      return Error(ErrorCode::name_exists, "there is an object '{}' already; delete it first, or use let_",
                   command.name)
          .at(command.name_place);
    // The new value may come out of the old one, so it is made under another name before the old one goes.
    const std::string interim = " " + command.name;
    return change_definitions("let_", context, [&]() -> Status {
      A3D_TRY(define(command.name, *command.value, false, context, interim));
      A3D_TRY(remove(command.name, false, "let_", context));
      return store->rename(interim, command.name);
    });
  });
}

Status Session::run(const DeriveObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(check_new_name(command.name, command.name_place));
  return in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto existing, store->find(command.name));
    if (existing)
      return Error(ErrorCode::name_exists, "there is an object '{}' already; delete it first", command.name)
          .at(command.name_place);
    return define(command.name, *command.value, true, context);
  });
}

// A name of a file is evaluated by the checker, which refuses one that would write something in other words.
Result<TypedPtr> Session::checked_definition(const Expression& value, bool is_derived, Objects& objects,
                                             Context& context) {
  auto node = Checker(registry_, objects, context).check_result(value);
  if (!node && is_derived) A3D_TRY(check_derivable(value, *store_, registry_));
  return node;
}

// Functions and derived objects keep the nested-list form of their text: it is read back whatever notation the command
// was in.
Status Session::define(const std::string& final_name, const Expression& value, bool is_derived, Context& context,
                       const std::string& interim) {
  const std::string& name = interim.empty() ? final_name : interim;
  Context own = context;
  if (is_derived) own.unchanging = "a derived object is evaluated again whenever it is restored";
  Objects objects(registry_, store_.get(), own, options_.rewrites_plans);
  const auto node = checked_definition(value, is_derived, objects, own);
  if (!node) return node.error();
  const TypeExpr& type = (*node)->type();
  if (!can_be_stored(type, registry_)) return cannot_be_stored(is_derived ? "derive" : "let", type);
  if (is_derived || type.is_function())
    A3D_TRY(check_no_circle({final_name, is_derived && !type.is_function(), used_names(value)}, *store_, registry_));
  if (type.is_function()) {
    A3D_TRY(check_operator_name(final_name, value, *store_, registry_));
    report_operator(registry_.find_operator(final_name), is_derived ? "derive" : "let", context);
    A3D_ASSIGN(const std::string text, function_text(value, *store_, registry_));
    return store_->create_function(name, type, text);
  }
  std::string kept_text;
  if (is_derived) {
    A3D_TRY(check_derivable(value, *store_, registry_));
    A3D_ASSIGN(kept_text, text_to_keep(value, registry_));
  }
  const OwnResult result(context);
  A3D_ASSIGN(const Datum datum, stored_part(*node, options_.rewrites_plans)->evaluate(nullptr, own));
  judge(result, datum);
  A3D_TRY(is_derived ? store_->create_derived(name, type, kept_text) : store_->create(name, type));
  return store_->assign(name, datum, own);
}

Status Session::run(const UpdateObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context, options_.rewrites_plans);
    A3D_ASSIGN(const auto existing, store->find(command.name));
    if (!existing) return no_object(command.name, *store, "; use let to create one");
    if (!existing->derived_text.empty())
      return Error{ErrorCode::wrong_usage,
                   "update: '{}' is derived from other objects; delete it and use let for a value of its own",
                   command.name};
    A3D_ASSIGN(TypedPtr node, Checker(registry_, objects, context).check_result(*command.value));
    if (const bool are_characters = existing->type.is("string") || existing->type.is("text");
        are_characters && algebra3d::conversion_cost(node->type(), existing->type.name()))
      node = make_conversion(std::move(node), *registry_.find_type(existing->type.name()));
    if (!(node->type() == existing->type))
      return Error{ErrorCode::type_error, "update: '{}' is of type {}, the new value of type {}", command.name,
                   existing->type.text(), node->type().text()};
    if (existing->type.is_function()) {
      A3D_TRY(check_no_circle({command.name, false, used_names(*command.value)}, *store, registry_));
      A3D_TRY(check_operator_name(command.name, *command.value, *store, registry_));
      A3D_ASSIGN(const std::string text, function_text(*command.value, *store, registry_));
      A3D_TRY(store->remove(command.name));
      return store->create_function(command.name, existing->type, text);
    }
    const OwnResult result(context);
    A3D_ASSIGN(const Datum value, stored_part(node, options_.rewrites_plans)->evaluate(nullptr, context));
    judge(result, value);
    return store->assign(command.name, value, context);
  });
}

// Indexes go with their relation.
Status Session::remove(const std::string& name, bool kills, std::string_view command, Context& context) {
  A3D_ASSIGN(const auto before, store_->objects());
  A3D_TRY(kills ? store_->kill(name) : store_->remove(name));
  std::vector<std::string> gone;
  for (const ObjectInfo& info : before) {
    A3D_ASSIGN(const auto found, store_->find(info.name));
    if (!found && info.name != name) gone.push_back(info.name);
  }
  if (!gone.empty())
    context.diagnostics.report(fmt::format("{}: its indexes are deleted, too: {}", command, named_in_note(gone)));
  return {};
}

// Functions and derived objects stay when something that they need goes.
Status Session::change_definitions(std::string_view command, Context& context, const std::function<Status()>& change) {
  A3D_ASSIGN(const auto objects, store_->objects());
  A3D_ASSIGN(const UnusableDefinitions before, unusable_definitions(context));
  A3D_TRY(change());
  GoneNames gone;
  for (const ObjectInfo& info : objects) {
    A3D_ASSIGN(const auto found, store_->find(info.name));
    if (found) continue;
    gone.all.insert(info.name);
    if (info.type.is_function()) gone.functions.insert(info.name);
  }
  A3D_ASSIGN(const UnusableDefinitions now, unusable_definitions(context, gone));
  const UnusableDefinitions newly = newly_unusable(before, now);
  if (!newly.functions.empty())
    context.diagnostics.show(
        fmt::format("{}: these functions use it and fail from now on: {}", command, named_in_note(newly.functions)));
  if (!newly.underivable.empty())
    context.diagnostics.show(fmt::format(
        "{}: these objects are derived from it; they keep their values, and `restore` will leave them out: {}", command,
        named_in_note(newly.underivable_names())));
  return {};
}

Status Session::run(const DeleteObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto existing, store->find(command.name));
    if (!existing) return no_object(command.name, *store);
    const std::string_view verb = command.kills ? "kill" : "delete";
    return change_definitions(verb, context, [&] { return remove(command.name, command.kills, verb, context); });
  });
}

Status Session::run(const RenameObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(check_new_name(command.new_name, command.new_name_place));
  return in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto existing, store->find(command.old_name));
    if (!existing) return no_object(command.old_name, *store);
    return change_definitions("changename", context, [&]() -> Status {
      A3D_TRY(at_name(store->rename(command.old_name, command.new_name), command.new_name_place));
      return check_no_circle(command.new_name, *store, registry_);
    });
  });
}

Status Session::run(const DefineType& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_TRY(check_new_name(command.name, command.name_place, "a type"));
  if (registry_.find_type(command.name) != nullptr || command.name == "longint")
    return Error(ErrorCode::name_exists, "there is a type '{}' already", command.name).at(command.name_place);
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context, options_.rewrites_plans);
    A3D_ASSIGN(const TypeExpr type, Checker(registry_, objects, context).resolve(command.type));
    return at_name(store->create_type(command.name, type), command.name_place);
  });
}

// Objects keep the type that the name stood for; only what is written down keeps the name.
Status Session::run(const DeleteType& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    A3D_ASSIGN(const auto existing, store->find_type(command.name));
    if (!existing) return no_type(command.name, *store);
    return change_definitions("delete type", context, [&] { return store->remove_type(command.name); });
  });
}

}  // namespace queries
