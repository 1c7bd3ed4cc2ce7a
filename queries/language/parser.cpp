#include "queries/language/parser.h"

#include <algorithm>
#include <array>

#include "algebra3d/values/types/expression_list.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"
#include "queries/language/detail/command_parser.h"
#include "queries/language/expression_parser.h"
#include "queries/language/nested_reader.h"
#include "queries/language/scanner.h"

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
  TextInput(Scanner& scanner, const Registry& registry, const SessionParameters* parameters)
      : parser_(scanner, registry, parameters) {}

  bool at(std::string_view spelling) override { return parser_.at(spelling); }
  void skip() override { parser_.scanner().take(); }
  Result<std::string> name(std::string_view what) override { return parser_.name(what); }
  Result<std::string> word_or_text(std::string_view what) override {
    const Token& next = parser_.scanner().peek();
    if (next.kind == Token::Kind::constant) return parameter_text(parser_.parameters(), parser_.scanner().take());
    if (!next.is_name() && next.kind != Token::Kind::string && next.kind != Token::Kind::text)
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

bool begins_command_or_ends(const Token& word) {
  if (word.kind != Token::Kind::word) return false;
  return CommandParser::begins_command(word.text) || word.text == "quit" || word.text == "exit" || word.text == "help";
}

bool ends_operand(const Token& token) {
  return token.kind != Token::Kind::special || token.text == ")" || token.text == "]" || token.text == "}";
}

// Whether the message is about something that stands where nothing was expected.
bool is_of_surplus(std::string_view message) {
  return message.starts_with("expected the end of the command") || message.starts_with("expected an operator") ||
         message.starts_with("unknown operator") || message.starts_with("expected '(' after the operator") ||
         message.find(" before it, found ") != std::string_view::npos;
}

// A `;` that is missing belongs behind what comes before the next command, which is where the error shows.
Error with_missing_semicolon(Error error, std::string_view text, const SourcePlace& start) {
  if (!is_of_surplus(error.text())) return error;
  Scanner scanner(text, start);
  Token before;
  int depth = 0;
  for (Token token = scanner.take(); token.kind != Token::Kind::end; token = scanner.take()) {
    const bool is_there = token.place.line == error.place.line && token.place.column == error.place.column;
    if (is_there) {
      if (depth != 0 || before.end == 0 || !ends_operand(before) || !begins_command_or_ends(token)) return error;
      return Error(error.code, "expected ';' at the end of the command: '{}'{} begins another one", token.text,
                   token.place.line == before.place.line ? "" : fmt::format(" in line {}", token.place.line))
          .at(algebra3d::place_behind(text.substr(0, before.end), start));
    }
    if (token.is("(") || token.is("[") || token.is("{")) ++depth;
    if (token.is(")") || token.is("]") || token.is("}")) --depth;
    before = std::move(token);
  }
  return error;
}

}  // namespace

Error too_high(const SourcePlace& place) {
  return Error(ErrorCode::limit_exceeded,
               "the expression is more than {} levels high (brackets, or operators in a row); split it with let",
               kMaxExpressionHeight)
      .at(place);
}

// A command never begins with a parenthesis, so one that does is a nested list.
Result<Command> parse_command(std::string_view text, const Registry& registry, const SourcePlace& start,
                              const SessionParameters* parameters) {
  A3D_TRY(check_text(text, start));
  if (is_nested_list(text)) {
    A3D_ASSIGN(const NestedList list, algebra3d::parse_expression_list(text, start));
    return command_of(list, registry, start);
  }
  Scanner scanner(text, start);
  TextInput input(scanner, registry, parameters);
  auto command = CommandParser(input).parse();
  if (!command) return with_missing_semicolon(std::move(command).error(), text, start);
  return command;
}

Result<ExpressionPtr> parse_expression(std::string_view text, const Registry& registry, const SourcePlace& start) {
  A3D_TRY(check_text(text, start));
  Scanner scanner(text, start);
  ExpressionParser parser(scanner, registry);
  A3D_ASSIGN(ExpressionPtr expression, parser.expression());
  A3D_TRY(parser.expect_end());
  return expression;
}

bool means_implicit_parameter(std::string_view word) {
  if (word == "tuple" || word == "group") return true;
  return word.size() == 6 && word.starts_with("tuple") && word.back() >= '1' && word.back() <= '9';
}

bool is_reserved(std::string_view word) {
  return std::ranges::find(kReservedWords, word) != kReservedWords.end() || means_implicit_parameter(word);
}

algebra3d::Status check_object_name(std::string_view name, std::string_view what) {
  if (!is_identifier(name))
    return Error{ErrorCode::wrong_usage, "'{}' cannot name {}: a name is a letter, followed by letters, digits and _",
                 name, what};
  if (is_reserved(name))
    return Error{ErrorCode::reserved_name, "'{}' is a word of the language and cannot name {}", name, what};
  return {};
}

std::string no_operand_text(std::string_view word) {
  const std::string_view what =
      word == "typeOf" ? "which stands for a type, as in [const typeOf(E) value L]" : "a word of the language";
  return fmt::format("expected an operand, found '{}', {}", word, what);
}

}  // namespace queries
