#include "algebra3d/operators/registry/operator_group.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/operators/registry/detail/host_name.h"

namespace algebra3d {
namespace {

// An operator may give a value for geometries at one instant, and rows for geometries over time.
[[maybe_unused]] bool is_of_kind_of(const Operator& op, const Overload& overload) {
  return (overload.kind() == OperatorKind::aggregate) == (op.kind() == OperatorKind::aggregate);
}

// Operands can change places only if both have one type.
[[maybe_unused]] bool can_be_as_symmetric_as_it_says(const Overload& overload) {
  return !overload.is_symmetric ||
         (overload.parameters.size() == 2 && overload.parameters[0].type == overload.parameters[1].type);
}

}  // namespace

void OperatorGroup::add(Operator op) {
  if (op.kind() == OperatorKind::aggregate && op.syntax.empty()) op.syntax = "_ " + op.name + "[attribute]";
  auto syntax = SyntaxPattern::parse(op.syntax);
  assert(syntax.ok() && syntax->name == op.name);
  assert(std::ranges::all_of(op.overloads, can_be_as_symmetric_as_it_says));
  assert(std::ranges::all_of(op.overloads, [&](const Overload& each) { return is_of_kind_of(op, each); }));
  std::string name = op.name;
  op.family = family_.name;
  if (op.cost == Cost::unknown) op.cost = family_.cost;
  if (op.host_name.empty()) op.host_name = snake_case(name);
  if (const auto note = notes_.find(name); note != notes_.end()) op.language_note = note->second;
  [[maybe_unused]] const bool is_new =
      operators_.emplace(std::move(name), DescribedOperator{std::move(op), std::move(syntax).value()}).second;
  assert(is_new);
}

void OperatorGroup::add_language_note(std::string_view name, std::string note) {
  if (const auto described = operators_.find(name); described != operators_.end())
    described->second.op.language_note = note;
  notes_.insert_or_assign(std::string(name), std::move(note));
}

const DescribedOperator* OperatorGroup::find(std::string_view name, const Registry& registry) {
  describe_once(registry);
  const auto found = operators_.find(name);
  return found == operators_.end() ? nullptr : &found->second;
}

void OperatorGroup::describe_once(const Registry& registry) {
  std::call_once(once_, [&] {
    registry_ = &registry;
    if (describe_ != nullptr) describe_(*this);
    assert(operators_.size() == count_);
  });
}

}  // namespace algebra3d
