#include "queries/language/used_names.h"

#include <algorithm>

namespace queries {
namespace {

// Recursion follows the height of the expression, which the parser bounds. NOLINTBEGIN(misc-no-recursion)
class Collector {
 public:
  void visit(const Expression& expression) {
    std::visit([this](const auto& node) { look_at(node); }, expression.node);
  }
  UsedNames take() { return std::move(used_); }

 private:
  void visit(const TypeSyntax& type) {
    if (!type.name.empty()) used_.types.insert(type.name);
    for (const TypeSyntax& argument : type.arguments) visit(argument);
    for (const auto& [name, attribute] : type.attributes) visit(attribute);
    if (type.type_of != nullptr) visit(*type.type_of);
  }
  void add(const std::string& name) {
    if (std::ranges::find(bound_, name) == bound_.end()) used_.objects.insert(name);
  }

  void look_at(const TypedLiteral& literal) { visit(literal.type); }
  void look_at(const NameUse& use) { add(use.name); }
  void look_at(const FunctionReference& reference) { add(reference.name); }
  void look_at(const FunctionCall& call) {
    add(call.name);
    for (const ExpressionPtr& argument : call.arguments) visit(*argument);
  }
  void look_at(const Application& application) {
    used_.operators.insert(application.name);
    if (application.is_call) used_.calls.insert(application.name);
    for (const Argument& argument : application.arguments) {
      if (argument.value != nullptr) visit(*argument.value);
      for (const NamedExpression& function : argument.functions) visit(*function.value);
    }
  }
  void look_at(const ListExpression& list) {
    for (const ListExpression::Item& item : list.items) visit(*item.value);
  }
  void look_at(const FunctionLiteral& function) {
    for (const auto& [name, type] : function.parameters) visit(type);
    const std::size_t bound_before = bound_.size();
    for (const auto& [name, type] : function.parameters) bound_.push_back(name);
    visit(*function.body);
    bound_.resize(bound_before);
  }
  template <typename Leaf>
  void look_at(const Leaf& /*leaf*/) {}

  UsedNames used_;
  std::vector<std::string> bound_;  // the parameters of the functions around
};
// NOLINTEND(misc-no-recursion)

}  // namespace

UsedNames used_names(const Expression& expression) {
  Collector collector;
  collector.visit(expression);
  return collector.take();
}

}  // namespace queries
