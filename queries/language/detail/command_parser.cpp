#include "queries/language/detail/command_parser.h"

#include <algorithm>
#include <array>

#include "algebra3d/operators/registry/registry.h"
#include "base/propagate.h"
#include "queries/language/parser.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

/// Commands of other languages, and what is written here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kWordsOfOthers = {{
    {"select", kInsteadOfSelect},
    {"insert", "write query RELATION inserttuple[VALUES] consume"},
    {"drop", "write delete NAME, or delete database NAME"},
    {"show", "write list objects, or query NAME"},
    {"use", "write open database NAME"},
    {"print", "write query EXPRESSION"},
}};

}  // namespace

Result<Command> CommandParser::parse() {
  A3D_ASSIGN(Command result, command());
  if (!input_.is_at_end()) return input_.unexpected("the end of the command");
  return result;
}

Result<Command> CommandParser::command() {
  SourcePlace place = input_.place();
  auto read = content();
  if (!read) return std::move(read).error();
  return Command{std::move(place), std::move(read).value()};
}

Result<CommandPtr> CommandParser::part() {
  if (depth_ == kMaxCommandDepth)
    return Error(ErrorCode::limit_exceeded, "commands are nested deeper than {} levels", kMaxCommandDepth)
        .at(input_.place());
  A3D_ASSIGN(const std::unique_ptr<CommandInput> own, input_.part());
  ++depth_;
  auto read = own != nullptr ? CommandParser(*own, depth_).parse() : command();
  --depth_;
  if (!read) return std::move(read).error();
  return std::make_shared<const Command>(std::move(read).value());
}

/// The first word of a command, and what reads the rest.
struct CommandParser::Form {
  std::string_view word;
  Content (CommandParser::*rest)();
};

std::span<const CommandParser::Form> CommandParser::forms() {
  static constexpr std::array<Form, 25> kForms = {{
      {"query", &CommandParser::query},       {"querynt", &CommandParser::query},
      {"let", &CommandParser::let},           {"let_", &CommandParser::let_again},
      {"update", &CommandParser::update},     {"create", &CommandParser::create},
      {"delete", &CommandParser::remove},     {"open", &CommandParser::open},
      {"list", &CommandParser::list},         {"close", &CommandParser::close},
      {"derive", &CommandParser::derive},     {"explain", &CommandParser::explain},
      {"save", &CommandParser::save},         {"restore", &CommandParser::restore},
      {"begin", &CommandParser::begin},       {"commit", &CommandParser::commit},
      {"abort", &CommandParser::abort},       {"kill", &CommandParser::kill},
      {"changename", &CommandParser::rename}, {"type", &CommandParser::define_type},
      {"if", &CommandParser::conditional},    {"while", &CommandParser::loop},
      {"set", &CommandParser::set_option},    {"check", &CommandParser::check},
      {"{", &CommandParser::sequence},
  }};
  return kForms;
}

CommandParser::Content CommandParser::content() {
  for (const Form& form : forms())
    if (input_.accept(form.word)) return (this->*form.rest)();
  if (input_.accept("{{")) return patient_sequence();
  return unknown_command();
}

bool CommandParser::begins_command(std::string_view word) {
  return std::ranges::find(forms(), word, &Form::word) != forms().end();
}

Error CommandParser::unknown_command() {
  for (const auto& [word, right] : kWordsOfOthers)
    if (algebra3d::is_equal_but_for_case(word, input_.shown_word()))
      return Error(ErrorCode::syntax_error, "there is no command '{}'; {}", input_.shown_word(), right)
          .at(input_.place());
  std::vector<std::string> words;
  for (const Form& form : forms()) words.emplace_back(form.word);
  const std::string suggestion = algebra3d::nearest_name(input_.shown_word(), words);
  Error error = input_.unexpected("a command (query, let, update, create, delete, open, list, ... see `help`)");
  if (!suggestion.empty()) error.message += "; did you mean '" + suggestion + "'?";
  if (!suggestion.empty() && algebra3d::is_equal_but_for_case(suggestion, input_.shown_word()))
    error.message += " Commands are written in lower case";
  return error;
}

CommandParser::Content CommandParser::query() {
  A3D_ASSIGN(ExpressionPtr value, input_.expression());
  return CommandContent(Query{std::move(value)});
}

