#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"
#include "queries/language/command.h"

namespace queries {

/// Parses expressions and types in nested-list form, `(count (filter (feed R) (fun (t TUPLE) (> (attr t A) 3))))`: the
/// inverse of `to_nested`. Nested lists have no positions, so every error and node has that of the whole list. The
/// height of trees is limited as in texts (kMaxExpressionHeight).
///
/// The first symbol of a list is called, all others are names, so objects and parameters may have names of operators.
/// Arguments are read by the operator's pattern and, where that expects names, also as operands, since only the checker
/// knows whether a function has this name.
class NestedReader {
 public:
  NestedReader(const algebra3d::Registry& registry, SourcePlace place)
      : registry_(registry), place_(std::move(place)) {}

  /// Reads an expression. Errors: syntax_error with the part that is not an expression, limit_exceeded.
  algebra3d::Result<ExpressionPtr> expression(const NestedList& list);
  algebra3d::Result<TypeSyntax> type(const NestedList& list);

 private:
  class Deeper;
  using Place = algebra3d::SyntaxPattern::Place;
  using List = NestedList::List;

  algebra3d::Result<ExpressionPtr> symbol(const std::string& name);
  algebra3d::Result<ExpressionPtr> application(const algebra3d::Operator& op, const List& items);
  algebra3d::Result<ExpressionPtr> function(const List& items);
  algebra3d::Result<ExpressionPtr> function_call(const List& items);
  algebra3d::Result<ExpressionPtr> constant(const NestedList& type, const NestedList& value);
  algebra3d::Result<ExpressionPtr> list_expression(const NestedList& list);
  const NestedList& in_brackets(const NestedList& item) const;
  algebra3d::Result<Argument> argument(const std::string& op, const Place& place, const NestedList& item);
  algebra3d::Status names_at(const std::string& op, const NestedList& item, Argument& argument);
  algebra3d::Status names(const std::string& op, const NestedList& item, Argument& argument) const;
  algebra3d::Status pairs(const std::string& op, const NestedList& item, Argument& argument) const;
  algebra3d::Status functions(const std::string& op, const NestedList& item, Argument& argument);
  /// The number of an implicit parameter such as `tuple1`; 0 for any other symbol.
  int implicit_parameter(std::string_view name) const;
  bool is_type_head(const NestedList& head) const;
  algebra3d::Result<ExpressionPtr> make(ExpressionNode node) const;
  algebra3d::Error error(std::string_view expected, const NestedList& found) const;
  algebra3d::Error no_operand(const std::string& fraction) const;

  const algebra3d::Registry& registry_;
  const SourcePlace place_;
  std::vector<std::string> bound_;  // the parameters of the enclosing functions
  int depth_ = 0;                   // number of enclosing nodes, with this one
};

/// Parses a command in nested-list form, `(let n = (+ 1 2))`.
algebra3d::Result<Command> command_of(const NestedList& list, const algebra3d::Registry& registry,
                                      const SourcePlace& place);

}  // namespace queries
