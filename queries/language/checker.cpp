#include "queries/language/checker.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "algebra3d/registry/conversion.h"
#include "algebra3d/registry/operator.h"
#include "algebra3d/types/scalars.h"
#include "queries/streams/value_operators.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using algebra3d::SyntaxPattern;
using PlaceKind = SyntaxPattern::PlaceKind;

// `TUPLE` and its like, where a parameter type is written.
bool is_pseudo_type(std::string_view name) {
  return name == "TUPLE" || name == "TUPLE2" || name == "STREAMELEM" || name == "GROUP";
}

bool has_attribute(const TypeExpr& type, const std::string& name) {
  return type.is_tuple() &&
         std::ranges::find(type.attributes(), name, &TypeExpr::Attribute::name) != type.attributes().end();
}

// Whether a parameter takes an argument, perhaps after a conversion.
bool takes(const TypeExpr& parameter, const TypeExpr& argument) {
  return parameter == argument ||
         (parameter.arguments().empty() && algebra3d::conversion_cost(argument, parameter.name()));
}

bool is_literal(const Expression& expression) {
  return std::holds_alternative<Literal>(expression.node) || std::holds_alternative<TypedLiteral>(expression.node) ||
         std::holds_alternative<HostValue>(expression.node);
}

std::optional<std::int64_t> int_literal(const Expression& expression) {
  const auto* literal = std::get_if<Literal>(&expression.node);
  if (literal == nullptr || !literal->atom.is_int()) return std::nullopt;
  return literal->atom.as_int();
}

}  // namespace

Result<TypedPtr> Checker::check(const Expression& expression) {
  return std::visit([&](const auto& node) { return check(node, expression.place); }, expression.node);
}

Result<TypedPtr> Checker::check(const Literal& literal, const SourcePlace& place) {
  const NestedList& atom = literal.atom;
  const std::string_view type = atom.is_int()      ? "int"
                                : atom.is_real()   ? "real"
                                : atom.is_bool()   ? "bool"
                                : atom.is_string() ? "string"
                                                   : "text";
  TypedLiteral typed;
  typed.list = atom;
  return constant(TypeExpr(type), typed, place);
}

Result<TypedPtr> Checker::check(const TypedLiteral& literal, const SourcePlace& place) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr type, resolve(literal.type));
  return constant(type, literal, place);
}

Result<TypedPtr> Checker::check(const HostValue& given, const SourcePlace& place) {
  TypeExpr type(given.value.type().name());
  if (!given.value.is_defined() && !given.reason.empty())
    return make_undefined(std::move(type), given.value, given.reason, place);
  return make_constant(std::move(type), Datum{given.value}, place);
}

Result<TypedPtr> Checker::check(const NameUse& use, const SourcePlace& place) {
  ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr found, find(use.name, place));
  if (found == nullptr) return unknown_name(use.name, place);
  return found;
}

// A parameter or else an object; null if there is neither.
Result<TypedPtr> Checker::find(const std::string& name, const SourcePlace& place) {
  for (std::size_t level = 0; level < scopes_.size(); ++level) {
    const Scope& scope = scopes_[scopes_.size() - 1 - level];
    const auto found = std::ranges::find(scope.parameters, name, &Parameter::name);
    if (found != scope.parameters.end())
      return make_parameter(found->type, level, static_cast<std::size_t>(found - scope.parameters.begin()), place);
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto type, objects_.type_of(name));
  return type ? make_object(*type, name, objects_, place) : TypedPtr();
}

Result<TypedPtr> Checker::implicit_parameter(int number, const SourcePlace& place, std::string_view shown) {
  for (std::size_t level = 0; level < scopes_.size(); ++level) {
    const Scope& scope = scopes_[scopes_.size() - 1 - level];
    if (!scope.is_implicit) continue;
    if (static_cast<std::size_t>(number) > scope.parameters.size())
      return Error(ErrorCode::type_error, "'{}': the function here has {} parameter{}", shown, scope.parameters.size(),
                   scope.parameters.size() == 1 ? "" : "s")
          .at(place);
    const auto index = static_cast<std::size_t>(number - 1);
    return make_parameter(scope.parameters[index].type, level, index, place);
  }
  return Error(ErrorCode::type_error,
               "'{}' needs an operator around it that gives it a meaning, such as filter or extend", shown)
      .at(place);
}

