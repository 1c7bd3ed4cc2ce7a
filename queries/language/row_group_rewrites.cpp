#include "queries/language/row_group_rewrites.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "queries/language/index_condition.h"
#include "queries/language/plan_views.h"

namespace queries {
namespace {

/// The value of an expression that is written as one, of type int or real.
std::optional<Value> number_in(const TypedPtr& expression) {
  if (expression == nullptr) return std::nullopt;
  const auto constant = view_as<ConstantView>(*expression);
  if (!constant || constant->value == nullptr) return std::nullopt;
  const std::string_view type = constant->value->type().name();
  return type == "int" || type == "real" ? std::optional(*constant->value) : std::nullopt;
}

/// Where the value of an attribute is, if a condition with a constant of its type holds; nothing if that is not known.
std::optional<AttributeBounds> bounds_of(const IndexCondition& condition, const TypeExpr& tuple) {
  const auto& attributes = tuple.attributes();
  const auto attribute = std::ranges::find(attributes, condition.attribute, &TypeExpr::Attribute::name);
  if (attribute == attributes.end()) return std::nullopt;
  AttributeBounds bounds{static_cast<std::size_t>(attribute - attributes.begin()), {}, {}};
  const bool is_equal = condition.use == IndexUse::equals, is_range = condition.use == IndexUse::between;
  if (is_equal || is_range || condition.use == IndexUse::at_least) bounds.low = number_in(condition.operand);
  if (is_equal || condition.use == IndexUse::at_most) bounds.high = number_in(condition.operand);
  if (is_range) bounds.high = number_in(condition.limit);
  for (std::optional<Value>* const bound : {&bounds.low, &bounds.high})
    if (*bound && !attribute->type.is((*bound)->type().name())) bound->reset();
  return bounds.low || bounds.high ? std::optional(std::move(bounds)) : std::nullopt;
}

}  // namespace

void leave_out_groups(const BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (!std::holds_alternative<SelectsElements>(bound.role)) return;
  const auto scan = call_with<ScansRelation>(*arguments[0]);
  const auto function = view_as<FunctionView>(*arguments[1]);
  if (!scan || !function) return;
  std::vector<AttributeBounds> bounds;
  for (const IndexConditions& alternatives : index_conditions(function->body))
    if (alternatives.size() == 1)
      if (auto own = bounds_of(alternatives.front(), arguments[0]->type().element())) bounds.push_back(*std::move(own));
  if (bounds.empty()) return;
  const auto& role = std::get<ScansRelation>(scan->bound.role);
  arguments[0] = with_operator(arguments[0], *scan, role.within(std::move(bounds)));
}

}  // namespace queries
