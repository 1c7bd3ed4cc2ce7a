#include "queries/session/detail/objects.h"

#include <algorithm>

#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/syntax_tree.h"
#include "queries/session/detail/definitions.h"
#include "queries/session/detail/effects.h"

namespace queries {
namespace {

constexpr std::size_t kMaxFunctionsInMaking = 100;

Error nothing_named(std::string_view what, const std::string& name, const std::vector<std::string>& candidates,
                    std::string_view advice) {
  const std::string nearest = algebra3d::nearest_name(name, candidates);
  return {ErrorCode::unknown_name,
          "there is no {} '{}'{}{}",
          what,
          name,
          nearest.empty() ? "" : ", did you mean '" + nearest + "'?",
          nearest.empty() ? advice : ""};
}

}  // namespace

Error no_object(const std::string& name, Store& store, std::string_view advice) {
  std::vector<std::string> names;
  if (const auto objects = store.objects())  // only the hint comes from here
    for (const ObjectInfo& info : *objects) names.push_back(info.name);
  return nothing_named("object", name, names, advice);
}

Error no_type(const std::string& name, Store& store) {
  std::vector<std::string> names;
  if (const auto types = store.types())
    for (const NamedType& type : *types) names.push_back(type.name);
  return nothing_named("type", name, names, {});
}

Result<std::optional<TypeExpr>> Session::Objects::type_of(const std::string& name) {
  if (store_ == nullptr) return std::optional<TypeExpr>();
  A3D_ASSIGN(const auto info, store_->find(name));
  return info ? std::optional(info->type) : std::nullopt;
}

Result<std::optional<TypeExpr>> Session::Objects::named_type(const std::string& name) {
  if (store_ == nullptr) return std::optional<TypeExpr>();
  return store_->find_type(name);
}

Result<Datum> Session::Objects::value_of(const std::string& name) {
  if (const auto known = values_.find(name); known != values_.end()) return known->second;
  A3D_ASSIGN(const auto info, store_->find(name));
  if (!info) return Error{ErrorCode::unknown_name, "unknown object '{}'", name};
  A3D_ASSIGN(Datum value, info->type.is_function() ? function_of(*info) : store_->read(name));
  return values_.emplace(name, std::move(value)).first->second;
}

Result<std::vector<ObjectSource::IndexName>> Session::Objects::indexes_of(const std::string& relation) {
  std::vector<IndexName> indexes;
  if (store_ == nullptr) return indexes;
  A3D_ASSIGN(const auto objects, store_->objects());
  for (const ObjectInfo& info : objects)
    if (info.index_relation == relation) indexes.push_back({info.name, info.index_attribute, info.type});
  return indexes;
}

// A function may be defined by others, `let g = [f]`, and after an update even by itself. Its body does not count: it
// is checked when the function is called.
Result<Datum> Session::Objects::function_of(const ObjectInfo& info) {
  if (std::ranges::find(functions_in_making_, info.name) != functions_in_making_.end())
    return Error{ErrorCode::not_evaluable, "the function '{}' is defined by itself", info.name};
  if (functions_in_making_.size() == kMaxFunctionsInMaking)
    return Error{ErrorCode::limit_exceeded, "more than {} functions are defined by each other", kMaxFunctionsInMaking};
  functions_in_making_.push_back(info.name);
  Result<Datum> function = checked_function(info);
  functions_in_making_.pop_back();
  return function;
}

Result<Datum> Session::Objects::checked_function(const ObjectInfo& info) {
  A3D_ASSIGN(const ExpressionPtr expression, kept_expression(info, registry_));
  A3D_TRY(check_operator_name(info.name, *expression, *store_, registry_));
  A3D_ASSIGN(const TypedPtr function, Checker(registry_, *this, context_).check(*expression));
  if (!(function->type() == info.type))
    return Error{ErrorCode::type_error, "{}: the function was {} when it was defined and is {} now", info.name,
                 info.type.text(), function->type().text()};
  return function->evaluate(nullptr, context_);
}

std::vector<std::string> Session::Objects::names() {
  std::vector<std::string> names;
  if (store_ == nullptr) return names;
  auto objects = store_->objects();
  if (!objects) return names;  // only suggestions come from here
  for (const ObjectInfo& info : *objects) names.push_back(info.name);
  return names;
}

}  // namespace queries
