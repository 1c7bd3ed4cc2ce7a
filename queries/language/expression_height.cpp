// How high the tree below an expression is.
#include <algorithm>

#include "queries/language/syntax_tree.h"

namespace queries {
namespace {

int height_of(const ExpressionPtr& expression) {
  return expression == nullptr ? 0 : expression->height;
}

// Recursion follows the nesting of the type, which the parser bounds. NOLINTNEXTLINE(misc-no-recursion)
int height_of(const TypeSyntax& type) {
  int height = height_of(type.type_of);
  for (const TypeSyntax& argument : type.arguments) height = std::max(height, height_of(argument));
  for (const auto& [name, attribute] : type.attributes) height = std::max(height, height_of(attribute));
  return height;
}

int below(const TypedLiteral& literal) {
  return height_of(literal.type);
}
int below(const Application& application) {
  int height = 0;
  for (const Argument& argument : application.arguments) {
    height = std::max(height, height_of(argument.value));
    for (const NamedExpression& function : argument.functions) height = std::max(height, height_of(function.value));
  }
  return height;
}
int below(const FunctionCall& call) {
  int height = 0;
  for (const ExpressionPtr& argument : call.arguments) height = std::max(height, height_of(argument));
  return height;
}
int below(const ListExpression& list) {
  int height = 0;
  for (const ListExpression::Item& item : list.items)
    height = std::max({height, height_of(item.value), height_of(item.modifier)});
  return height;
}
int below(const FunctionLiteral& function) {
  int height = height_of(function.body);
  for (const auto& [name, type] : function.parameters) height = std::max(height, height_of(type));
  return height;
}
template <typename Leaf>
int below(const Leaf& /*leaf*/) {
  return 0;
}

}  // namespace

int height_below(const ExpressionNode& node) {
  return std::visit([](const auto& content) { return below(content); }, node);
}

}  // namespace queries
