#include "queries/language/command_reader.h"

#include <algorithm>
#include <cctype>

#include "queries/language/scanner.h"

namespace queries {
namespace {

constexpr std::string_view kTextEnd = "</text--->";
constexpr std::string_view kTextBegin = "<text>";
constexpr std::string_view kFileBegin = "<file>";
constexpr std::string_view kFileEnd = "</file--->";

std::string_view blanks_at_end(std::string_view line) {
  std::size_t begin = line.size();
  while (begin > 0 && is_blank(line[begin - 1])) --begin;
  return line.substr(begin);
}

}  // namespace

bool is_shell_command(std::string_view text) {
  if (text.starts_with('@') || text.starts_with('?')) return true;
  std::string word(text.substr(0, text.find_first_of(" \t\n;")));
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word == "help" || word == "q" || word == "quit" || word == "exit" || word == "debug" || word == "repeat";
}

std::vector<CommandText> CommandReader::add_line(std::string_view line) {
  ++line_;
  // Editors on Windows begin a file with this mark of UTF-8.
  if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  if (line.ends_with('\r')) line.remove_suffix(1);
  const std::string_view blanks = blanks_at_end(line);
  line.remove_suffix(blanks.size());
  std::vector<CommandText> complete;
  if (is_skipped(line)) return complete;
  if (line.empty()) {
    if (auto command = take()) complete.push_back(std::move(*command));
    return complete;
  }
  if (!text_.empty()) text_ += '\n';
  for (std::size_t position = 0; position < line.size();) add_character(line, position, complete);
  // They belong to a literal that goes on in the next line.
  if (literal_ != Literal::none && literal_ != Literal::comment) text_ += blanks;
  return complete;
}

bool CommandReader::is_skipped(std::string_view line) {
  if (skipping_ == Skipping::marked_blocks) {
    if (is_in_block_) {
      is_in_block_ = !line.starts_with("*/");
      return true;
    }
    is_in_block_ = line.starts_with("/*");
    if (is_in_block_) block_line_ = line_;
    if (is_in_block_ || line.starts_with("//")) return true;
  }
  return line.starts_with('#');
}

std::optional<algebra3d::SourcePlace> CommandReader::open_block() const {
  if (!is_in_block_) return std::nullopt;
  return algebra3d::SourcePlace{file_, block_line_, 1};
}

std::optional<CommandText> CommandReader::finish() {
  return take();
}

void CommandReader::add_character(std::string_view line, std::size_t& position, std::vector<CommandText>& complete) {
  if (literal_ != Literal::none) {
    if (step_literal(line, position)) return;
    text_ += line[position++];
    return;
  }
  const char c = line[position];
  if (c == ';' && depth_ == 0) {
    ++position;
    if (auto command = take()) complete.push_back(std::move(*command));
    return;
  }
  if (text_.empty()) {
    if (is_blank(c)) {
      ++position;
      return;
    }
    start_ = {file_, line_, static_cast<int>(position) + 1};
    if (const std::string_view rest = line.substr(position); is_shell_command(rest)) {
      const std::string_view whole = rest.substr(0, rest.find(';'));
      text_ = whole;
      position += whole.size();
      if (auto command = take()) complete.push_back(std::move(*command));
      return;
    }
  }
  open_literal(line.substr(position));
  if (c == '(' || c == '[' || c == '{') ++depth_;
  // A bracket too many must not swallow the rest of the script.
  if (c == ')' || c == ']' || c == '}') depth_ = std::max(0, depth_ - 1);
  text_ += c;
  ++position;
}

void CommandReader::open_literal(std::string_view rest) {
  if (rest.front() == '"') literal_ = Literal::string;
  if (rest.front() == '\'') literal_ = Literal::text;
  if (rest.starts_with(kTextBegin)) literal_ = Literal::tagged_text;
  if (rest.starts_with(kFileBegin)) literal_ = Literal::file;
  if (rest.starts_with("_!")) literal_ = Literal::comment;
}

// Steps over an escape or the end of the literal; false if the character is an ordinary one of it.
bool CommandReader::step_literal(std::string_view line, std::size_t& position) {
  const std::string_view rest = line.substr(position);
  const char quote = literal_ == Literal::string ? '"' : '\'';
  std::size_t length = 0;
  if (literal_ == Literal::tagged_text || literal_ == Literal::file) {
    const std::string_view end = literal_ == Literal::file ? kFileEnd : kTextEnd;
    if (rest.starts_with(end)) length = end.size();
  } else if (literal_ == Literal::comment) {
    if (rest.starts_with("!_")) length = 2;
  } else if (rest.size() > 1 && rest[0] == '\\' && (rest[1] == quote || rest[1] == '\\')) {
    text_ += rest.substr(0, 2);
    position += 2;
    return true;
  } else if (rest.front() == quote) {
    length = 1;
  }
  if (length == 0) return false;
  text_ += rest.substr(0, length);
  position += length;
  literal_ = Literal::none;
  return true;
}

std::optional<CommandText> CommandReader::take() {
  literal_ = Literal::none;
  depth_ = 0;
  if (text_.empty()) return std::nullopt;
  CommandText command{std::move(text_), start_};
  text_.clear();
  while (!command.text.empty() && is_blank(command.text.back())) command.text.pop_back();
  return command;
}

std::vector<CommandText> commands_of(std::string_view text) {
  CommandReader reader;
  std::vector<CommandText> commands;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    for (CommandText& command : reader.add_line(text.substr(begin, end - begin)))
      commands.push_back(std::move(command));
    begin = end + 1;
  }
  if (auto last = reader.finish()) commands.push_back(std::move(*last));
  return commands;
}

}  // namespace queries
