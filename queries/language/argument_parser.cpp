// The arguments of an operator as its syntax pattern declares them.

#include "base/propagate.h"
#include "queries/language/expression_parser.h"

#include <utility>

namespace queries {

using algebra3d::SyntaxPattern;

namespace {

/// Whether `,` and `;` separate alike here: before the last argument, after one attribute, as in joins. After a list of
/// attributes they do not.
bool takes_either_separator(const SyntaxPattern& pattern, std::size_t index) {
  return index > 0 && index + 1 >= pattern.places.size() && index <= pattern.places.size() &&
         pattern.places[index - 1].kind == SyntaxPattern::PlaceKind::attribute;
}

}  // namespace

Status ExpressionParser::places(const algebra3d::Operator& op, std::string_view close,
                                std::vector<Argument>& arguments) {
  const SyntaxPattern& pattern = registry_.syntax(op);
  const auto expect_here = [&](std::string_view spelling) -> Status {
    if (accept(spelling)) return {};
    return unexpected_in(op, fmt::format("'{}' in the arguments of '{}'", spelling, pattern.name));
  };
  std::size_t index = 0;
  while (index < pattern.places.size() || pattern.is_open_ended || !at(close)) {
    const bool is_declared = index < pattern.places.size();
    const Place place = is_declared ? pattern.places[index] : Place{};
    const bool may_be_empty = place.kind == SyntaxPattern::PlaceKind::attributes && index + 1 < pattern.places.size();
    if (at(close) && !may_be_empty) break;
    const char separator = is_declared ? place.before : ',';
    if (takes_either_separator(pattern, index) && accept(separator == ';' ? "," : ";")) {
      // The other separator than the one in the syntax.
    } else if (index > 0) {
      A3D_TRY(expect_here(std::string_view(&separator, 1)));
    }
    A3D_ASSIGN(Argument next, argument(place));
    arguments.push_back(std::move(next));
    ++index;
    if (at(close) || at(",") || at(";")) continue;
    const bool is_incomplete = index < pattern.places.size() && pattern.places[index].before == ';';
    return expect_here(is_incomplete ? ";" : close);
  }
  return expect_here(close);
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
