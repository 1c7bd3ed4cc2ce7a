#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "queries/language/command.h"
#include "queries/language/syntax_tree.h"

namespace queries {

/// The input of CommandParser: the words, expressions and types of a command, which is a text (`let a = 1 + 2`) or a
/// nested list (`(let a = (+ 1 2))`).
class CommandInput {
 public:
  virtual ~CommandInput() = default;
  CommandInput() = default;
  CommandInput(const CommandInput&) = delete;
  CommandInput& operator=(const CommandInput&) = delete;

  /// Whether the next word is `spelling`.
  virtual bool at(std::string_view spelling) = 0;
  /// Skips the next word.
  virtual void skip() = 0;
  /// Reads a name; `what` is for the message ("an attribute name").
  virtual algebra3d::Result<std::string> name(std::string_view what) = 0;
  /// Reads a name, a string or a text.
  virtual algebra3d::Result<std::string> word_or_text(std::string_view what) = 0;
  virtual algebra3d::Result<ExpressionPtr> expression() = 0;
  virtual algebra3d::Result<TypeSyntax> type() = 0;
  /// The input of a nested command if that is a list of its own; null if its words follow in this input.
  virtual algebra3d::Result<std::unique_ptr<CommandInput>> part() = 0;
  /// Whether everything has been read.
  virtual bool is_at_end() = 0;
  virtual SourcePlace place() = 0;
  /// The next word as typed, for suggestions; empty if there is none.
  virtual std::string shown_word() = 0;
  /// "expected WHAT, found ..." at the next word.
  virtual algebra3d::Error unexpected(std::string_view what) = 0;

  bool accept(std::string_view spelling) {
    if (!at(spelling)) return false;
    skip();
    return true;
  }
  algebra3d::Status expect(std::string_view spelling, std::string_view context) {
    if (accept(spelling)) return {};
    return unexpected("'" + std::string(spelling) + "' " + std::string(context));
  }
};

/// Deepest nesting of control commands (`if`, `while`, `{ | }`); beyond it: error limit_exceeded.
inline constexpr int kMaxCommandDepth = 50;

/// The parser of commands (docs/language.md, "What there is") for both notations. In a nested list the parts of a
/// control command are sublists, in a text they follow each other.
class CommandParser {
 public:
  explicit CommandParser(CommandInput& input, int depth = 0) : input_(input), depth_(depth) {}

  /// Parses one command up to the end of the input. Errors: syntax_error, unknown_name with the list of commands.
  algebra3d::Result<Command> parse();
  /// True for the first word of a command.
  static bool begins_command(std::string_view word);

 private:
  using Content = algebra3d::Result<CommandContent>;
  struct Form;

  algebra3d::Result<Command> command();
  algebra3d::Result<CommandPtr> part();
  Content content();
  static std::span<const Form> forms();

  // One function per command; each parses what follows the first word.
  Content query();
  Content explain();
  Content let();
  Content let_again();
  Content derive();
  Content update();
  Content create();
  Content remove();
  Content kill();
  Content rename();
  Content define_type();
  Content open();
  Content close();
  Content check();
  Content save();
  Content restore();
  Content list();
  Content begin();
  Content commit();
  Content abort();
  Content set_option();
  Content conditional();
  Content loop();
  Content sequence();
  Content patient_sequence();

  Content transaction(TransactionStep::Step step);
  Content commands_until(std::string_view close, bool goes_on);
  template <typename Make>
  Content named_value(std::string_view separator, Make make);
  algebra3d::Result<std::string> database_name();
  algebra3d::Result<std::string> object_name();
  algebra3d::Result<std::string> file_after(std::string_view word);
  algebra3d::Error unknown_command();

  CommandInput& input_;
  int depth_;
};

}  // namespace queries
