#include "algebra3d/operators/registry/registry.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <optional>

#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/detail/guarded.h"
#include "algebra3d/operators/registry/detail/made_overloads.h"
#include "algebra3d/operators/registry/failed_calls.h"
#include "algebra3d/values/types/nested_relation.h"
#include "base/diagnostics.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

// Cost of the conversion to a parameter. Nested relations are never converted.
std::optional<std::size_t> cost_of(const TypeExpr& argument, const Type& type) {
  if (argument.is_nested_relation()) return argument == type.term() ? std::optional(std::size_t{0}) : std::nullopt;
  return conversion_cost(argument, type.name());
}

// Cost of the conversions that make `arguments` fit, or nothing if they do not.
std::optional<std::size_t> cost_of(const Overload& overload, std::span<const TypeExpr> arguments) {
  if (overload.parameters.size() != arguments.size()) return std::nullopt;
  std::size_t sum = 0;
  for (std::size_t place = 0; place < arguments.size(); ++place) {
    const auto cost = cost_of(arguments[place], *overload.parameters[place].type);
    if (!cost) return std::nullopt;
    sum += *cost;
  }
  return sum;
}

// Maximum number of argument lists in a message.
constexpr std::size_t kToldLists = 8;

// The number of arguments that the overload would take, 0 if it takes another number of arguments.
std::size_t fitting_arguments(const Overload& overload, std::span<const TypeExpr> arguments) {
  if (overload.parameters.size() != arguments.size()) return 0;
  std::size_t count = 0;
  for (std::size_t place = 0; place < arguments.size(); ++place)
    if (conversion_cost(arguments[place], overload.parameters[place].type->name())) ++count;
  return count;
}

// The argument lists of all overloads. If they are too many to be listed, those come first that the arguments fit best.
std::vector<std::string> expected_arguments(const Operator& op, std::span<const TypeExpr> arguments) {
  std::vector<const Overload*> overloads;
  for (const Overload& overload : op.overloads) overloads.push_back(&overload);
  if (overloads.size() > kToldLists)
    std::ranges::stable_sort(overloads, std::greater(),
                             [&](const Overload* overload) { return fitting_arguments(*overload, arguments); });
  std::vector<std::string> lists;
  for (const Overload* overload : overloads) {
    std::vector<TypeExpr> types;
    for (const Parameter& parameter : overload->parameters) types.emplace_back(parameter.type->name());
    std::string list = argument_list_text(types);
    if (std::ranges::find(lists, list) == lists.end()) lists.push_back(std::move(list));
  }
  return lists;
}

// Of an aggregate: the types of which it takes values.
std::vector<std::string> parameter_types(const Operator& op) {
  std::vector<std::string> names;
  for (const Overload& overload : op.overloads) names.emplace_back(overload.parameters.front().type->name());
  return names;
}

// Converts the arguments to the types that the overload takes. False if an undefined one decides the result.
bool prepare(const Overload& overload, std::span<Value> arguments) {
  for (std::size_t place = 0; place < arguments.size(); ++place) {
    Value& argument = arguments[place];
    const Parameter& parameter = overload.parameters[place];
    if (!argument.is_defined() && !parameter.accepts_undefined) return false;
    if (&argument.type() == parameter.type) continue;
    argument = converted(argument, *parameter.type);
  }
  return true;
}

/// A table without rows.
RowSourcePtr no_rows() {
  class None final : public RowSource {
   public:
    Result<std::optional<Row>> next(Context& /*context*/) override { return std::optional<Row>(); }
  };
  return std::make_unique<None>();
}

/// The rows of a call, with its arguments at hand for when a row cannot be made.
class RepeatableRows final : public RowSource {
 public:
  RepeatableRows(RowSourcePtr rows, const ResolvedCall& call, std::span<const Value> arguments)
      : rows_(std::move(rows)), call_(call), arguments_(arguments.begin(), arguments.end()) {}
  Result<std::optional<Row>> next(Context& context) override {
    auto row = guarded(*call_.op, [&] {
      poll_interruption();
      return rows_->next(context);
    });
    if (!row) note_failed_call(call_, arguments_, row.error(), context);
    return row;
  }

 private:
  RowSourcePtr rows_;
  ResolvedCall call_;
  std::vector<Value> arguments_;
};

