#include "queries/language/parser.h"

#include <algorithm>
#include <array>

#include "algebra3d/types/expression_list.h"
#include "algebra3d/types/utf8.h"
#include "queries/language/command_parser.h"
#include "queries/language/expression_parser.h"
#include "queries/language/nested_reader.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Registry;

constexpr std::array<std::string_view, 53> kReservedWords = {
    "fun",      "const",     "tuple",        "group",     "type",        "typeOf",   "delete",     "create",
    "update",   "kill",      "query",        "querynt",   "pquery",      "pcompile", "changename", "let",
    "let_",     "derive",    "persistent",   "begin",     "transaction", "commit",   "abort",      "database",
    "open",     "close",     "save",         "to",        "restore",     "from",     "list",       "algebras",
    "algebra",  "databases", "constructors", "operators", "types",       "objects",  "counters",   "value",
    "pointer",  "memory",    "if",           "then",      "else",        "endif",    "while",      "do",
    "endwhile", "TRUE",      "FALSE",        "asc",       "desc"};

/// The words of a command as text.
class TextInput final : public CommandInput {
 public:
  TextInput(Scanner& scanner, const Registry& registry) : parser_(scanner, registry) {}

  bool at(std::string_view spelling) override { return parser_.at(spelling); }
  void skip() override { parser_.scanner().take(); }
  Result<std::string> name(std::string_view what) override { return parser_.name(what); }
  Result<std::string> word_or_text(std::string_view what) override {
    const Token::Kind kind = parser_.scanner().peek().kind;
    if (kind != Token::Kind::word && kind != Token::Kind::string && kind != Token::Kind::text)
      return parser_.unexpected(what);
    return parser_.scanner().take().text;
  }
  Result<ExpressionPtr> expression() override { return parser_.expression(); }
  Result<TypeSyntax> type() override { return parser_.type(); }
  bool is_at_end() override { return parser_.scanner().peek().kind == Token::Kind::end && !parser_.scanner().error(); }
  Result<std::unique_ptr<CommandInput>> part() override { return std::unique_ptr<CommandInput>(); }
  SourcePlace place() override { return parser_.scanner().peek().place; }
  std::string shown_word() override { return parser_.scanner().peek().text; }
  Error unexpected(std::string_view what) override { return parser_.unexpected(what); }

 private:
  ExpressionParser parser_;
};

bool is_nested_list(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '(';
}

// Asked once for all, so that nothing that a command holds can be anything but text.
algebra3d::Status check_text(std::string_view text, const SourcePlace& start) {
  const std::size_t wrong = algebra3d::first_no_text(text);
  if (wrong == std::string_view::npos) return {};
  return Error(ErrorCode::syntax_error, algebra3d::no_text_message(text[wrong]))
      .at(algebra3d::place_behind(text.substr(0, wrong), start));
}

}  // namespace

// A command never begins with a parenthesis, so one that does is a nested list.
Result<Command> parse_command(std::string_view text, const Registry& registry, const SourcePlace& start) {
  RETURN_IF_ERROR(check_text(text, start));
  if (is_nested_list(text)) {
    ASSIGN_OR_RETURN(const NestedList list, algebra3d::parse_expression_list(text, start));
    return command_of(list, registry, start);
  }
  Scanner scanner(text, start);
  TextInput input(scanner, registry);
  return CommandParser(input).parse();
}

Result<ExpressionPtr> parse_expression(std::string_view text, const Registry& registry, const SourcePlace& start) {
  RETURN_IF_ERROR(check_text(text, start));
  Scanner scanner(text, start);
  ExpressionParser parser(scanner, registry);
  ASSIGN_OR_RETURN(ExpressionPtr expression, parser.expression());
  RETURN_IF_ERROR(parser.expect_end());
  return expression;
}

bool means_implicit_parameter(std::string_view word) {
  if (word == "tuple" || word == "group") return true;
  return word.size() == 6 && word.starts_with("tuple") && word.back() >= '1' && word.back() <= '9';
}

bool is_reserved(std::string_view word, const Registry& registry) {
  return !why_reserved(word, registry).empty();
}

std::string_view why_reserved(std::string_view word, const Registry& registry) {
  if (registry.find_operator(word) != nullptr) return "an operator";
  const bool is_of_language = std::ranges::find(kReservedWords, word) != kReservedWords.end();
  return is_of_language || means_implicit_parameter(word) ? "a word of the language" : "";
}

std::string no_operand_text(std::string_view word, const Registry& registry) {
  const std::string_view what =
      word == "typeOf" ? "which stands for a type, as in [const typeOf(E) value L]" : why_reserved(word, registry);
  return fmt::format("expected an operand, found '{}', {}", word, what);
}

}  // namespace queries