Result<TypedPtr> Checker::check(const AttributeUse& use, const SourcePlace& place) {
  const std::string shown = (use.parameter == 2 ? ".." : ".") + use.name;
  ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr tuple, implicit_parameter(use.parameter, place, shown));
  if (!tuple->type().is_tuple())
    return Error(ErrorCode::type_error, "'{}': expected a tuple, got {}", shown, tuple->type().text()).at(place);
  auto index = attribute_index(tuple->type(), use.name);
  if (!index) {
    const int other = use.parameter == 1 ? 2 : 1;
    const Scope& scope = *implicit_scope();
    if (scope.parameters.size() >= 2 && use.parameter <= 2 && has_attribute(scope.parameters[other - 1].type, use.name))
      return Error(ErrorCode::unknown_name, "unknown attribute '{}', did you mean '{}{}', of the {} stream?", shown,
                   other == 2 ? ".." : ".", use.name, other == 2 ? "second" : "first")
          .at(place);
    return std::move(index).error().at(place);
  }
  TypeExpr type = tuple->type().attributes()[*index].type;
  return make_attribute(std::move(type), std::move(tuple), *index, place);
}

Result<TypedPtr> Checker::check(const ParameterUse& use, const SourcePlace& place) {
  return implicit_parameter(use.parameter, place, use.parameter == 1 ? "." : "..");
}

Result<TypedPtr> Checker::check(const Application& application, const SourcePlace& place) {
  const Operator& op = *registry_.find_operator(application.name);
  std::vector<TypeExpr> types;
  if (recorder_ == nullptr) return application_node(op, application, place, types);
  const std::size_t step = recorder_->begin(op.name);
  ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr node, application_node(op, application, place, types));
  std::string signature = algebra3d::argument_list_text(types) + " -> " + node->type().text();
  return recorder_->finish(step, std::move(signature), std::move(node));
}

Result<TypedPtr> Checker::application_node(const Operator& op, const Application& application, const SourcePlace& place,
                                           std::vector<TypeExpr>& types) {
  std::vector<TypedPtr> checked(application.arguments.size());
  if (application.is_call) {
    ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr call, call_of_function(application, place, checked));
    if (call != nullptr) return call;
  }
  return takes_streams(op) ? stream_application(op, application, checked, place, types)
                           : value_application(op, application, std::move(checked), place, types);
}

// The call of a function that has the operator's name, if its parameters take the arguments, else null: a database that
// had such a function before there was the operator keeps its meaning. No argument is checked twice, or nested calls
// would take exponential time: `checked` gets the operands that were, and names where the operator expects some do not
// decide.
Result<TypedPtr> Checker::call_of_function(const Application& application, const SourcePlace& place,
                                           std::vector<TypedPtr>& checked) {
  ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr function, find(application.name, place));
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
    ALGEBRA3D_ASSIGN_OR_RETURN(checked[index], check(*argument.value));
    fits = fits && takes(parameters[index], checked[index]->type());
  }
  if (!fits) return TypedPtr();
  std::vector<TypedPtr> arguments = checked;
  for (std::size_t index = 0; index < arguments.size(); ++index) {
    const Argument& argument = application.arguments[index];
    if (arguments[index] == nullptr) {
      ALGEBRA3D_ASSIGN_OR_RETURN(arguments[index], check(argument.value ? *argument.value : *argument.as_operand));
    }
    ALGEBRA3D_ASSIGN_OR_RETURN(arguments[index],
                               fitted(std::move(arguments[index]), parameters[index], application.name));
  }
  return make_function_call(std::move(function), std::move(arguments), place);
}

// `checked` holds the operands that are checked already.
Result<TypedPtr> Checker::value_application(const Operator& op, const Application& application,
                                            std::vector<TypedPtr> checked, const SourcePlace& place,
                                            std::vector<TypeExpr>& types) {
  for (std::size_t index = 0; index < checked.size(); ++index) {
    if (checked[index] == nullptr) {
      ALGEBRA3D_ASSIGN_OR_RETURN(checked[index], check(*application.arguments[index].value));
    }
    types.push_back(checked[index]->type());
  }
  auto call = registry_.resolve(op, types);
  if (!call) return std::move(call).error().at(place);
  return make_value_call(*call, std::move(checked), place);
}