CommandParser::Content CommandParser::explain() {
  const bool runs = input_.at("query");
  if (runs) input_.skip();
  A3D_ASSIGN(ExpressionPtr value, input_.expression());
  return CommandContent(Explain{std::move(value), runs});
}

CommandParser::Content CommandParser::let() {
  return named_value("=", [](auto name, auto place, auto value) {
    return LetObject{std::move(name), std::move(place), std::move(value), false};
  });
}

CommandParser::Content CommandParser::let_again() {
  return named_value("=", [](auto name, auto place, auto value) {
    return LetObject{std::move(name), std::move(place), std::move(value), true};
  });
}

CommandParser::Content CommandParser::derive() {
  return named_value("=", [](auto name, auto place, auto value) {
    return DeriveObject{std::move(name), std::move(place), std::move(value)};
  });
}

CommandParser::Content CommandParser::update() {
  return named_value(":=", [](auto name, const auto& /*place*/, auto value) {
    return UpdateObject{std::move(name), std::move(value)};
  });
}

CommandParser::Content CommandParser::kill() {
  A3D_ASSIGN(std::string name, object_name());
  return CommandContent(DeleteObject{std::move(name), true});
}

CommandParser::Content CommandParser::open() {
  A3D_ASSIGN(std::string name, database_name());
  return CommandContent(OpenDatabase{std::move(name)});
}

CommandParser::Content CommandParser::close() {
  A3D_TRY(input_.expect("database", "after 'close'"));
  return CommandContent(CloseDatabase{});
}

CommandParser::Content CommandParser::check() {
  A3D_TRY(input_.expect("database", "after 'check'"));
  return CommandContent(CheckDatabase{});
}

Result<std::string> CommandParser::database_name() {
  A3D_TRY(input_.expect("database", "after the command"));
  return input_.name("the name of a database");
}

Result<std::string> CommandParser::object_name() {
  return input_.name("the name of an object");
}

Result<std::string> CommandParser::file_after(std::string_view word) {
  A3D_TRY(input_.expect(word, "and the file"));
  return input_.word_or_text("the name of a file, or 'a path' in quotes");
}

template <typename Make>
CommandParser::Content CommandParser::named_value(std::string_view separator, Make make) {
  SourcePlace place = input_.place();
  A3D_ASSIGN(std::string name, object_name());
  A3D_TRY(input_.expect(separator, "after the name '" + name + "'"));
  A3D_ASSIGN(ExpressionPtr value, input_.expression());
  return CommandContent(make(std::move(name), std::move(place), std::move(value)));
}

CommandParser::Content CommandParser::create() {
  if (input_.at("database")) {
    A3D_ASSIGN(std::string name, database_name());
    return CommandContent(CreateDatabase{std::move(name)});
  }
  SourcePlace place = input_.place();
  A3D_ASSIGN(std::string name, input_.name("'database' or the name of an object"));
  A3D_TRY(input_.expect(":", "after the name '" + name + "'"));
  A3D_ASSIGN(TypeSyntax type, input_.type());
  return CommandContent(CreateObject{std::move(name), std::move(place), std::move(type)});
}

CommandParser::Content CommandParser::remove() {
  if (input_.at("database")) {
    A3D_ASSIGN(std::string name, database_name());
    return CommandContent(DeleteDatabase{std::move(name)});
  }
  if (input_.accept("type")) {
    A3D_ASSIGN(std::string name, input_.name("the name of a type"));
    return CommandContent(DeleteType{std::move(name)});
  }
  A3D_ASSIGN(std::string name, input_.name("'database', 'type' or the name of an object"));
  return CommandContent(DeleteObject{std::move(name), false});
}

CommandParser::Content CommandParser::rename() {
  A3D_ASSIGN(std::string old_name, object_name());
  A3D_TRY(input_.expect("to", "and the new name"));
  SourcePlace place = input_.place();
  A3D_ASSIGN(std::string new_name, input_.name("the new name"));
  return CommandContent(RenameObject{std::move(old_name), std::move(new_name), std::move(place)});
}

CommandParser::Content CommandParser::define_type() {
  SourcePlace place = input_.place();
  A3D_ASSIGN(std::string name, input_.name("the name of a type"));
  A3D_TRY(input_.expect("=", "after the name '" + name + "'"));
  A3D_ASSIGN(TypeSyntax type, input_.type());
  return CommandContent(DefineType{std::move(name), std::move(place), std::move(type)});
}

