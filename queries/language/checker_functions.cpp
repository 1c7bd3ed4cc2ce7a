// The part of the checker that makes functions, and calls of functions.
#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/operator.h"
#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/parser.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using PlaceKind = algebra3d::SyntaxPattern::PlaceKind;

namespace {

// `TUPLE` and its like, where a parameter type is written.
bool is_pseudo_type(std::string_view name) {
  return name == "TUPLE" || name == "TUPLE2" || name == "STREAMELEM" || name == "GROUP";
}

// Whether a parameter takes an argument, perhaps after a conversion.
bool takes(const TypeExpr& parameter, const TypeExpr& argument) {
  return parameter == argument ||
         (parameter.arguments().empty() && algebra3d::conversion_cost(argument, parameter.name()));
}

}  // namespace

// The call of a function that has the operator's name, if its parameters take the arguments, else null: a database that
// had such a function before there was the operator keeps its meaning. No argument is checked twice, or nested calls
// would take exponential time: `checked` gets the operands that were, and names where the operator expects some do not
// decide.
Result<TypedPtr> Checker::call_of_function(const Application& application, const SourcePlace& place,
                                           std::vector<TypedPtr>& checked) {
  A3D_ASSIGN(TypedPtr function, find(application.name, place));
  if (function == nullptr || !function->type().is_function()) return TypedPtr();
  const std::vector<TypeExpr> parameters = function->type().function_parameters();
  if (parameters.size() != checked.size()) return TypedPtr();
  bool fits = true;
  for (std::size_t index = 0; index < checked.size(); ++index) {
    const Argument& argument = application.arguments[index];
    if (argument.kind != PlaceKind::value) {
      fits = fits && (argument.value != nullptr || argument.as_operand != nullptr);
      continue;
    }
    A3D_ASSIGN(checked[index], check(*argument.value));
    fits = fits && takes(parameters[index], checked[index]->type());
  }
  if (!fits) return TypedPtr();
  std::vector<TypedPtr> arguments = checked;
  for (std::size_t index = 0; index < arguments.size(); ++index) {
    const Argument& argument = application.arguments[index];
    if (arguments[index] == nullptr) {
      A3D_ASSIGN(arguments[index], check(argument.value ? *argument.value : *argument.as_operand));
    }
    A3D_ASSIGN(arguments[index], fitted(std::move(arguments[index]), parameters[index], application.name));
  }
  return make_function_call(std::move(function), std::move(arguments), place);
}

Result<TypedPtr> Checker::function_argument(const Expression& expression, const FunctionPlace& place) {
  if (const auto* literal = std::get_if<FunctionLiteral>(&expression.node))
    return explicit_function(*literal, place, expression.place);
  if (std::holds_alternative<FunctionReference>(expression.node)) return check(expression);
  if (std::holds_alternative<NameUse>(expression.node)) {
    // The name of a function stands for it, with or without `fun`; any other is a constant of all tuples.
    auto named = check(expression);
    if (!named || (*named)->type().is_function()) return named;
  }
  Scope scope;
  scope.is_implicit = true;
  for (const std::string& pseudo : place.pseudo_types) {
    A3D_ASSIGN(TypeExpr type, pseudo_type(pseudo, place.operands));
    scope.parameters.push_back({"", std::move(type)});
  }
  return make_checked_function(std::move(scope), expression, expression.place);
}

Result<TypedPtr> Checker::explicit_function(const FunctionLiteral& function, const FunctionPlace& functions,
                                            const SourcePlace& place) {
  Scope scope;
  for (const auto& [name, syntax] : function.parameters) {
    // A bare pseudo type is taken from the operands; every other type is as written.
    auto type = is_pseudo_type(syntax.name) && syntax.arguments.empty() && !syntax.type_of
                    ? pseudo_type(syntax.name, functions.operands)
                    : resolve(syntax);
    if (!type) return std::move(type).error().at(syntax.place);
    scope.parameters.push_back({name, std::move(type).value()});
  }
  return make_checked_function(std::move(scope), *function.body, place);
}