Status Checker::check_place_count(const Operator& op, const Application& application, const SourcePlace& place) {
  const SyntaxPattern& pattern = registry_.syntax(op);
  const std::size_t given = application.arguments.size();
  if (given >= pattern.place_count() && (given == pattern.place_count() || pattern.is_open_ended)) return {};
  // What stands before the operator is always there in a text.
  const std::size_t before = pattern.has_brackets && given >= pattern.operand_count ? pattern.operand_count : 0;
  if (before > 0 && given == before)
    return Error(ErrorCode::type_error, "{}: expected something in the brackets (syntax: {})", op.name, op.syntax)
        .at(place);
  const std::size_t expected = pattern.place_count() - before;
  return Error(ErrorCode::type_error, "{}: expected {}{} argument{}{}, got {} (syntax: {})", op.name,
               pattern.is_open_ended ? "at least " : "", expected, expected == 1 ? "" : "s",
               before > 0 ? " in the brackets" : "", given - before, op.syntax)
      .at(place);
}

Result<TypedPtr> Checker::stream_application(const Operator& op, const Application& application,
                                             const std::vector<TypedPtr>& checked, const SourcePlace& place,
                                             std::vector<TypeExpr>& shown_types) {
  ALGEBRA3D_RETURN_IF_ERROR(check_place_count(op, application, place));
  const SyntaxPattern& pattern = registry_.syntax(op);
  static const std::vector<std::string> none;
  std::vector<TypedPtr> nodes;
  std::vector<ArgumentType> types;
  std::vector<TypeExpr> operands;
  for (std::size_t index = 0; index < application.arguments.size(); ++index) {
    const bool is_operand = index < pattern.operand_count;
    const std::size_t bracket = index - pattern.operand_count;
    const bool is_declared = !is_operand && bracket < pattern.places.size();
    const FunctionPlace functions{is_declared ? pattern.places[bracket].parameters : none, operands};
    ArgumentType type;
    auto node = checked_argument(application.arguments[index], checked[index], functions, type);
    if (!node) {
      Error error = std::move(node).error();
      if (!error.place.is_known()) error.message = op.name + ": " + error.message;
      return std::move(error).at(place);
    }
    if (is_operand) operands.push_back(type.type);
    // In prefix form the first arguments are the operands of later function places.
    if (pattern.operand_count == 0 && application.arguments[index].kind == PlaceKind::value)
      operands.push_back(type.type);
    if (!type.type.name().empty()) shown_types.push_back(type.type);
    nodes.push_back(std::move(node).value());
    types.push_back(std::move(type));
  }
  auto bound = bind_operator(op, types, context_);
  if (!bound) return std::move(bound).error().at(place);
  return make_stream_call(std::move(bound).value(), std::move(nodes), place);
}

Result<TypedPtr> Checker::checked_argument(const Argument& argument, const TypedPtr& checked,
                                           const FunctionPlace& function_place, ArgumentType& type) {
  if (argument.misread) return *argument.misread;
  type.names = argument.names;
  type.modifiers = argument.modifiers;
  switch (argument.kind) {
    case PlaceKind::value: {
      TypedPtr node = checked;
      if (node == nullptr) {
        ALGEBRA3D_ASSIGN_OR_RETURN(node, check(*argument.value));
      }
      type.type = node->type();
      type.literal = int_literal(*argument.value);
      // Outside of all functions nothing depends on a parameter.
      if (scopes_.empty() || is_literal(*argument.value))
        type.constant = [node, &context = context_] { return node->evaluate_value(nullptr, context); };
      return node;
    }
    case PlaceKind::function: {
      ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr node, function_argument(*argument.value, function_place));
      type.type = node->type();
      return node;
    }
    case PlaceKind::functions: {
      std::vector<TypedPtr> functions;
      for (const auto& [name, value] : argument.functions) {
        ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr node, function_argument(*value, function_place));
        type.names.push_back(name);
        type.types.push_back(node->type());
        functions.push_back(std::move(node));
      }
      return make_list(std::move(functions), argument.place);
    }
    default:
      return make_list({}, argument.place);
  }
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
    ALGEBRA3D_ASSIGN_OR_RETURN(TypeExpr type, pseudo_type(pseudo, place.operands));
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
  ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr node, check(NameUse{reference.name}, place));
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
    if (function.error().code != ErrorCode::unknown_name) return std::move(function).error();
    if (const Operator* op = registry_.find_operator(call.name); op != nullptr)
      return Error(ErrorCode::unknown_name, "there is no function '{}'; the operator of that name is written {}",
                   call.name, op->written())
          .at(place);
    std::string suggestion = registry_.suggestion(call.name);
    if (suggestion.empty()) suggestion = algebra3d::nearest_name(call.name, objects_.names());
    return Error(ErrorCode::unknown_name, "unknown operator '{}'{}", call.name,
                 suggestion.empty() ? "" : ", did you mean '" + suggestion + "'?")
        .at(place);
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
    ALGEBRA3D_ASSIGN_OR_RETURN(TypedPtr argument, check(*call.arguments[index]));
    ALGEBRA3D_ASSIGN_OR_RETURN(argument, fitted(std::move(argument), parameters[index], call.name));
    arguments.push_back(std::move(argument));
  }
  return make_function_call(std::move(function).value(), std::move(arguments), place);
}