CommandParser::Content CommandParser::save() {
  if (input_.accept("database")) {
    A3D_ASSIGN(std::string file, file_after("to"));
    return CommandContent(SaveDatabase{std::move(file)});
  }
  A3D_ASSIGN(std::string name, input_.name("'database' or the name of an object"));
  A3D_ASSIGN(std::string file, file_after("to"));
  return CommandContent(SaveObject{std::move(name), std::move(file)});
}

CommandParser::Content CommandParser::restore() {
  if (input_.at("database")) {
    A3D_ASSIGN(std::string name, database_name());
    A3D_ASSIGN(std::string file, file_after("from"));
    return CommandContent(RestoreDatabase{std::move(name), std::move(file)});
  }
  SourcePlace place = input_.place();
  A3D_ASSIGN(std::string name, input_.name("'database' or the name of an object"));
  A3D_ASSIGN(std::string file, file_after("from"));
  return CommandContent(RestoreObject{std::move(name), std::move(place), std::move(file)});
}

CommandParser::Content CommandParser::list() {
  using Subject = Inquiry::Subject;
  static constexpr std::array<std::pair<std::string_view, Subject>, 6> kSubjects = {{
      {"databases", Subject::databases},
      {"objects", Subject::objects},
      {"types", Subject::types},
      {"operators", Subject::operators},
      {"algebras", Subject::algebras},
      {"counters", Subject::counters},
  }};
  for (const auto& [word, subject] : kSubjects)
    if (input_.accept(word)) return CommandContent(Inquiry{.subject = subject});
  if (input_.accept("type")) {
    A3D_TRY(input_.expect("constructors", "after 'list type'"));
    return CommandContent(Inquiry{.subject = Subject::type_constructors});
  }
  if (input_.accept("algebra")) {
    A3D_ASSIGN(std::string name, input_.name("the name of an algebra"));
    return CommandContent(Inquiry{.subject = Subject::operators, .algebra = std::move(name)});
  }
  return input_.unexpected(
      "databases, objects, types, type constructors, operators, algebras, algebra NAME or counters after 'list'");
}

CommandParser::Content CommandParser::begin() {
  return transaction(TransactionStep::Step::begin);
}

CommandParser::Content CommandParser::commit() {
  return transaction(TransactionStep::Step::commit);
}

CommandParser::Content CommandParser::abort() {
  return transaction(TransactionStep::Step::abort);
}

CommandParser::Content CommandParser::transaction(TransactionStep::Step step) {
  A3D_TRY(input_.expect("transaction", "after the command"));
  return CommandContent(TransactionStep{step});
}

CommandParser::Content CommandParser::set_option() {
  A3D_ASSIGN(std::string name, input_.word_or_text("the name of an option, as in set \"memory\" = 256"));
  A3D_TRY(input_.expect("=", "after the name '" + name + "'"));
  A3D_ASSIGN(ExpressionPtr value, input_.expression());
  return CommandContent(SetOption{std::move(name), std::move(value)});
}

CommandParser::Content CommandParser::conditional() {
  Conditional result;
  A3D_ASSIGN(result.condition, input_.expression());
  A3D_TRY(input_.expect("then", "after the condition"));
  A3D_ASSIGN(result.then_branch, part());
  if (input_.accept("else")) {
    A3D_ASSIGN(result.else_branch, part());
  }
  A3D_TRY(input_.expect("endif", "to end the command"));
  return CommandContent(std::move(result));
}

CommandParser::Content CommandParser::loop() {
  Loop result;
  A3D_ASSIGN(result.condition, input_.expression());
  A3D_TRY(input_.expect("do", "after the condition"));
  A3D_ASSIGN(result.body, part());
  A3D_TRY(input_.expect("endwhile", "to end the command"));
  return CommandContent(std::move(result));
}

CommandParser::Content CommandParser::sequence() {
  return commands_until("}", false);
}

CommandParser::Content CommandParser::patient_sequence() {
  return commands_until("}}", true);
}

CommandParser::Content CommandParser::commands_until(std::string_view close, bool goes_on) {
  Sequence result;
  result.goes_on_after_errors = goes_on;
  do {
    A3D_ASSIGN(CommandPtr next, part());
    result.commands.push_back(std::move(next));
  } while (input_.accept("|"));
  A3D_TRY(input_.expect(close, "or '|' after the command"));
  return CommandContent(std::move(result));
}

}  // namespace queries
