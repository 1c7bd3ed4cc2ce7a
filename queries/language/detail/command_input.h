#pragma once

#include <memory>
#include <string>
#include <string_view>

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

}  // namespace queries
