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

/// The error of an operator that is written in another form, with the right one.
Error with_form(Error error, const Operator& op) {
  error.message += fmt::format(" (syntax: {})", op.written());
  return error;
}

/// Operators of other languages, and ours that do the same under other names.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOperatorsOfOthers = {{
    {"within", "'inside' or 'withinDistance'"},
    {"where", "'filter'"},
    {"subtract", "'minus'"},
    {"xor", "'#' or 'symmetricDifference'"},
}};

bool is_sql(std::string_view word) {
  return word == "select" || word == "SELECT" || word == "Select";
}

}  // namespace

std::string did_you_mean(std::string_view word, const algebra3d::Registry& registry) {
  for (const auto& [other, ours] : kOperatorsOfOthers)
    if (algebra3d::is_equal_but_for_case(word, other)) return fmt::format(", did you mean {}?", ours);
  for (const Operator* op : registry.operators())
    if (word == op->host_name && word != op->name) return fmt::format(", did you mean '{}'?", op->name);
  const std::string suggestion = registry.suggestion(word);
  return suggestion.empty() ? "" : fmt::format(", did you mean '{}'?", suggestion);
}

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

bool ExpressionParser::at_argument_brackets() {
  return at("[") && !scanner_.peek(1).is("const");
}

Error ExpressionParser::unexpected_in(const Operator& op, std::string_view what) {
  Error error = unexpected(what);
  const bool is_about_token = !scanner_.error() && written_here(scanner_.peek()).empty();
  return is_about_token ? with_form(std::move(error), op) : error;
}

// The brackets of `R count[A]` and `R count()` are not operands; those of `R feed(A)` may be, if a blank is left out.
Status ExpressionParser::check_no_arguments(const Operator& op, const Token& word) {
  if (!at("(") && !at_argument_brackets()) return {};
  const Token& next = scanner_.peek();
  Error error =
      with_form(Error(ErrorCode::syntax_error, "{}: expected no arguments behind it, found {}", op.name, next.shown())
                    .at(next.place),
                op);
  if (next.is("[") || scanner_.peek(1).is(")")) return error;
  if (next.begin == word.begin + word.text.size() && !suspicion_) suspicion_ = std::move(error);
  return {};
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
    suspicion_ = with_form(
        Error(ErrorCode::syntax_error, "expected '(' after the operator '{}', found {}", op->name, next.shown())
            .at(next.place),
        *op);
    return;
  }
  if (op->also_prefix && scanner_.peek(1).is("(")) return;
  const std::size_t expected = pattern.shape == Shape::infix ? 1 : pattern.operand_count;
  suspicion_ = with_form(Error(ErrorCode::syntax_error, "{}: expected {} operand{} before it, found {}", op->name,
                               expected, expected == 1 ? "" : "s", operand_count)
                             .at(word.place),
                         *op);
}

// Two operands with nothing between them: the second is most likely a misspelt operator.
Error ExpressionParser::not_an_operator(const ExpressionPtr& second) {
  if (scanner_.error()) return *scanner_.error();
  std::string message = "expected an operator between two operands";
  std::string word;
  if (const auto* application = std::get_if<Application>(&second->node);
      application != nullptr && application->is_call) {
    const Operator& op = *registry_.find_operator(application->name);
    return with_form(Error(ErrorCode::syntax_error, "{} before the call of '{}'", message, op.name).at(second->place),
                     op);
  }
  if (const auto* use = std::get_if<NameUse>(&second->node)) word = use->name;
  if (const auto* call = std::get_if<FunctionCall>(&second->node)) word = call->name;
  if (std::holds_alternative<ListExpression>(second->node))
    message = "expected an operator before '[': brackets hold the arguments of an operator that takes some";
  if (word.empty()) return Error(ErrorCode::syntax_error, message).at(second->place);
  message = "unknown operator '" + word + "'" + did_you_mean(word, registry_);
  return Error(ErrorCode::unknown_name, message).at(second->place);
}

}  // namespace queries
