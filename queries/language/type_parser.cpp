// The part of the parser that reads types.
#include "base/propagate.h"
#include "queries/language/expression_parser.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;

TypeSyntax syntax_of(const TypeExpr& type, const SourcePlace& place) {
  TypeSyntax syntax;
  syntax.name = type.name();
  syntax.place = place;
  for (const TypeExpr& argument : type.arguments()) syntax.arguments.push_back(syntax_of(argument, place));
  for (const auto& [name, attribute] : type.attributes())
    syntax.attributes.push_back({name, syntax_of(attribute, place)});
  return syntax;
}

}  // namespace

Result<TypeSyntax> ExpressionParser::type() {
  if (at("(")) return nested_type();
  if (at("[")) return bracketed_type();
  TypeSyntax syntax;
  syntax.place = scanner_.peek().place;
  if (accept("typeOf")) {
    A3D_TRY(expect("(", "after typeOf"));
    A3D_ASSIGN(syntax.type_of, expression());
    A3D_TRY(expect(")", "to close typeOf"));
    return syntax;
  }
  A3D_ASSIGN(syntax.name, name("a type"));
  if (!accept("(")) return syntax;
  ++depth_;
  A3D_TRY(deeper());
  do {
    A3D_ASSIGN(TypeSyntax argument, type());
    syntax.arguments.push_back(std::move(argument));
  } while (accept(","));
  --depth_;
  A3D_TRY(expect(")", "to close the arguments of the type '" + syntax.name + "'"));
  // tuple([A: int]) is a tuple with attributes, not a term over a list.
  if (syntax.name == "tuple" && syntax.arguments.size() == 1 && !syntax.arguments[0].attributes.empty())
    return std::move(syntax.arguments[0]);
  return syntax;
}

// `[Name: T, ...]`: the attributes of a tuple.
Result<TypeSyntax> ExpressionParser::bracketed_type() {
  TypeSyntax syntax;
  syntax.name = "tuple";
  syntax.place = scanner_.take().place;
  ++depth_;
  A3D_TRY(deeper());
  do {
    A3D_ASSIGN(std::string attribute, name("an attribute name"));
    A3D_TRY(expect(":", "after the attribute '" + attribute + "'"));
    A3D_ASSIGN(TypeSyntax attribute_type, type());
    syntax.attributes.push_back({std::move(attribute), std::move(attribute_type)});
  } while (accept(","));
  --depth_;
  A3D_TRY(expect("]", "to close the attributes"));
  return syntax;
}

Result<TypeSyntax> ExpressionParser::nested_type() {
  const SourcePlace place = scanner_.peek().place;
  const auto raw = scanner_.take_raw_list();
  if (scanner_.error()) return *scanner_.error();
  if (!raw) return Error(ErrorCode::syntax_error, "expected ')' to close the type").at(place);
  auto list = NestedList::parse(*raw, place);
  if (!list) return std::move(list).error();
  auto parsed = TypeExpr::from_nested(*list);
  if (!parsed) return std::move(parsed).error().at(place);
  return syntax_of(*parsed, place);
}

}  // namespace queries
