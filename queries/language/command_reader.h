#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

/// The text of one command, without the `;`.
struct CommandText {
  std::string text;
  algebra3d::SourcePlace start;  ///< position of its first character
};

/// Assembles commands from lines (docs/language.md, "Decided here"): a line that begins with `#` is skipped, `;`
/// outside of brackets and literals ends a command, and so does an empty line. The commands of the shell (`help`,
/// `quit`, `@FILE`, ...) need no `;` and end with their line. White space at the end of a line is kept within literals
/// only, a carriage return never. Used for scripts, test files and terminals.
class CommandReader {
 public:
  /// Which lines are skipped besides those that begin with `#`.
  enum class Skipping : std::uint8_t {
    comments,
    marked_blocks,  ///< also lines that begin with `//`, and from a line that begins with `/*` to one with `*/`
  };
  explicit CommandReader(std::string file = {}, Skipping skipping = Skipping::comments)
      : file_(std::move(file)), skipping_(skipping) {}

  /// Adds a line (without its line end) and returns the commands that it completes.
  std::vector<CommandText> add_line(std::string_view line);
  /// At the end of the input: the last command, if it has no end.
  std::optional<CommandText> finish();
  /// True while a command is incomplete; a terminal then shows a continuation prompt.
  bool is_pending() const { return !text_.empty(); }
  /// Bytes of that command so far.
  std::size_t pending_size() const { return text_.size(); }
  /// The beginning of a marked block that is not closed; its lines are skipped.
  std::optional<algebra3d::SourcePlace> open_block() const;
  int line() const { return line_; }
  const std::string& file() const { return file_; }

 private:
  enum class Literal : std::uint8_t { none, string, text, tagged_text, file, comment };

  bool is_skipped(std::string_view line);
  void add_character(std::string_view line, std::size_t& position, std::vector<CommandText>& complete);
  bool step_literal(std::string_view line, std::size_t& position);
  void open_literal(std::string_view rest);
  std::optional<CommandText> take();

  std::string file_;
  Skipping skipping_;
  bool is_in_block_ = false;
  int block_line_ = 0;
  int line_ = 0;
  std::string text_;
  algebra3d::SourcePlace start_;
  Literal literal_ = Literal::none;
  int depth_ = 0;
};

/// The commands of a text, as a CommandReader assembles them from its lines.
std::vector<CommandText> commands_of(std::string_view text);

/// True for a command of the shell: `?`, `help`, `q`, `quit`, `debug`, `repeat` in upper or lower case, and any text
/// that begins with `@`.
bool is_shell_command(std::string_view text);

}  // namespace queries
