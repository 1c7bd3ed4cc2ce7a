#include "queries/language/session_parameters.h"

#include <vector>

#include "algebra3d/values/types/utf8.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
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

// As for commands: a string that is not text could be stored, but neither saved and restored nor shown.
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

Result<const SessionParameter*> find_parameter(const SessionParameters* parameters, const Token& token) {
  if (parameters != nullptr)
    if (const auto found = parameters->values.find(token.text); found != parameters->values.end())
      return &found->second;
  const SessionParameters none;
  const SessionParameters& known = parameters != nullptr ? *parameters : none;
  std::vector<std::string> names;
  for (const auto& [name, parameter] : known.values) names.push_back("$" + name);
  return Error(ErrorCode::unknown_name, "there is no parameter '${}'; {}", token.text,
               names.empty() ? fmt::format(fmt::runtime(known.advice), token.text)
                             : "the parameters are " + algebra3d::enumerate(names))
      .at(token.place);
}

// Of a type that has literals. Others may be large, and need not be written to be read again.
bool may_be_literal(const algebra3d::Value& value) {
  return value.is_defined() && value.type().storage() != Type::Storage::bytes;
}

// As a text has it; for a value that may be long, or is undefined, without its list.
WrittenConstant written(const SessionParameter& parameter) {
  if (const auto* constant = std::get_if<WrittenConstant>(&parameter)) return *constant;
  const algebra3d::Value& value = std::get<HostValue>(parameter).value;
  return {std::string(value.type().name()), may_be_literal(value) ? value.to_nested() : NestedList()};
}

// The type of a list that is a literal of the language; empty if it is not a literal.
std::string_view literal_type(const NestedList& list) {
  return list.is_int()      ? "int"
         : list.is_real()   ? "real"
         : list.is_bool()   ? "bool"
         : list.is_string() ? "string"
         : list.is_text()   ? "text"
                            : "";
}

}  // namespace

// Whether it is a value of the type is found now, not by the first command that uses it.
Result<SessionParameter> session_parameter(std::string_view type_name, std::string_view value,
                                           const Registry& registry) {
  A3D_ASSIGN(const Type* type, known_type(type_name, registry));
  A3D_ASSIGN(NestedList list, list_of_text(*type, value));
  algebra3d::Diagnostics reasons;  // come again when it is used
  algebra3d::Context context{reasons, nullptr, {}};
  A3D_ASSIGN(const algebra3d::Value checked, algebra3d::value_from_nested(*type, list, context));
  return SessionParameter(WrittenConstant{std::string(checked.type().name()), std::move(list)});
}

Result<std::pair<std::string, SessionParameter>> parse_session_parameter(std::string_view text,
                                                                         const Registry& registry) {
  A3D_TRY(check_is_text(text));
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return wrong_parameter(text, "expected NAME=VALUE or NAME:TYPE=VALUE");
  const std::string_view left = text.substr(0, equals);
  const std::string_view value = text.substr(equals + 1);
  const std::size_t colon = left.find(':');
  const std::string_view name = left.substr(0, colon);
  if (!is_identifier(name))
    return wrong_parameter(text,
                           "expected a name of letters, digits and '_' before the '=', found " + quoted_excerpt(name));
  if (colon == std::string_view::npos && is_number_beyond_range(value))
    return wrong_parameter(text, fmt::format("the number is out of range; if it is to be a string, write {}:string={}",
                                             name, quoted_excerpt(value)));
  const std::string_view type = colon == std::string_view::npos ? guessed_type(value) : left.substr(colon + 1);
  auto parameter = session_parameter(type, value, registry);
  if (!parameter) return wrong_parameter(text, parameter.error().text());
  return std::pair(std::string(name), std::move(parameter).value());
}

Result<ExpressionNode> parameter_constant(const SessionParameters* parameters, const Token& token) {
  A3D_ASSIGN(const SessionParameter* parameter, find_parameter(parameters, token));
  WrittenConstant constant = written(*parameter);
  // A plain literal also counts where an operator asks for one that it can see before it runs.
  if (constant.type == literal_type(constant.list)) return ExpressionNode(Literal{std::move(constant.list)});
  if (const auto* given = std::get_if<HostValue>(parameter)) return ExpressionNode(*given);
  TypeSyntax type;
  type.name = std::move(constant.type);
  type.place = token.place;
  return ExpressionNode(TypedLiteral{std::move(type), std::move(constant.list)});
}

Result<std::string> parameter_text(const SessionParameters* parameters, const Token& token) {
  A3D_ASSIGN(const SessionParameter* parameter, find_parameter(parameters, token));
  const WrittenConstant constant = written(*parameter);
  if (constant.list.is_string()) return constant.list.as_string();
  if (constant.list.is_text()) return constant.list.as_text();
  return Error(ErrorCode::type_error, "'${}': expected a string or a text, got {}", token.text, constant.type)
      .at(token.place);
}

}  // namespace queries