char lower_case(char c) {
  return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::size_t double_letter_distance(char a, char b) {
  return a == b ? 0 : lower_case(a) == lower_case(b) ? 1 : 2;
}

// Whether the letters in front of the ends `i` and `j` are the same two the other way round.
bool are_swapped(std::string_view a, std::size_t i, std::string_view b, std::size_t j) {
  return i > 1 && j > 1 && lower_case(a[i - 1]) == lower_case(b[j - 2]) &&
         lower_case(a[i - 2]) == lower_case(b[j - 1]) && lower_case(a[i - 1]) != lower_case(a[i - 2]);
}

// Twice the edit distance, in which letters that differ only in case count half, and two neighbours that are swapped
// count as one edit.
std::size_t double_edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);  // the row of i - 2
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = 2 * j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = 2 * i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = last[j - 1] + double_letter_distance(a[i - 1], b[j - 1]);
      row[j] = std::min({last[j] + 2, row[j - 1] + 2, substituted});
      if (are_swapped(a, i, b, j)) row[j] = std::min(row[j], before[j - 2] + 2);
    }
  }
  return row.back();
}

}  // namespace

void report_undefined(const ResolvedCall& call, const Undefined& undefined, Context& context) {
  using About = Diagnostics::About;
  context.diagnostics.report(call.op->name + ": " + undefined.reason, {},
                             call.op->reads_files_in(*call.overload) ? About::unreadable : About::undefined);
}

Registry::Registry() : made_overloads_(std::make_shared<detail::MadeOverloads>()) {}

void Registry::add(const Type& type) {
  assert(find_type(type.name()) == nullptr);
  types_.push_back(&type);
}

void Registry::note_family() {
  if (!family_.name.empty() && std::ranges::find(families_, family_.name, &Family::name) == families_.end())
    families_.push_back(family_);
}

void Registry::add(Operator op) {
  note_family();
  OperatorGroup& group = *groups_.emplace_back(std::make_unique<OperatorGroup>(family_));
  const std::string name = op.name;
  group.add(std::move(op));
  [[maybe_unused]] const bool is_new = group_of_.emplace(group.find(name, *this)->op.name, &group).second;
  assert(is_new);
}

void Registry::add(std::string_view names, Describe describe) {
  note_family();
  const auto count = static_cast<std::size_t>(std::ranges::count(names, ' ')) + 1;
  OperatorGroup& group = *groups_.emplace_back(std::make_unique<OperatorGroup>(family_, count, describe));
  for (std::size_t each = 0; each < count; ++each) {
    const std::string_view name = names.substr(0, names.find(' '));
    [[maybe_unused]] const bool is_new = group_of_.emplace(name, &group).second;
    assert(is_new);
    names.remove_prefix(std::min(names.size(), name.size() + 1));
  }
}

void Registry::add_language_note(std::string_view name, std::string note) {
  const auto group = group_of_.find(name);
  assert(group != group_of_.end());
  group->second->add_language_note(name, std::move(note));
}

const DescribedOperator* Registry::find(std::string_view name) const {
  const auto group = group_of_.find(name);
  if (group == group_of_.end()) return nullptr;
  const DescribedOperator* const found = group->second->find(name, *this);
  assert(found != nullptr);
  return found;
}

const Type* Registry::find_type(std::string_view name) const {
  const auto found = std::ranges::find(types_, name, [](const Type* type) { return type->name(); });
  return found == types_.end() ? nullptr : *found;
}

const Type* Registry::value_type(const TypeExpr& term) const {
  if (term.is_nested_relation()) return algebra3d::value_type(term);
  return term.arguments().empty() ? find_type(term.name()) : nullptr;
}

const Operator* Registry::find_operator(std::string_view name) const {
  const DescribedOperator* const found = find(name);
  return found == nullptr ? nullptr : &found->op;
}

const SyntaxPattern& Registry::syntax(const Operator& op) const {
  return find(op.name)->syntax;
}

std::vector<const Operator*> Registry::operators() const {
  std::vector<const Operator*> all;
  for (const auto& [name, group] : group_of_) all.push_back(find_operator(name));
  return all;
}

std::vector<const Operator*> Registry::operators_of(std::string_view family) const {
  std::vector<const Operator*> members;
  for (const auto& [name, group] : group_of_)
    if (group->family().name == family) members.push_back(find_operator(name));
  return members;
}

