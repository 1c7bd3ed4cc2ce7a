// Which functions fail, and which derived objects could not be derived again, as the database is now. A definition is
// checked as if all that is unusable itself were not there, until no more are found.
#include "queries/session/detail/unusable.h"

#include <algorithm>
#include <set>

#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/syntax_tree.h"
#include "queries/session/detail/definitions.h"
#include "queries/session/detail/effects.h"
#include "queries/session/detail/objects.h"

namespace queries {
namespace {

/// Objects without some of them.
class Without final : public ObjectSource {
 public:
  Without(ObjectSource& objects, const std::set<std::string>& hidden) : objects_(objects), hidden_(hidden) {}

  Result<std::optional<TypeExpr>> type_of(const std::string& name) override {
    return hidden_.contains(name) ? Result<std::optional<TypeExpr>>(std::nullopt) : objects_.type_of(name);
  }
  Result<Datum> value_of(const std::string& name) override { return objects_.value_of(name); }
  Result<std::optional<TypeExpr>> named_type(const std::string& name) override { return objects_.named_type(name); }
  std::vector<std::string> names() override { return {}; }

 private:
  ObjectSource& objects_;
  const std::set<std::string>& hidden_;
};

}  // namespace

/// Looks through the definitions of a database. Lives for one statement.
class Session::UnusableSearch {
 public:
  UnusableSearch(const algebra3d::Registry& registry, Store& store, const GoneNames& gone, Context& context)
      : registry_(registry), store_(store), gone_(gone), context_(context), objects_(registry, &store, context) {}

  Result<UnusableDefinitions> run() {
    A3D_ASSIGN(infos_, store_.objects());
    const auto is_function = [](const ObjectInfo& info) { return info.type.is_function(); };
    A3D_TRY(
        hide_all(is_function, [&](const ObjectInfo& info, const Error&) { result_.functions.push_back(info.name); }));
    for (const ObjectInfo& info : infos_)
      if (!info.has_value) hidden_.insert(info.name);
    // Functions that use what is left out are in the way of others, and not left out themselves.
    A3D_TRY(hide_all([](const ObjectInfo&) { return true; },
                     [&](const ObjectInfo& info, const Error& reason) {
                       if (!is_function(info)) result_.underivable.push_back({info.name, reason.text()});
                     }));
    std::ranges::sort(result_.functions);
    std::ranges::sort(result_.underivable, {}, &Underivable::name);
    return std::move(result_);
  }

 private:
  template <typename Kind, typename Found>
  Status hide_all(Kind is_meant, Found found) {
    for (bool is_new = true; is_new;) {
      is_new = false;
      for (const ObjectInfo& info : infos_) {
        if (hidden_.contains(info.name) || !is_meant(info)) continue;
        A3D_TRY(context_.check_cancelled());
        const Status status = check(info);
        if (status) continue;
        hidden_.insert(info.name);
        found(info, status.error());
        is_new = true;
      }
    }
    return {};
  }

  Status check(const ObjectInfo& info) {
    if (!info.index_relation.empty() && hidden_.contains(info.index_relation))
      return Error{ErrorCode::unknown_name, "unknown name '{}'", info.index_relation};
    if (info.function_text.empty() && info.derived_text.empty()) return {};
    A3D_ASSIGN(const ExpressionPtr expression, kept_expression(info, registry_));
    A3D_TRY(check_names(used_names(*expression)));
    A3D_TRY(check_changes(info, *expression));
    Without objects(objects_, hidden_);
    A3D_ASSIGN(const TypedPtr node, Checker(registry_, objects, context_).check(*expression));
    if (info.type.is_function() && !(node->type() == info.type))
      return Error{ErrorCode::type_error, "the function was {} when it was defined and is {} now", info.type.text(),
                   node->type().text()};
    return {};
  }

  // Objects whose expression would change something are left out by `restore`; a function fails where it is called.
  Status check_changes(const ObjectInfo& info, const Expression& expression) {
    if (info.type.is_function()) return check_operator_name(info.name, expression, store_, registry_);
    A3D_ASSIGN(const auto change, find_change(expression, store_, registry_));
    if (!change) return {};
    return Error{ErrorCode::wrong_usage, "its expression {}", change->text()};
  }

  // A call of a function that is gone may be one of an operator now, and mean something else.
  Status check_names(const UsedNames& used) const {
    for (const std::string& name : used.objects)
      if (gone_.all.contains(name)) return Error{ErrorCode::unknown_name, "unknown name '{}'", name};
    for (const std::string& name : used.calls)
      if (gone_.functions.contains(name)) return Error{ErrorCode::unknown_name, "unknown function '{}'", name};
    return {};
  }

  const algebra3d::Registry& registry_;
  Store& store_;
  const GoneNames& gone_;
  Context& context_;  // its diagnostics are dropped
  Objects objects_;
  std::vector<ObjectInfo> infos_;
  std::set<std::string> hidden_;
  UnusableDefinitions result_;
};

Result<UnusableDefinitions> Session::unusable_definitions(Context& context, const GoneNames& gone) {
  algebra3d::Diagnostics unheard;
  Context quiet = context.with(unheard);
  quiet.unchanging = "definitions are only checked";
  return UnusableSearch(registry_, *store_, gone, quiet).run();
}

std::vector<std::string> UnusableDefinitions::underivable_names() const {
  std::vector<std::string> names;
  for (const Underivable& each : underivable) names.push_back(each.name);
  return names;
}

UnusableDefinitions newly_unusable(const UnusableDefinitions& before, const UnusableDefinitions& now) {
  UnusableDefinitions result;
  for (const std::string& name : now.functions)
    if (std::ranges::find(before.functions, name) == before.functions.end()) result.functions.push_back(name);
  const std::vector<std::string> known = before.underivable_names();
  for (const Underivable& each : now.underivable)
    if (std::ranges::find(known, each.name) == known.end()) result.underivable.push_back(each);
  return result;
}

}  // namespace queries
