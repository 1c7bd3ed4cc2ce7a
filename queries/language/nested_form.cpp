// The nested-list form of parsed expressions.
#include "queries/language/syntax_tree.h"

namespace queries {
namespace {

using PlaceKind = algebra3d::SyntaxPattern::PlaceKind;

NestedList symbol(std::string name) {
  return NestedList::symbol(std::move(name));
}

NestedList parameter_symbol(int parameter) {
  return symbol("tuple" + std::to_string(parameter));
}

NestedList nested(const Literal& literal) {
  return literal.atom;
}
NestedList nested(const TypedLiteral& literal) {
  return NestedList::list(symbol("const"), to_nested(literal.type), symbol("value"), literal.list);
}
// A stored function keeps the value, not the name.
NestedList nested(const HostValue& given) {
  return NestedList::list(symbol("const"), given.value.type().term().to_nested(), symbol("value"),
                          given.value.to_nested());
}
NestedList nested(const NameUse& use) {
  return symbol(use.name);
}
NestedList nested(const AttributeUse& use) {
  return NestedList::list(symbol("attr"), parameter_symbol(use.parameter), symbol(use.name));
}
NestedList nested(const ParameterUse& use) {
  return parameter_symbol(use.parameter);
}
NestedList nested(const FunctionReference& reference) {
  return symbol(reference.name);
}

// In brackets `(vec)` is read as `vec`, so a call that looks like it is written `((now))`.
bool is_call_without_arguments(const Expression& expression) {
  const auto* call = std::get_if<FunctionCall>(&expression.node);
  return call != nullptr && call->arguments.empty();
}

NestedList nested(const Argument& argument) {
  if (argument.misread) return to_nested(*argument.as_operand);
  NestedList::List items;
  switch (argument.kind) {
    case PlaceKind::value:
    case PlaceKind::function:
      return is_call_without_arguments(*argument.value) ? NestedList::list(to_nested(*argument.value))
                                                        : to_nested(*argument.value);
    case PlaceKind::attribute:
    case PlaceKind::name:
      return symbol(argument.names.front());
    case PlaceKind::attributes:
      for (const std::string& name : argument.names) items.push_back(symbol(name));
      break;
    case PlaceKind::keys:
    case PlaceKind::renames:
      for (std::size_t i = 0; i < argument.names.size(); ++i)
        items.push_back(NestedList::list(symbol(argument.names[i]), symbol(argument.modifiers[i])));
      break;
    case PlaceKind::functions:
      for (const auto& [name, value] : argument.functions)
        items.push_back(NestedList::list(symbol(name), to_nested(*value)));
      break;
  }
  return NestedList(std::move(items));
}

NestedList nested(const Application& application) {
  NestedList::List items = {symbol(application.name)};
  for (const Argument& argument : application.arguments) items.push_back(nested(argument));
  return NestedList(std::move(items));
}

NestedList nested(const FunctionCall& call) {
  NestedList::List items = {symbol(call.name)};
  for (const ExpressionPtr& argument : call.arguments) items.push_back(to_nested(*argument));
  return NestedList(std::move(items));
}

// A list of one expression is that expression, and `(x)` would be a call.
NestedList nested(const ListExpression& list) {
  if (list.items.size() == 1 && list.items[0].name.empty() && list.items[0].modifier == nullptr)
    return to_nested(*list.items[0].value);
  NestedList::List items;
  for (const ListExpression::Item& item : list.items) {
    NestedList element = to_nested(*item.value);
    if (!item.name.empty()) element = NestedList::list(symbol(item.name), std::move(element));
    if (item.modifier != nullptr) element = NestedList::list(std::move(element), to_nested(*item.modifier));
    items.push_back(std::move(element));
  }
  return NestedList(std::move(items));
}

NestedList nested(const FunctionLiteral& function) {
  NestedList::List items = {symbol("fun")};
  for (const auto& [name, type] : function.parameters) items.push_back(NestedList::list(symbol(name), to_nested(type)));
  items.push_back(to_nested(*function.body));
  return NestedList(std::move(items));
}

}  // namespace

TypedLiteral file_literal(NestedList atom, SourcePlace place) {
  TypedLiteral literal;
  literal.type.name = "text";
  literal.type.place = std::move(place);
  literal.list = std::move(atom);
  return literal;
}

NestedList to_nested(const Expression& expression) {
  return std::visit([](const auto& node) { return nested(node); }, expression.node);
}

NestedList to_nested(const TypeSyntax& type) {
  if (type.type_of != nullptr) return NestedList::list(symbol("typeOf"), to_nested(*type.type_of));
  if (!type.attributes.empty()) {
    NestedList::List attributes;
    for (const auto& [name, attribute] : type.attributes)
      attributes.push_back(NestedList::list(symbol(name), to_nested(attribute)));
    return NestedList::list(symbol("tuple"), NestedList(std::move(attributes)));
  }
  if (type.arguments.empty()) return symbol(type.name);
  NestedList::List items = {symbol(type.name)};
  for (const TypeSyntax& argument : type.arguments) items.push_back(to_nested(argument));
  return NestedList(std::move(items));
}

}  // namespace queries
