#include "queries/language/session_parameters.h"

#include <vector>

#include "algebra3d/types/utf8.h"
#include "queries/language/scanner.h"
#include "queries/streams/plain_text.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Registry;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::Type;

namespace {

Error wrong_parameter(std::string_view text, std::string_view why) {
  return {ErrorCode::wrong_usage, "-p {}: {}", quoted_excerpt(text), why};
}

// As for commands: a string that is no text could be stored, but neither saved and restored nor shown.
Status check_is_text(std::string_view text) {
  const std::size_t wrong = algebra3d::first_no_text(text);
  if (wrong == std::string_view::npos) return {};
  const SourcePlace place = algebra3d::place_behind(text.substr(0, wrong), {"", 1, 1});
  return wrong_parameter(algebra3d::shown_as_text(text),
                         fmt::format("{}:{}: {}", place.line, place.column, algebra3d::no_text_message(text[wrong])));
}

std::string_view guessed_type(std::string_view value) {
  switch (plain_kind(value)) {
    case PlainKind::boolean:
      return "bool";
    case PlainKind::integer:
      return "int";
    case PlainKind::real:
      return "real";
    default:
      return "string";
  }
}

Result<const Type*> known_type(std::string_view name, const Registry& registry) {
  if (const Type* type = registry.find_type(name)) return type;
  std::vector<std::string> names;
  for (const Type* type : registry.types()) names.emplace_back(type->name());
  const std::string nearest = algebra3d::nearest_name(name, names);
  return Error{ErrorCode::wrong_usage, "unknown type '{}'{}", name,
               nearest.empty() ? "" : ", did you mean '" + nearest + "'?"};
}

// Whether it is a value of the type is found now, not by the first command that uses it.
Result<SessionParameter> parameter_of(std::string_view type_name, std::string_view value, const Registry& registry) {
  ASSIGN_OR_RETURN(const Type* type, known_type(type_name, registry));
  ASSIGN_OR_RETURN(NestedList list, list_of_text(*type, value));
  algebra3d::Diagnostics reasons;  // come again when it is used
  algebra3d::Context context{reasons, nullptr, {}};
  ASSIGN_OR_RETURN(const algebra3d::Value checked, algebra3d::value_from_nested(*type, list, context));
  return SessionParameter{std::string(checked.type().name()), std::move(list)};
}

Result<const SessionParameter*> find_parameter(const SessionParameters* parameters, const Token& token) {
  if (parameters != nullptr)
    if (const auto found = parameters->find(token.text); found != parameters->end()) return &found->second;
  std::vector<std::string> names;
  if (parameters != nullptr)
    for (const auto& [name, parameter] : *parameters) names.push_back("$" + name);
  return Error(ErrorCode::unknown_name, "there is no parameter '${0}'; {1}", token.text,
               names.empty() ? "start the program with -p " + token.text + "=VALUE"
                             : "the parameters are " + algebra3d::enumerate(names))
      .at(token.place);
}

}  // namespace

Result<std::pair<std::string, SessionParameter>> parse_session_parameter(std::string_view text,
                                                                         const Registry& registry) {
  RETURN_IF_ERROR(check_is_text(text));
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return wrong_parameter(text, "expected NAME=VALUE or NAME:TYPE=VALUE");
  const std::string_view left = text.substr(0, equals);
  const std::string_view value = text.substr(equals + 1);
  const std::size_t colon = left.find(':');
  const std::string_view name = left.substr(0, colon);
  if (!is_identifier(name))
    return wrong_parameter(text,
                           "expected a name of letters, digits and '_' before the '=', found " + quoted_excerpt(name));
  const std::string_view type = colon == std::string_view::npos ? guessed_type(value) : left.substr(colon + 1);
  auto parameter = parameter_of(type, value, registry);
  if (!parameter) return wrong_parameter(text, parameter.error().message);
  return std::pair(std::string(name), std::move(parameter).value());
}

Result<ExpressionNode> parameter_constant(const SessionParameters* parameters, const Token& token) {
  ASSIGN_OR_RETURN(const SessionParameter* parameter, find_parameter(parameters, token));
  // A plain literal also counts where an operator asks for one that it can see before it runs.
  const NestedList& value = parameter->value;
  const std::string_view literal_type = value.is_int()      ? "int"
                                        : value.is_real()   ? "real"
                                        : value.is_bool()   ? "bool"
                                        : value.is_string() ? "string"
                                        : value.is_text()   ? "text"
                                                            : "";
  if (parameter->type == literal_type) return ExpressionNode(Literal{value});
  TypeSyntax type;
  type.name = parameter->type;
  type.place = token.place;
  return ExpressionNode(TypedLiteral{std::move(type), value});
}

Result<std::string> parameter_text(const SessionParameters* parameters, const Token& token) {
  ASSIGN_OR_RETURN(const SessionParameter* parameter, find_parameter(parameters, token));
  if (parameter->value.is_string()) return parameter->value.as_string();
  if (parameter->value.is_text()) return parameter->value.as_text();
  return Error(ErrorCode::type_error, "'${}': expected a string or a text, got {}", token.text, parameter->type)
      .at(token.place);
}

}  // namespace queries
