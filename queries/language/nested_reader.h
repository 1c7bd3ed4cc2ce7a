#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/registry/registry.h"
#include "queries/language/command.h"

namespace queries {

/// Reads expressions and types in their nested-list form, `(count (filter (feed R) (fun (t TUPLE) (> (attr t A) 3))))`:
/// the inverse of `to_nested`. Nested lists do not know where their parts stood, so every error and every node has the
/// place of the whole. Trees are limited in height as those of texts (kMaxExpressionHeight).
///
/// The first symbol of a list is what is called, any other is a name: so objects and parameters may have the names of
/// operators. Arguments of an operator are read by its pattern and, where that expects names, as operands too, since
/// only the checker knows if there is a function of that name.
class NestedReader {
 public:
  NestedReader(const algebra3d::Registry& registry, SourcePlace place)
      : registry_(registry), place_(std::move(place)) {}

  /// Errors: syntax_error with the part that is no expression, limit_exceeded.
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
  /// The number of an implicit parameter that is written as `tuple1`; 0 for any other symbol.
  int implicit_parameter(std::string_view name) const;
  bool is_type_head(const NestedList& head) const;
  algebra3d::Result<ExpressionPtr> make(ExpressionNode node) const;
  algebra3d::Error error(std::string_view expected, const NestedList& found) const;
  algebra3d::Error no_operand(const std::string& fraction) const;

  const algebra3d::Registry& registry_;
  const SourcePlace place_;
  std::vector<std::string> bound_;  // the parameters of the functions around
  int depth_ = 0;                   // nodes above, and this one
};

/// A command whose words and parts are the elements of a list, `(let n = (+ 1 2))`.
algebra3d::Result<Command> command_of(const NestedList& list, const algebra3d::Registry& registry,
                                      const SourcePlace& place);

}  // namespace queries
