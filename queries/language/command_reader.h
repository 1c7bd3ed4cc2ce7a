#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

/// One command as it was collected, without the `;`.
struct CommandText {
  std::string text;
  algebra3d::SourcePlace start;  ///< place of its first character
};

/// Assembles commands from lines (language.md 1.1): a line that begins with `#` is skipped, `;` outside of brackets and
/// literals ends a command, and so does an empty line. The commands of 1.2 (`help`, `quit`, `@FILE`, ...) need no `;`
/// and end with their line. White space at the end of a line counts in literals alone, except for a carriage return.
/// Works for scripts, test files and terminals alike.
class CommandReader {
 public:
  /// Lines that are skipped besides those that begin with `#`.
  enum class Skipping : std::uint8_t {
    comments,
    marked_blocks,  ///< also lines that begin with `//`, and from a line that begins with `/*` to one with `*/`
  };
  explicit CommandReader(std::string file = {}, Skipping skipping = Skipping::comments)
      : file_(std::move(file)), skipping_(skipping) {}

  /// Takes the next line (without its line end) and gives the commands that it completes.
  std::vector<CommandText> add_line(std::string_view line);
  /// The command that was begun and not ended, at the end of the input.
  std::optional<CommandText> finish();
  /// True while a command is begun: a terminal then shows that more is expected.
  bool is_pending() const { return !text_.empty(); }
  /// Bytes of that command so far.
  std::size_t pending_size() const { return text_.size(); }
  /// Where the marked block began that is not closed yet, and in which everything is skipped.
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

/// Whether a command is one of language.md 1.2, which the shell carries out itself: `?`, `help`, `q`, `quit`, `debug`,
/// `repeat` in any case, and whatever begins with `@`.
bool is_shell_command(std::string_view text);

}  // namespace queries
