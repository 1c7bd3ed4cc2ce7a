#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"
#include "queries/language/scanner.h"
#include "queries/language/session_parameters.h"
#include "queries/language/syntax_tree.h"

namespace queries {

using algebra3d::Result;
using algebra3d::Status;

/// A recursive-descent parser of expressions. The grammar is SECONDO's, with the precedence of docs/language.md,
/// "Precedence". Depth is limited by kMaxBracketDepth.
///
/// Names of operators are not reserved, so that a new operator breaks no script and no database. The position of a word
/// decides what it is, independent of the objects in the database:
/// - Where an operand begins (at the beginning, after an infix operator, a bracket, a comma) a word is a name, or with
///   `(` behind it a call. A call of a prefix operator's name is an Application with `is_call`: the checker gives it to
///   a function of that name if the parameters take the arguments.
/// - After an operand the name of an infix operator is that operator, unless it may be called and a comma in
/// parentheses
///   behind it says that it is: `a intersection (b)`, but `R intersection(a, b) ...`; so is the name of a postfix
///   operator if it has enough operands before it. Any other word is a further operand of a following postfix operator.
/// - A word in backquotes is a name wherever it stands. Words of the language are reserved (is_reserved).
class ExpressionParser {
 public:
  /// `parameters`: the values of `$name`; null for none.
  ExpressionParser(Scanner& scanner, const algebra3d::Registry& registry, const SessionParameters* parameters = nullptr)
      : scanner_(scanner), registry_(registry), parameters_(parameters) {}

  Result<ExpressionPtr> expression() { return binary(1); }
  Result<TypeSyntax> type();

  // Also used for commands.
  bool at(std::string_view spelling) { return scanner_.peek().is(spelling); }
  bool accept(std::string_view spelling);
  Status expect(std::string_view spelling, std::string_view context);
  /// Reads a word, also one in backquotes, as a name; `what` is for the message ("an attribute name").
  Result<std::string> name(std::string_view what);
  Status expect_end();
  /// The error "expected WHAT, found TOKEN" at the next token.
  algebra3d::Error unexpected(std::string_view what);
  Scanner& scanner() { return scanner_; }
  const SessionParameters* parameters() const { return parameters_; }

 private:
  using Place = algebra3d::SyntaxPattern::Place;

  Result<ExpressionPtr> binary(int lowest_precedence);
  Result<ExpressionPtr> chain();
  Result<ExpressionPtr> negation();
  Result<std::vector<ExpressionPtr>> operands();
  Result<ExpressionPtr> primary();
  Result<ExpressionPtr> word_primary();
  Result<ExpressionPtr> signed_number();
  Result<ExpressionPtr> list();
  Result<ExpressionPtr> typed_literal();
  Result<ExpressionPtr> function_literal();
  Result<ExpressionPtr> name_or_call(const Token& token);
  Result<ExpressionPtr> prefix_application(const algebra3d::Operator& op, SourcePlace place);
  Result<ExpressionPtr> function_call(std::string function, SourcePlace place);
  Result<ExpressionPtr> call_of_operator(const algebra3d::Operator& op, const SourcePlace& place);
  Status postfix_application(const algebra3d::Operator& op, std::vector<ExpressionPtr>& operands);
  Status annotation(ExpressionPtr& operand);

  Status places(const algebra3d::Operator& op, std::string_view close, std::vector<Argument>& arguments);
  Result<Argument> argument(const Place& place);
  Status attribute_names(Argument& argument, bool with_order);
  Status function_list(Argument& argument);
  Status rename_list(Argument& argument);
  Result<TypeSyntax> bracketed_type();
  Result<TypeSyntax> nested_type();

  bool starts_operand();
  const algebra3d::Operator* operator_at(algebra3d::SyntaxPattern::Shape shape);
  const algebra3d::Operator* postfix_operator_at(std::size_t operand_count);
  /// After an operand: the infix operator there, if it is not a call of it.
  const algebra3d::Operator* infix_operator_at();
  /// After an operand: whether `intersection(a, b)` is a call, which is known by the comma.
  bool at_call_of_infix();
  /// Whether brackets begin that hold no constant, so arguments.
  bool at_argument_brackets();
  /// Refuses arguments behind a postfix operator without brackets that was just read.
  Status check_no_arguments(const algebra3d::Operator& op, const Token& word);
  /// The error of `unexpected` in an application of an operator, with the form in which it is written.
  algebra3d::Error unexpected_in(const algebra3d::Operator& op, std::string_view what);
  void suspect_operator(std::size_t operand_count);
  algebra3d::Error not_an_operator(const ExpressionPtr& second);
  ExpressionPtr make(SourcePlace place, ExpressionNode node) const;
  Status deeper();
  Status check_height(const Expression& expression) const;

  Scanner& scanner_;
  const algebra3d::Registry& registry_;
  const SessionParameters* parameters_;
  int depth_ = 0;
  /// The likely mistake if two operands are adjacent: the first name of an operator that was read as an operand.
  std::optional<algebra3d::Error> suspicion_;
};

}  // namespace queries
