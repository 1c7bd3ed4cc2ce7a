#include "queries/session/detail/definitions.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>

#include "base/propagate.h"
#include "queries/language/nested_reader.h"
#include "queries/language/parser.h"
#include "queries/language/syntax_tree.h"

namespace queries {
namespace {

const std::string& kept_text(const ObjectInfo& info) {
  return info.function_text.empty() ? info.derived_text : info.function_text;
}

// A definition that cannot be read, because an operator is of a later version, has no known uses.
std::optional<Definition> definition_of(const ObjectInfo& info, const algebra3d::Registry& registry) {
  if (kept_text(info).empty()) return std::nullopt;
  const auto expression = kept_expression(info, registry);
  if (!expression) return std::nullopt;
  return Definition{info.name, !info.derived_text.empty(), used_names(**expression)};
}

/// A way through definitions.
struct Step {
  Definition definition;
  bool has_derived = false;  // here or before
  std::size_t before = 0;    // index of the step that leads here
};

// A call of an operator counts if there is a function of that name.
Result<std::set<std::string>> used_objects(const UsedNames& used, Store& store) {
  std::set<std::string> objects = used.objects;
  for (const std::string& name : used.calls) {
    A3D_ASSIGN(const auto info, store.find(name));
    if (info && info->type.is_function()) objects.insert(name);
  }
  return objects;
}

std::string way_text(const std::deque<Step>& steps, std::size_t last, const std::string& end) {
  std::string text = end;
  while (true) {
    text.insert(0, steps[last].definition.name + ", ");
    if (last == 0) return text;
    last = steps[last].before;
  }
}

}  // namespace

// As a nested list; databases of the first format hold it as it was typed.
Result<ExpressionPtr> kept_expression(const ObjectInfo& info, const algebra3d::Registry& registry) {
  const SourcePlace place{info.name, 1, 1};
  const std::string& text = kept_text(info);
  if (!text.starts_with("(")) return parse_expression(text, registry, place);
  A3D_ASSIGN(const NestedList list, NestedList::parse(text, place));
  return NestedReader(registry, place).expression(list);
}

Result<std::string> text_to_keep(const Expression& expression, const algebra3d::Registry& registry) {
  std::string text = to_nested(expression).print();
  A3D_ASSIGN(const NestedList list, NestedList::parse(text, expression.place));
  A3D_TRY(NestedReader(registry, expression.place).expression(list));
  return text;
}

Status check_no_circle(const Definition& definition, Store& store, const algebra3d::Registry& registry) {
  std::deque<Step> steps = {{definition, definition.is_derived, 0}};
  std::set<std::pair<std::string, bool>> seen;
  for (std::size_t at = 0; at < steps.size(); ++at) {
    A3D_ASSIGN(const std::set<std::string> used, used_objects(steps[at].definition.used, store));
    for (const std::string& name : used) {
      if (name == definition.name && steps[at].has_derived)
        return Error{ErrorCode::wrong_usage, "'{}' would be derived from itself: {}", name, way_text(steps, at, name)};
      A3D_ASSIGN(const auto info, store.find(name));
      if (!info || name == definition.name) continue;
      auto next = definition_of(*info, registry);
      if (!next) continue;
      const bool has_derived = steps[at].has_derived || next->is_derived;
      if (seen.emplace(name, has_derived).second) steps.push_back({std::move(*next), has_derived, at});
    }
  }
  return {};
}

Status check_no_circle(const std::string& name, Store& store, const algebra3d::Registry& registry) {
  A3D_ASSIGN(const auto info, store.find(name));
  const auto definition = info ? definition_of(*info, registry) : std::nullopt;
  return definition ? check_no_circle(*definition, store, registry) : Status();
}

}  // namespace queries