// No operator takes lists as values; a list of one element is that element, as in `(translate v (vec))`.
Result<TypedPtr> Checker::check(const ListExpression& list, const SourcePlace& place) {
  if (list.items.size() == 1 && list.items[0].name.empty() && list.items[0].modifier == nullptr)
    return check(*list.items[0].value);
  return Error(ErrorCode::type_error, "a list of {} elements is no value", list.items.size()).at(place);
}

Error Checker::unknown_name(const std::string& name, const SourcePlace& place) {
  const std::vector<std::string> attributes = attributes_in_reach(name);
  const Operator* op = registry_.find_operator(name);
  std::string message = "unknown name '" + name + "'";
  if (!attributes.empty())
    message += fmt::format(", did you mean the attribute '{}'?", fmt::join(attributes, "' or '"));
  else if (op != nullptr)
    message = fmt::format("there is no object '{}'; the operator of that name is written {}", name, op->written());
  else if (const std::string meant = name_meant(name); !meant.empty())
    message += ", did you mean '" + meant + "'?";
  else if (!objects_.is_open())
    return Error(ErrorCode::no_database, "{}: no database is open", message).at(place);
  return Error(ErrorCode::unknown_name, message).at(place);
}

const Checker::Scope* Checker::implicit_scope() const {
  const auto found =
      std::find_if(scopes_.rbegin(), scopes_.rend(), [](const Scope& scope) { return scope.is_implicit; });
  return found == scopes_.rend() ? nullptr : &*found;
}

// How attributes of that name are written here: `.Name`, `..Name`, attr(t, Name).
std::vector<std::string> Checker::attributes_in_reach(const std::string& name) const {
  std::vector<std::string> written;
  const Scope* implicit = implicit_scope();
  for (std::size_t i = 0; implicit != nullptr && i < implicit->parameters.size(); ++i)
    if (has_attribute(implicit->parameters[i].type, name)) written.push_back((i == 0 ? "." : "..") + name);
  if (!written.empty() || scopes_.empty()) return written;
  for (const Parameter& parameter : scopes_.back().parameters)
    if (has_attribute(parameter.type, name)) written.push_back("attr(" + parameter.name + ", " + name + ")");
  return written;
}

// The nearest of the objects, else of the attributes, else of the operators that begin an operand.
std::string Checker::name_meant(const std::string& name) {
  if (algebra3d::is_equal_but_for_case(name, "TRUE")) return "TRUE";
  if (algebra3d::is_equal_but_for_case(name, "FALSE")) return "FALSE";
  std::string nearest = algebra3d::nearest_name(name, objects_.names());
  if (!nearest.empty()) return nearest;
  std::vector<std::string> attributes;
  if (const Scope* implicit = implicit_scope(); implicit != nullptr && !implicit->parameters.empty())
    if (const TypeExpr& type = implicit->parameters.front().type; type.is_tuple())
      for (const TypeExpr::Attribute& attribute : type.attributes()) attributes.push_back(attribute.name);
  nearest = algebra3d::nearest_name(name, attributes);
  if (!nearest.empty()) return "." + nearest;
  nearest = registry_.suggestion(name);
  const Operator* op = registry_.find_operator(nearest);
  return op != nullptr && registry_.syntax(*op).shape == SyntaxPattern::Shape::prefix ? nearest : "";
}

Result<std::size_t> attribute_index(const TypeExpr& tuple, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& attribute : tuple.attributes()) names.push_back(attribute.name);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string suggestion = algebra3d::nearest_name(name, names);
  return Error{ErrorCode::unknown_name, "unknown attribute '{}'{}; the attributes are {}", name,
               suggestion.empty() ? "" : ", did you mean '" + suggestion + "'?", algebra3d::enumerate(names, 20)};
}

}  // namespace queries