Result<ResolvedCall> Registry::resolve(const Operator& op, std::span<const TypeExpr> arguments) const {
  const Overload* best = nullptr;
  std::size_t cheapest = 0;
  for (const Overload& overload : op.overloads) {
    const auto cost = cost_of(overload, arguments);
    if (!cost || (best != nullptr && *cost >= cheapest)) continue;
    best = &overload;
    cheapest = *cost;
  }
  for (const TypeExpr& argument : arguments) {
    const Overload* const made = overload_for(op, argument);
    if (best == nullptr && made != nullptr && cost_of(*made, arguments)) best = made;
  }
  if (best == nullptr && op.kind() == OperatorKind::aggregate)
    return Error{ErrorCode::type_error, "{}: expected values of type {}, got {}", op.name,
                 enumerate(parameter_types(op)), arguments.front().text()};
  if (best == nullptr)
    return Error{ErrorCode::type_error, "{}: expected {}, got {}", op.name,
                 enumerate(expected_arguments(op, arguments), kToldLists), argument_list_text(arguments)};
  return ResolvedCall{&op, best};
}

const Overload* Registry::overload_for(const Operator& op, const TypeExpr& term) const {
  if (op.overload_for == nullptr || !term.is_nested_relation()) return nullptr;
  const Type* const type = algebra3d::value_type(term);
  return type == nullptr ? nullptr : &made_overloads_->find(op, *type);
}

Result<Value> Registry::call(const ResolvedCall& call, std::span<Value> arguments, Context& context) {
  const Overload& overload = *call.overload;
  if (!prepare(overload, arguments)) return Value(*overload.result);
  auto outcome = guarded(*call.op, [&] {
    poll_interruption();
    return overload.function(arguments, context);
  });
  if (!outcome) {
    note_failed_call(call, arguments, outcome.error(), context);
    return std::move(outcome).error();
  }
  if (auto* value = std::get_if<Value>(&*outcome)) return std::move(*value);
  report_undefined(call, std::get<Undefined>(*outcome), context);
  return Value(*overload.result);
}

Result<RowSourcePtr> Registry::rows(const ResolvedCall& call, std::span<Value> arguments, Context& context) {
  if (!prepare(*call.overload, arguments)) return no_rows();
  auto outcome = guarded(*call.op, [&] { return call.overload->rows(arguments, context); });
  if (!outcome) {
    note_failed_call(call, arguments, outcome.error(), context);
    return std::move(outcome).error();
  }
  if (auto* rows = std::get_if<RowSourcePtr>(&*outcome))
    return RowSourcePtr(std::make_unique<RepeatableRows>(std::move(*rows), call, arguments));
  report_undefined(call, std::get<Undefined>(*outcome), context);
  return no_rows();
}

// Every word of two letters is near to `or` and `=`.
std::string Registry::suggestion(std::string_view word) const {
  constexpr std::size_t kShortest = 3;
  std::vector<std::string> names;
  for (const auto& [name, group] : group_of_)
    if (word.size() >= kShortest || is_equal_but_for_case(word, name)) names.emplace_back(name);
  return nearest_name(word, names);
}

std::string enumerate(const std::vector<std::string>& items, std::size_t limit) {
  std::string text;
  const std::size_t shown = std::min(items.size(), limit);
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == items.size() ? " or " : ", ";
    text += items[i];
  }
  if (items.size() > shown) text += " or " + std::to_string(items.size() - shown) + " more";
  return text;
}

bool is_equal_but_for_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower_case, lower_case);
}

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  // Of a word of one letter nothing would be left.
  std::size_t best_distance = std::min(std::max<std::size_t>(1, word.size() / 3) + 1, word.size());
  best_distance *= 2;
  for (const std::string& candidate : candidates) {
    if (candidate != word && is_equal_but_for_case(word, candidate)) return candidate;
    if (2 * word.size() >= 2 * candidate.size() + best_distance) continue;
    const std::size_t distance = double_edit_distance(word, candidate);
    if (distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string argument_list_text(std::span<const TypeExpr> types) {
  std::string text = "(";
  for (const TypeExpr& type : types) {
    if (text.size() > 1) text += ' ';
    text += type.text();
  }
  return text + ")";
}

}  // namespace algebra3d
