#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/registry/registry.h"
#include "queries/language/scanner.h"
#include "queries/language/syntax_tree.h"

namespace queries {

using algebra3d::Result;
using algebra3d::Status;

/// Recursive descent over one scanner. Grammar: language.md 3.2 to 3.5 with conventional precedence (docs/language.md).
/// Depth is limited by kMaxExpressionDepth.
class ExpressionParser {
 public:
  ExpressionParser(Scanner& scanner, const algebra3d::Registry& registry) : scanner_(scanner), registry_(registry) {}

  Result<ExpressionPtr> expression() { return binary(1); }
  Result<TypeSyntax> type();

  // Also used for commands.
  bool at(std::string_view spelling) { return scanner_.peek().is(spelling); }
  bool accept(std::string_view spelling);
  Status expect(std::string_view spelling, std::string_view context);
  /// Any word, as a name; `what` is for the message ("an attribute name").
  Result<std::string> name(std::string_view what);
  Status expect_end();
  /// "expected WHAT, found TOKEN" at the next token.
  algebra3d::Error unexpected(std::string_view what);
  Scanner& scanner() { return scanner_; }

 private:
  using Place = algebra3d::SyntaxPattern::Place;

  Result<ExpressionPtr> binary(int lowest_precedence);
  Result<ExpressionPtr> chain();
  Result<std::vector<ExpressionPtr>> operands();
  Result<ExpressionPtr> primary();
  Result<ExpressionPtr> word_primary();
  Result<ExpressionPtr> signed_number();
  Result<ExpressionPtr> list();
  Result<ExpressionPtr> typed_literal();
  Result<ExpressionPtr> function_literal();
  Result<ExpressionPtr> prefix_application(const algebra3d::Operator& op);
  Result<ExpressionPtr> function_call(std::string function, SourcePlace place);
  Status postfix_application(const algebra3d::Operator& op, std::vector<ExpressionPtr>& operands);
  Status annotation(ExpressionPtr& operand);

  Status places(const algebra3d::SyntaxPattern& pattern, std::string_view close, std::vector<Argument>& arguments);
  Result<Argument> argument(const Place& place);
  Status attribute_names(Argument& argument, bool with_order);
  Status function_list(Argument& argument);
  Status rename_list(Argument& argument);
  Result<TypeSyntax> bracketed_type();
  Result<TypeSyntax> nested_type();

  bool starts_operand();
  const algebra3d::Operator* operator_at(algebra3d::SyntaxPattern::Shape shape);
  algebra3d::Error not_an_operator(const ExpressionPtr& second);
  ExpressionPtr make(SourcePlace place, ExpressionNode node) const;
  Status deeper();
  Status check_height(const Expression& expression) const;

  Scanner& scanner_;
  const algebra3d::Registry& registry_;
  int depth_ = 0;
};

}  // namespace queries
