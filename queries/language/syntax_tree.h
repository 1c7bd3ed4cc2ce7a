#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/syntax_pattern.h"
#include "algebra3d/values/types/nested_list.h"
#include "algebra3d/values/types/type_expr.h"
#include "algebra3d/values/types/value.h"

namespace queries {

using algebra3d::NestedList;
using algebra3d::SourcePlace;
using algebra3d::TypeExpr;

struct Expression;
using ExpressionPtr = std::shared_ptr<const Expression>;

struct TypedName;

/// A type expression: a term whose leaves are names, or the type of an expression.
struct TypeSyntax {
  std::string name;
  std::vector<TypeSyntax> arguments;
  std::vector<TypedName> attributes;  ///< of a tuple
  ExpressionPtr type_of;              ///< typeOf(E); then the other members are empty
  SourcePlace place;
};

/// `Name: T`
struct TypedName {
  std::string name;
  TypeSyntax type;
};

/// `12`, `1.5`, `TRUE`, "string", 'text'.
struct Literal {
  NestedList atom;
};
/// `[const T value L]`
struct TypedLiteral {
  TypeSyntax type;
  NestedList list;
  std::shared_ptr<const std::string> written = nullptr;  ///< the list as text, to find positions in it; may be null
  SourcePlace list_place = {};                           ///< its beginning
};
/// `$name`: a value from the host of the session (session_parameters.h).
struct HostValue {
  algebra3d::Value value;
  std::string reason;  ///< why the value is undefined, if the host knows; reported at each use

  // NOLINTNEXTLINE(google-explicit-constructor): a value alone is enough
  HostValue(algebra3d::Value its_value, std::string its_reason = {})
      : value(std::move(its_value)), reason(std::move(its_reason)) {}
};
/// The literal for a file atom (file_atom.h): the content of the file, which is read when the literal is checked.
TypedLiteral file_literal(NestedList atom, SourcePlace place);
/// An object, or a parameter of an explicit function.
struct NameUse {
  std::string name;
};
/// `.Name` (parameter 1), `..Name` (2), `$n.Name`: of the innermost implicit function.
struct AttributeUse {
  int parameter = 1;
  std::string name;
};
/// `.`, `..`, `$n`, `tuple`, `group`.
struct ParameterUse {
  int parameter = 1;
};
/// One `Name: expression` of a function list.
struct NamedExpression {
  std::string name;
  ExpressionPtr value;
};
/// The argument at one place of an operator's syntax pattern. The kind of the place says which members are set.
struct Argument {
  algebra3d::SyntaxPattern::PlaceKind kind = algebra3d::SyntaxPattern::PlaceKind::value;
  ExpressionPtr value;                     ///< value, function
  std::vector<NamedExpression> functions;  ///< functions
  std::vector<std::string> names;          ///< attribute, name, attributes, keys, renames (the new names)
  std::vector<std::string> modifiers;      ///< keys: asc or desc; renames: the old names
  SourcePlace place;
  /// In a nested list, where names are expected: the argument read as an operand, for a function with the operator's
  /// name. May be null.
  ExpressionPtr as_operand;
  /// The error, if the argument is not what the operator expects; then only `as_operand` is set.
  std::optional<algebra3d::Error> misread;
};
/// An operator with its arguments in the order of its pattern.
struct Application {
  std::string name;
  std::vector<Argument> arguments;
  /// Written `name(...)`, or in a nested list: a function of this name is preferred if its parameters fit the
  /// arguments.
  bool is_call = false;
};
/// `name(e1, e2)` where name is not a prefix operator or is in backquotes: a call of a function object or parameter.
struct FunctionCall {
  std::string name;
  std::vector<ExpressionPtr> arguments;
};
/// `[e1, Name: e2, A asc]`
struct ListExpression {
  struct Item {
    std::string name;
    ExpressionPtr value;
    ExpressionPtr modifier;  ///< the second of two adjacent expressions, or null
  };
  std::vector<Item> items;
};
/// `fun(p1: T1, p2: T2) E`
struct FunctionLiteral {
  std::vector<TypedName> parameters;
  ExpressionPtr body;
};
/// `fun Name`
struct FunctionReference {
  std::string name;
};

using ExpressionNode = std::variant<Literal, TypedLiteral, HostValue, NameUse, AttributeUse, ParameterUse, Application,
                                    FunctionCall, ListExpression, FunctionLiteral, FunctionReference>;

/// A parsed expression, without types and objects. Immutable.
struct Expression {
  SourcePlace place;
  ExpressionNode node;
  int height = 1;  ///< height of the tree below this node, including it
};

/// Height of the highest child of a node; 0 if there is none.
int height_below(const ExpressionNode& node);

/// The nested-list form of an expression, `(op a b)`.
NestedList to_nested(const Expression& expression);
NestedList to_nested(const TypeSyntax& type);

}  // namespace queries
