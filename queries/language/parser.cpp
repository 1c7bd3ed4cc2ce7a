#include "queries/language/parser.h"

#include <algorithm>
#include <array>
#include <optional>

#include "queries/language/expression_parser.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::Registry;

constexpr std::array<std::string_view, 53> kReservedWords = {
    "fun",      "const",     "tuple",        "group",     "type",        "typeOf",   "delete",     "create",
    "update",   "kill",      "query",        "querynt",   "pquery",      "pcompile", "changename", "let",
    "let_",     "derive",    "persistent",   "begin",     "transaction", "commit",   "abort",      "database",
    "open",     "close",     "save",         "to",        "restore",     "from",     "list",       "algebras",
    "algebra",  "databases", "constructors", "operators", "types",       "objects",  "counters",   "value",
    "pointer",  "memory",    "if",           "then",      "else",        "endif",    "while",      "do",
    "endwhile", "TRUE",      "FALSE",        "asc",       "desc"};

class CommandParser {
 public:
  CommandParser(Scanner& scanner, const Registry& registry) : parser_(scanner, registry) {}

  Result<Command> parse() {
    const Token first = parser_.scanner().peek();
    auto content = dispatch(first.text);
    if (!content) return std::move(content).error();
    RETURN_IF_ERROR(parser_.expect_end());
    return Command{first.place, std::move(content).value()};
  }

 private:
  using Content = decltype(Command::content);

  Result<Content> dispatch(std::string_view word) {
    if (parser_.accept("query")) return query();
    if (parser_.accept("let")) return let(false);
    if (parser_.accept("let_")) return let(true);
    if (parser_.accept("update")) return update();
    if (parser_.accept("create")) return create();
    if (parser_.accept("delete")) return remove();
    if (parser_.accept("open")) {
      ASSIGN_OR_RETURN(std::string name, database_name());
      return Content(OpenDatabase{std::move(name)});
    }
    if (parser_.accept("close")) {
      RETURN_IF_ERROR(parser_.expect("database", "after 'close'"));
      return Content(CloseDatabase{});
    }
    if (parser_.accept("list")) return inquiry();
    return unknown_command(word);
  }

  Error unknown_command(std::string_view word) {
    static const std::vector<std::string> commands = {"query",  "let",  "let_",  "update", "create",
                                                       "delete", "open", "close", "list"};
    std::string expected = "a command (" + algebra3d::enumerate(commands, commands.size()) + ")";
    const std::string suggestion = algebra3d::nearest_name(word, commands);
    Error error = parser_.unexpected(expected);
    if (!suggestion.empty()) error.message += "; did you mean '" + suggestion + "'?";
    return error;
  }

  Result<std::string> database_name() {
    RETURN_IF_ERROR(parser_.expect("database", "after the command"));
    return parser_.name("the name of a database");
  }

  // The text of the expression is kept, since functions are stored as they were written.
  Result<std::pair<ExpressionPtr, std::string>> value() {
    const std::size_t begin = parser_.scanner().peek().begin;
    ASSIGN_OR_RETURN(ExpressionPtr expression, parser_.expression());
    const std::size_t end = parser_.scanner().peek().begin;
    return std::pair(std::move(expression), std::string(parser_.scanner().source().substr(begin, end - begin)));
  }

  Result<Content> query() {
    ASSIGN_OR_RETURN(ExpressionPtr expression, parser_.expression());
    return Content(Query{std::move(expression)});
  }

  Result<Content> let(bool replaces) {
    ASSIGN_OR_RETURN(std::string name, parser_.name("the name of an object"));
    RETURN_IF_ERROR(parser_.expect("=", "after the name '" + name + "'"));
    ASSIGN_OR_RETURN(auto content, value());
    return Content(LetObject{std::move(name), std::move(content.first), replaces, std::move(content.second)});
  }

  Result<Content> update() {
    ASSIGN_OR_RETURN(std::string name, parser_.name("the name of an object"));
    RETURN_IF_ERROR(parser_.expect(":=", "after the name '" + name + "'"));
    ASSIGN_OR_RETURN(auto content, value());
    return Content(UpdateObject{std::move(name), std::move(content.first), std::move(content.second)});
  }

  Result<Content> create() {
    if (parser_.at("database")) {
      ASSIGN_OR_RETURN(std::string name, database_name());
      return Content(CreateDatabase{std::move(name)});
    }
    ASSIGN_OR_RETURN(std::string name, parser_.name("'database' or the name of an object"));
    RETURN_IF_ERROR(parser_.expect(":", "after the name '" + name + "'"));
    ASSIGN_OR_RETURN(TypeSyntax type, parser_.type());
    return Content(CreateObject{std::move(name), std::move(type)});
  }

  Result<Content> remove() {
    if (parser_.at("database")) {
      ASSIGN_OR_RETURN(std::string name, database_name());
      return Content(DeleteDatabase{std::move(name)});
    }
    ASSIGN_OR_RETURN(std::string name, parser_.name("'database' or the name of an object"));
    return Content(DeleteObject{std::move(name)});
  }

  Result<Content> inquiry() {
    using Subject = Inquiry::Subject;
    if (parser_.accept("databases")) return Content(Inquiry{Subject::databases});
    if (parser_.accept("objects")) return Content(Inquiry{Subject::objects});
    if (parser_.accept("operators")) return Content(Inquiry{Subject::operators});
    if (parser_.accept("type")) {
      RETURN_IF_ERROR(parser_.expect("constructors", "after 'list type'"));
      return Content(Inquiry{Subject::type_constructors});
    }
    return parser_.unexpected("databases, objects, operators or type constructors after 'list'");
  }

  ExpressionParser parser_;
};

}  // namespace

Result<Command> parse_command(std::string_view text, const Registry& registry, SourcePlace start) {
  Scanner scanner(text, std::move(start));
  return CommandParser(scanner, registry).parse();
}

Result<ExpressionPtr> parse_expression(std::string_view text, const Registry& registry, SourcePlace start) {
  Scanner scanner(text, std::move(start));
  ExpressionParser parser(scanner, registry);
  ASSIGN_OR_RETURN(ExpressionPtr expression, parser.expression());
  RETURN_IF_ERROR(parser.expect_end());
  return expression;
}

bool is_reserved(std::string_view word, const Registry& registry) {
  return std::ranges::find(kReservedWords, word) != kReservedWords.end() || registry.find_operator(word) != nullptr;
}

}  // namespace queries
