#include "algebra3d/operators/registry/operator.h"

#include <algorithm>

#include "base/propagate.h"

namespace algebra3d {

Status AggregateState::step_rows(const ValueColumn& column, SelectedRows rows, Context& context) {
  for (std::size_t i = 0; i < rows.count; ++i) {
    A3D_ASSIGN(const Value value, column.value(rows[i]).loaded());
    if (value.is_defined()) A3D_TRY(step(value, context));
  }
  return {};
}

std::string_view describe(Exactness exactness) {
  switch (exactness) {
    case Exactness::exact:
      return "exact";
    case Exactness::rounded_once:
      return "the exact result, rounded once";
    case Exactness::two_ulp:
      return "within 2 units in the last place";
    case Exactness::outward:
      return "the exact result, rounded outward";
    case Exactness::bounded:
      return "within the bound of the description";
    case Exactness::reported:
      return "off by no more than a diagnostic says";
    case Exactness::not_numeric:
      return "no arithmetic";
  }
  return "";
}

std::string_view describe(OperatorKind kind) {
  switch (kind) {
    case OperatorKind::scalar:
      return "scalar";
    case OperatorKind::aggregate:
      return "aggregate";
    case OperatorKind::table:
      return "table";
    case OperatorKind::relational:
      return "relational";
  }
  return "";
}

std::string_view describe(Cost cost) {
  switch (cost) {
    case Cost::unknown:
      return "unknown";
    case Cost::constant:
      return "constant";
    case Cost::linear:
      return "linear";
    case Cost::sorting:
      return "that of sorting";
    case Cost::pairs:
      return "every pair";
    case Cost::arrangement:
      return "an exact arrangement";
    case Cost::file:
      return "linear in the size of the file";
  }
  return "";
}

OperatorKind Overload::kind() const {
  if (start) return OperatorKind::aggregate;
  return rows ? OperatorKind::table : OperatorKind::scalar;
}

TypeExpr Overload::result_type() const {
  if (kind() != OperatorKind::table) return result->term();
  if (gives_elements) return TypeExpr::stream(columns.front().type->name());
  std::vector<TypeExpr::Attribute> attributes;
  for (const Column& column : columns) attributes.push_back({column.name, column.type->name()});
  return TypeExpr::stream(TypeExpr::tuple(std::move(attributes)));
}

std::string Overload::signature() const {
  std::string text = "(";
  for (const Parameter& parameter : parameters) {
    if (text.size() > 1) text += ' ';
    text += parameter.type->term().text();
  }
  if (kind() == OperatorKind::aggregate) text += '*';
  return text + ") -> " + result_type().text();
}

OperatorKind Operator::kind() const {
  return stream != nullptr || overloads.empty() ? OperatorKind::relational : overloads.front().kind();
}

bool Operator::accepts_undefined() const {
  return handles_undefined || std::ranges::any_of(overloads, [](const Overload& overload) {
           return std::ranges::any_of(overload.parameters, &Parameter::accepts_undefined);
         });
}

std::string Operator::written() const {
  if (!also_prefix) return syntax;
  std::string places;
  for (const char c : syntax)
    if (c == '_') places += places.empty() ? "_" : ", _";
  return syntax + ", " + name + "(" + places + ")";
}

std::vector<std::string> Operator::all_signatures() const {
  std::vector<std::string> all = signatures;
  for (const Overload& overload : overloads) all.push_back(overload.signature());
  return all;
}

}  // namespace algebra3d
