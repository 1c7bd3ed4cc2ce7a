#include "queries/test_runner/detail/test_file.h"

#include <algorithm>
#include <array>
#include <optional>

namespace queries {
namespace {

constexpr std::array<std::string_view, 8> kDirectives = {"setup",  "description",    "stop",     "testcase",
                                                         "yields", "tolerance_real", "coverage", "teardown"};
// Ours: no blank may stand before it, so that a comment is not taken for it.
constexpr std::string_view kVariation = "variation";

// The word right after `#`, blanks allowed, decides; every other line with `#` is a comment.
std::optional<Directive> directive_of(std::string_view line, int number) {
  if (!line.starts_with('#')) return std::nullopt;
  if (line.substr(1).starts_with(kVariation))
    return Directive{std::string(kVariation), std::string(trimmed(line.substr(1 + kVariation.size()))), number};
  const std::string_view text = trimmed(line.substr(1));
  for (const std::string_view word : kDirectives)
    if (text.starts_with(word))
      return Directive{std::string(word), std::string(trimmed(text.substr(word.size()))), number};
  return std::nullopt;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view take_line(std::string_view& content) {
  const std::size_t end = content.find('\n');
  const std::string_view line = content.substr(0, end);
  content.remove_prefix(end == std::string_view::npos ? content.size() : end + 1);
  return line;
}

std::vector<TestStep> read_test_steps(std::string_view content, const std::string& file) {
  // Editors on Windows begin a file with this mark of UTF-8.
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  std::vector<TestStep> steps;
  CommandReader reader(file);
  const auto add_commands = [&](std::vector<CommandText> commands) {
    for (CommandText& command : commands) steps.emplace_back(std::move(command));
  };
  for (int number = 1; !content.empty(); ++number) {
    const std::string_view line = take_line(content);
    auto directive = directive_of(line, number);
    // A literal or bracket that is not closed must not take the commands of the next case with it.
    if (directive && (directive->word == "testcase" || directive->word == "teardown"))
      if (auto open = reader.finish()) steps.emplace_back(std::move(*open));
    add_commands(reader.add_line(line));
    if (!directive) continue;
    while (directive->argument.ends_with('\\') && !content.empty()) {
      directive->argument.pop_back();
      const std::string_view continued = take_line(content);
      // A blank keeps apart what stood on two lines.
      directive->argument += ' ';
      directive->argument += trimmed(continued);
      reader.add_line("#");  // keeps the line count
      ++number;
    }
    steps.emplace_back(std::move(*directive));
  }
  if (auto last = reader.finish()) steps.emplace_back(std::move(*last));
  return steps;
}

}  // namespace queries
