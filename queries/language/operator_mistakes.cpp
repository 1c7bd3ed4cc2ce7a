// Messages of the parser where something other than an operator, or an operator of another language, is written.

#include "queries/language/expression_parser.h"

#include <algorithm>
#include <array>
#include <utility>

#include "queries/language/parser.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using algebra3d::SyntaxPattern;
using Kind = Token::Kind;
using Shape = SyntaxPattern::Shape;

namespace {

// The operator of ours for one of other languages.
std::string_view written_here(const Token& token) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kOperators = {{
      {"==", "'=' for equality"},
      {"!=", "'#' for inequality"},
      {"<>", "'#' for inequality"},
      {"=>", "'>='"},
      {"=<", "'<='"},
      {"&&", "'and'"},
      {"&", "'and'"},
      {"||", "'or'"},
      {"!", "'not(...)'"},
      {"~", "'not(...)'"},
      {"%", "'mod'"},
  }};
  if (token.kind != Kind::special) return "";
  const auto* const row = std::ranges::find(kOperators, token.text, [](const auto& entry) { return entry.first; });
  return row == kOperators.end() ? "" : row->second;
}

bool is_sql(std::string_view word) {
  return word == "select" || word == "SELECT" || word == "Select";
}

}  // namespace

Error ExpressionParser::unexpected(std::string_view what) {
  const Token& token = scanner_.peek();
  if (scanner_.error()) return *scanner_.error();
  if (const std::string_view right = written_here(token); !right.empty())
    return Error(ErrorCode::syntax_error, "there is no operator '{}'; write {}", token.text, right).at(token.place);
  const bool has_dot = token.kind == Kind::attribute && what.find("attribute name") != std::string_view::npos;
  return Error(ErrorCode::syntax_error, "expected {}, found {}{}", what, token.shown(),
               has_dot ? "; it stands without a dot here" : "")
      .at(token.place);
}

// Called where an operand begins.
void ExpressionParser::suspect_operator(std::size_t operand_count) {
  const Token& word = scanner_.peek();
  if (word.kind == Kind::word && !suspicion_ && is_sql(word.text))
    suspicion_ =
        Error(ErrorCode::syntax_error, "there is no '{}' here; {}", word.text, kInsteadOfSelect).at(word.place);
  const Operator* op = word.kind == Kind::word && !suspicion_ ? registry_.find_operator(word.text) : nullptr;
  if (op == nullptr) return;
  const SyntaxPattern& pattern = registry_.syntax(*op);
  if (pattern.shape == Shape::prefix) {
    const Token& next = scanner_.peek(1);
    if (next.is("(") || scanner_.error()) return;
    suspicion_ =
        Error(ErrorCode::syntax_error, "expected '(' after the operator '{}', found {}", op->name, next.shown())
            .at(next.place);
    return;
  }
  const std::size_t expected = pattern.shape == Shape::infix ? 1 : pattern.operand_count;
  suspicion_ = Error(ErrorCode::syntax_error, "{}: expected {} operand{} before it, found {} (syntax: {})", op->name,
                     expected, expected == 1 ? "" : "s", operand_count, op->syntax)
                   .at(word.place);
}

// Two operands with nothing between them: the second is most likely a misspelt operator.
Error ExpressionParser::not_an_operator(const ExpressionPtr& second) {
  if (scanner_.error()) return *scanner_.error();
  std::string message = "expected an operator between two operands";
  std::string word;
  if (const auto* use = std::get_if<NameUse>(&second->node)) word = use->name;
  if (const auto* call = std::get_if<FunctionCall>(&second->node)) word = call->name;
  if (std::holds_alternative<ListExpression>(second->node))
    message = "expected an operator before '[': brackets hold the arguments of an operator that takes some";
  if (word.empty()) return Error(ErrorCode::syntax_error, message).at(second->place);
  message = "unknown operator '" + word + "'";
  const std::string suggestion = registry_.suggestion(word);
  if (!suggestion.empty()) message += ", did you mean '" + suggestion + "'?";
  return Error(ErrorCode::unknown_name, message).at(second->place);
}

}  // namespace queries
