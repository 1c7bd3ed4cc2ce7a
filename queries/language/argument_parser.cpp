// The arguments of an operator as its syntax pattern declares them.

#include "base/propagate.h"
#include "queries/language/expression_parser.h"

#include <utility>

namespace queries {

using algebra3d::SyntaxPattern;

Status ExpressionParser::places(const SyntaxPattern& pattern, std::string_view close,
                                std::vector<Argument>& arguments) {
  const std::string context = "in the arguments of '" + pattern.name + "'";
  std::size_t index = 0;
  while (index < pattern.places.size() || pattern.is_open_ended || !at(close)) {
    const bool is_declared = index < pattern.places.size();
    const Place place = is_declared ? pattern.places[index] : Place{};
    const bool may_be_empty = place.kind == SyntaxPattern::PlaceKind::attributes && index + 1 < pattern.places.size();
    if (at(close) && !may_be_empty) break;
    if (index > 0) A3D_TRY(expect(is_declared && place.before == ';' ? ";" : ",", context));
    A3D_ASSIGN(Argument next, argument(place));
    arguments.push_back(std::move(next));
    ++index;
    if (at(close) || at(",") || at(";")) continue;
    const bool is_incomplete = index < pattern.places.size() && pattern.places[index].before == ';';
    return expect(is_incomplete ? ";" : close, context);
  }
  return expect(close, context);
}

Result<Argument> ExpressionParser::argument(const Place& place) {
  Argument argument;
  argument.kind = place.kind;
  argument.place = scanner_.peek().place;
  using PlaceKind = SyntaxPattern::PlaceKind;
  switch (place.kind) {
    case PlaceKind::value:
    case PlaceKind::function: {
      A3D_ASSIGN(argument.value, expression());
      break;
    }
    case PlaceKind::attribute:
    case PlaceKind::name: {
      A3D_ASSIGN(std::string word, name(place.kind == PlaceKind::name ? "a name" : "an attribute name"));
      argument.names = {std::move(word)};
      break;
    }
    case PlaceKind::attributes:
      A3D_TRY(attribute_names(argument, false));
      break;
    case PlaceKind::keys:
      A3D_TRY(attribute_names(argument, true));
      break;
    case PlaceKind::functions:
      A3D_TRY(function_list(argument));
      break;
    case PlaceKind::renames:
      A3D_TRY(rename_list(argument));
      break;
  }
  return argument;
}

Status ExpressionParser::attribute_names(Argument& argument, bool with_order) {
  if (at(";") || at("]")) return {};
  do {
    A3D_ASSIGN(std::string attribute, name("an attribute name"));
    argument.names.push_back(std::move(attribute));
    if (!with_order) continue;
    const bool is_descending = accept("desc");
    if (!is_descending) accept("asc");
    argument.modifiers.emplace_back(is_descending ? "desc" : "asc");
  } while (accept(","));
  return {};
}

Status ExpressionParser::function_list(Argument& argument) {
  if (at("]")) return {};
  do {
    NamedExpression function;
    A3D_ASSIGN(function.name, name("the name of a new attribute"));
    A3D_TRY(expect(":", "after the name of the new attribute '" + function.name + "'"));
    A3D_ASSIGN(function.value, expression());
    argument.functions.push_back(std::move(function));
  } while (accept(","));
  return {};
}

Status ExpressionParser::rename_list(Argument& argument) {
  do {
    A3D_ASSIGN(std::string renamed, name("the new name of an attribute"));
    A3D_TRY(expect(":", "after the new name '" + renamed + "'"));
    if (!scanner_.peek().is_name() && scanner_.peek().kind != Token::Kind::string)
      return unexpected("an attribute name");
    argument.names.push_back(std::move(renamed));
    argument.modifiers.push_back(scanner_.take().text);
  } while (accept(","));
  return {};
}

}  // namespace queries