Result<TypedPtr> Checker::make_checked_function(Scope scope, const Expression& body, const SourcePlace& place) {
  std::vector<TypeExpr> parameters;
  NestedList::List written = {NestedList::symbol("fun")};
  for (std::size_t index = 0; index < scope.parameters.size(); ++index) {
    const Parameter& parameter = scope.parameters[index];
    parameters.push_back(parameter.type);
    // Implicit parameters are written as the tree names them: `.` is tuple1, `..` tuple2.
    std::string name = parameter.name.empty() ? "tuple" + std::to_string(index + 1) : parameter.name;
    written.push_back(NestedList::list(NestedList::symbol(std::move(name)), parameter.type.to_nested()));
  }
  written.push_back(to_nested(body));
  scopes_.push_back(std::move(scope));
  auto checked = check(body);
  scopes_.pop_back();
  if (!checked) return std::move(checked).error();
  TypeExpr type = TypeExpr::map(std::move(parameters), (*checked)->type());
  return make_function(std::move(type), std::move(checked).value(), NestedList(std::move(written)), body.height, place);
}

Result<TypedPtr> Checker::check(const FunctionLiteral& function, const SourcePlace& place) {
  return explicit_function(function, {{}, {}}, place);
}

Result<TypedPtr> Checker::check(const FunctionReference& reference, const SourcePlace& place) {
  A3D_ASSIGN(TypedPtr node, check(NameUse{reference.name}, place));
  if (!node->type().is_function())
    return Error(ErrorCode::type_error, "fun {}: expected a function, got {}", reference.name, node->type().text())
        .at(place);
  return node;
}

Result<TypedPtr> Checker::fitted(TypedPtr argument, const TypeExpr& wanted, const std::string& what) {
  if (argument->type() == wanted) return argument;
  if (takes(wanted, argument->type())) return make_conversion(std::move(argument), *registry_.find_type(wanted.name()));
  return Error(ErrorCode::type_error, "{}: expected {}, got {}", what, wanted.text(), argument->type().text())
      .at(argument->place());
}

Result<TypedPtr> Checker::check(const FunctionCall& call, const SourcePlace& place) {
  auto function = check(NameUse{call.name}, place);
  if (!function) {
    const bool is_without_database = function.error().code == ErrorCode::no_database;
    if (function.error().code != ErrorCode::unknown_name && !is_without_database) return std::move(function).error();
    if (const Operator* op = registry_.find_operator(call.name); op != nullptr)
      return Error(ErrorCode::unknown_name, "there is no function '{}'; the operator of that name is written {}",
                   call.name, op->written())
          .at(place);
    std::string hint = did_you_mean(call.name, registry_);
    if (const std::string object = algebra3d::nearest_name(call.name, objects_.names());
        hint.empty() && !object.empty())
      hint = ", did you mean '" + object + "'?";
    if (is_without_database && hint.empty()) return std::move(function).error();
    return Error(ErrorCode::unknown_name, "unknown operator '{}'{}", call.name, hint).at(place);
  }
  const TypeExpr& type = (*function)->type();
  if (!type.is_function())
    return Error(ErrorCode::type_error, "{}: expected a function, got {}", call.name, type.text()).at(place);
  const std::vector<TypeExpr> parameters = type.function_parameters();
  if (parameters.size() != call.arguments.size())
    return Error(ErrorCode::type_error, "{}: expected {} arguments, got {}", call.name,
                 algebra3d::argument_list_text(parameters), call.arguments.size())
        .at(place);
  std::vector<TypedPtr> arguments;
  for (std::size_t index = 0; index < parameters.size(); ++index) {
    A3D_ASSIGN(TypedPtr argument, check(*call.arguments[index]));
    A3D_ASSIGN(argument, fitted(std::move(argument), parameters[index], call.name));
    arguments.push_back(std::move(argument));
  }
  return make_function_call(std::move(function).value(), std::move(arguments), place);
}

}  // namespace queries
