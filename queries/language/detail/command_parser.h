#pragma once

#include <span>

#include "queries/language/command.h"
#include "queries/language/detail/command_input.h"

namespace queries {

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
