// The changes that expressions make when they are evaluated, found without evaluating them. The checker cannot be used:
// it evaluates names of files, and looks into a function only when that is called.
#include "queries/session/detail/effects.h"

#include <deque>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/used_names.h"
#include "queries/session/detail/definitions.h"

namespace queries {
namespace {

struct Reached {
  UsedNames used;
  std::vector<std::string> functions;
};

const algebra3d::Operator* changing_operator(const UsedNames& used, const algebra3d::Registry& registry) {
  for (const std::string& name : used.operators) {
    const algebra3d::Operator* const op = registry.find_operator(name);
    if (op != nullptr && (op->writes_files || op->changes_relations)) return op;
  }
  return nullptr;
}

/// The names in an expression that may be those of functions.
std::set<std::string> possible_functions(const UsedNames& used) {
  std::set<std::string> names = used.objects;
  names.insert(used.calls.begin(), used.calls.end());
  return names;
}

}  // namespace

std::string Change::text() const {
  const std::string_view what = op->writes_files ? "writes a file" : "changes a relation";
  if (functions.empty()) return fmt::format("{} ({})", what, op->name);
  return fmt::format("{} ({}, by the function{} {})", what, op->name, functions.size() == 1 ? "" : "s",
                     fmt::join(functions, ", "));
}

Result<std::optional<Change>> find_change(const Expression& expression, Store& store,
                                          const algebra3d::Registry& registry) {
  std::deque<Reached> waiting = {{used_names(expression), {}}};
  std::set<std::string> seen;
  for (; !waiting.empty(); waiting.pop_front()) {
    const Reached& reached = waiting.front();
    if (const auto* op = changing_operator(reached.used, registry))
      return std::optional(Change{.op = op, .functions = reached.functions});
    for (const std::string& name : possible_functions(reached.used)) {
      if (!seen.insert(name).second) continue;
      A3D_ASSIGN(const auto info, store.find(name));
      if (!info || !info->type.is_function()) continue;
      const auto body = kept_expression(*info, registry);
      if (!body) continue;
      std::vector<std::string> functions = reached.functions;
      functions.push_back(name);
      waiting.push_back({used_names(**body), std::move(functions)});
    }
  }
  return std::optional<Change>();
}

Status check_operator_name(const std::string& name, const Expression& function, Store& store,
                           const algebra3d::Registry& registry) {
  if (registry.find_operator(name) == nullptr) return {};
  A3D_ASSIGN(const auto change, find_change(function, store, registry));
  if (!change) return {};
  return Error{
      ErrorCode::wrong_usage,
      "the function '{}' has the name of an operator and {}, which callers of the operator do not expect; give it "
      "another name",
      name, change->text()};
}

}  // namespace queries
