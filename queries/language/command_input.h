#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "queries/language/syntax_tree.h"

namespace queries {

/// What the grammar of commands is written over: the words of a command one after the other, be it a text
/// (`let a = 1 + 2`) or a nested list (`(let a = (+ 1 2))`), with whole expressions and types in between.
class CommandInput {
 public:
  virtual ~CommandInput() = default;
  CommandInput() = default;
  CommandInput(const CommandInput&) = delete;
  CommandInput& operator=(const CommandInput&) = delete;

  /// Whether the next word is `spelling`.
  virtual bool at(std::string_view spelling) = 0;
  /// Steps over the next word.
  virtual void skip() = 0;
  /// A word that is a name; `what` is for the message ("an attribute name").
  virtual algebra3d::Result<std::string> name(std::string_view what) = 0;
  /// A name, a string or a text.
  virtual algebra3d::Result<std::string> word_or_text(std::string_view what) = 0;
  virtual algebra3d::Result<ExpressionPtr> expression() = 0;
  virtual algebra3d::Result<TypeSyntax> type() = 0;
  /// The words of a command within this one, if it is a list of its own; null if it stands in line.
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
