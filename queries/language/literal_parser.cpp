// Constants: numbers, lists, values of a named type, functions.

#include "queries/language/expression_parser.h"

#include <limits>
#include <utility>

#include "base/propagate.h"
#include "queries/language/parser.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using Kind = Token::Kind;

namespace {

// Of longer constants errors have the place of the whole.
constexpr std::size_t kLongestKeptLiteral = 1'000'000;

}  // namespace

Result<ExpressionPtr> ExpressionParser::signed_number() {
  const SourcePlace place = scanner_.peek().place;
  const bool is_negative = at("-");
  const bool is_signed = is_negative || at("+");
  if (is_signed) scanner_.take();
  if (scanner_.peek().kind != Kind::integer && scanner_.peek().kind != Kind::real)
    return unexpected("a number after the sign");
  const Token number = scanner_.take();
  if (scanner_.error()) return *scanner_.error();
  const double value = is_negative ? -number.real : number.real;
  // `+5` is a real by the rules of the language.
  if (number.kind == Kind::real || (is_signed && !is_negative)) return make(place, Literal{NestedList(value)});
  if (is_negative) return make(place, Literal{NestedList(static_cast<std::int64_t>(0 - number.integer))});
  if (number.integer > std::numeric_limits<std::int64_t>::max())
    return Error(ErrorCode::syntax_error, "{}", int_range_text(std::to_string(number.integer))).at(place);
  return make(place, Literal{NestedList(static_cast<std::int64_t>(number.integer))});
}

Result<ExpressionPtr> ExpressionParser::list() {
  const SourcePlace place = scanner_.take().place;
  if (at("const")) {
    A3D_TRY(deeper());
    return typed_literal();
  }
  ListExpression content;
  while (!at("]")) {
    ListExpression::Item item;
    const bool is_named = scanner_.peek().is_name() && scanner_.peek(1).is(":");
    if (is_named) {
      item.name = scanner_.take().text;
      scanner_.take();
    }
    ++depth_;
    A3D_TRY(deeper());
    if (const auto second = scanner_.peek(1); !is_named && (second.is("asc") || second.is("desc"))) {
      const Token key = scanner_.take();
      const Token order = scanner_.take();
      item.value = make(key.place, NameUse{key.text});
      item.modifier = make(order.place, NameUse{order.text});
    } else {
      A3D_ASSIGN(item.value, expression());
    }
    --depth_;
    content.items.push_back(std::move(item));
    if (!accept(",")) break;
  }
  A3D_TRY(expect("]", "to close the list"));
  return make(place, std::move(content));
}

// The value is a nested list, which has rules of its own: it is cut out as text and read by NestedList.
Result<ExpressionPtr> ExpressionParser::typed_literal() {
  const SourcePlace place = scanner_.take().place;
  TypedLiteral literal;
  A3D_ASSIGN(literal.type, type());
  A3D_TRY(expect("value", "after the type of a constant"));
  const SourcePlace list_place = scanner_.peek().place;
  const auto raw = scanner_.take_raw_until(']');
  if (scanner_.error()) return *scanner_.error();
  if (!raw) return Error(ErrorCode::syntax_error, "expected ']' after the value of a constant").at(place);
  auto list = NestedList::parse(*raw, list_place);
  if (!list) return std::move(list).error();
  literal.list = std::move(list).value();
  if (raw->size() <= kLongestKeptLiteral) literal.written = std::make_shared<const std::string>(*raw);
  literal.list_place = list_place;
  A3D_TRY(expect("]", "after the value of a constant"));
  return make(place, std::move(literal));
}

Result<ExpressionPtr> ExpressionParser::function_literal() {
  const SourcePlace place = scanner_.take().place;
  if (scanner_.peek().is_name()) return make(place, FunctionReference{scanner_.take().text});
  A3D_TRY(expect("(", "or the name of a function object after 'fun'"));
  FunctionLiteral function;
  while (!at(")")) {
    const SourcePlace parameter_place = scanner_.peek().place;
    A3D_ASSIGN(std::string parameter, name("a parameter name"));
    if (means_implicit_parameter(parameter))
      return Error(ErrorCode::reserved_name, "'{}' stands for an implicit parameter and cannot name another one",
                   parameter)
          .at(parameter_place);
    if (is_reserved(parameter))
      return Error(ErrorCode::reserved_name, "'{}' is a word of the language and cannot name a parameter", parameter)
          .at(parameter_place);
    A3D_TRY(expect(":", "after the parameter '" + parameter + "'"));
    A3D_ASSIGN(TypeSyntax parameter_type, type());
    function.parameters.push_back({std::move(parameter), std::move(parameter_type)});
    if (!accept(",")) break;
  }
  A3D_TRY(expect(")", "to close the parameters"));
  A3D_ASSIGN(function.body, expression());
  return make(place, std::move(function));
}

}  // namespace queries
