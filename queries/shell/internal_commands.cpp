// The commands that the shell carries out itself.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "base/polled_input.h"
#include "queries/shell/detail/command_table.h"
#include "queries/shell/detail/file_arguments.h"
#include "queries/shell/detail/interruption.h"
#include "queries/shell/detail/screen.h"
#include "queries/shell/detail/statement_runner.h"

namespace queries {
namespace {

constexpr std::size_t kMaxScriptDepth = 32;

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kWhiteSpace = " \t\r\n";
  const auto begin = text.find_first_not_of(kWhiteSpace);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kWhiteSpace) - begin + 1));
}

// Pipes may be scripts, and so may terminals; other devices have no end.
bool is_device(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_block_file(status)) return true;
  if (!std::filesystem::is_character_file(status)) return false;
  if (std::filesystem::weakly_canonical(file, error) == "/dev/null") return false;
  const int handle = open(file.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  const bool is_terminal = handle >= 0 && isatty(handle) != 0;
  if (handle >= 0) close(handle);
  return !is_terminal;
}

/// Where the end of a command begins, which stands in it word for word.
SourcePlace start_of(std::string_view end, const CommandText& command) {
  SourcePlace place = command.start;
  const std::string_view before = std::string_view(command.text).substr(0, command.text.rfind(end));
  const auto last_line = before.rfind('\n');
  place.line += static_cast<int>(std::ranges::count(before, '\n'));
  place.column = last_line == std::string_view::npos ? place.column + static_cast<int>(before.size())
                                                     : static_cast<int>(before.size() - last_line);
  return place;
}

}  // namespace

RunResult StatementRunner::run_shell_command(const CommandText& command) {
  const std::string& text = command.text;
  if (text.starts_with('@')) return include(command);
  if (text.starts_with('?')) return help(trimmed(text.substr(1)));
  const std::size_t word_end = std::min(text.find_first_of(" \t\n"), text.size());
  const std::string word = lower_case(text.substr(0, word_end));
  const std::string rest = trimmed(text.substr(word_end));
  if (word == "help") return help(rest);
  if (word == "repeat") return repeat(command, rest);
  if (word == "debug") {
    console_.errors << "note: debug: there are no debug levels here; see `explain` and `list counters`\n";
    return RunResult::ok;
  }
  if (word == "exit" && rest.empty()) console_.errors << "note: `exit` means `quit` here\n";
  return rest.empty() ? RunResult::quit
                      : complain(word + ": expected nothing after it, found '" + rest + "'", command.start);
}

// Help is longer than most screens.
void StatementRunner::show_help(const std::string& text) {
  if (console_.terminal != nullptr) console_.terminal->begin_statement("help", session_.options().uses_pager);
  console_.out << text;
  if (console_.terminal != nullptr) {
    console_.terminal->end_statement();
    console_.out.clear();
  }
  console_.out.flush();
}

RunResult StatementRunner::help(const std::string& name) {
  if (name.empty()) {
    show_help(shell_help(session_.registry()));
    return RunResult::ok;
  }
  const auto of_program = console_.program_help ? console_.program_help(name) : std::nullopt;
  if (of_program) {
    const std::string own = exact_help(name, session_.registry());
    show_help((own.empty() ? "" : own + "\n") + "A command of the program: `algebra3d " + name + " ...`\n" +
              *of_program);
    return RunResult::ok;
  }
  const auto text = shell_help(name, session_.registry());
  if (!text) return complain(text.error().text());
  show_help(*text);
  return RunResult::ok;
}

// `@FILE`, `@@FILE` (stops at the first error), `@%FILE` and `@&FILE` (the same two, skipping marked comments).
RunResult StatementRunner::include(const CommandText& command) {
  const std::string& text = command.text;
  const char mode = text.size() > 1 ? text[1] : '\0';
  const bool has_mode = mode == '@' || mode == '%' || mode == '&';
  const std::string file = trimmed(text.substr(has_mode ? 2 : 1));
  if (file.empty()) return complain("@: expected the name of a script after it", command.start);
  const bool skips = mode == '%' || mode == '&';
  const bool stopped_before = rules_.stops_on_error;
  rules_.stops_on_error = stopped_before || mode == '@' || mode == '&';
  const RunResult result =
      run_file(file, skips ? CommandReader::Skipping::marked_blocks : CommandReader::Skipping::comments, command.start);
  rules_.stops_on_error = stopped_before;
  return result;
}

RunResult StatementRunner::run_file(const std::string& file, CommandReader::Skipping skipping,
                                    const SourcePlace& place) {
  const auto refuse = [&](const std::string& why) { return complain(why, place); };
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    return refuse("cannot read the script '" + file + "': it is a folder; `algebra3d check " + shell_word(file) +
                  "` lists the mesh files in it");
  if (is_device(file)) return refuse("cannot read the script '" + file + "': it is a device");
  if (const std::string why = why_no_script(file); !why.empty())
    return refuse("cannot read the script '" + file + "': " + why);
  const auto opened = algebra3d::PolledInput::open(file);
  if (!opened) return refuse("cannot read the script '" + file + "': " + opened.error().text());
  algebra3d::PolledInput input(opened->number(), &Interruption::flag());
  std::istream script(&input);
  const auto path = std::filesystem::weakly_canonical(file, error);
  if (std::ranges::find(scripts_, path) != scripts_.end()) return refuse("the script '" + file + "' includes itself");
  if (scripts_.size() == kMaxScriptDepth)
    return refuse("scripts include each other more than " + std::to_string(kMaxScriptDepth) + " levels deep");
  scripts_.push_back(path);
  const RunResult result = run_script(script, file, skipping);
  scripts_.pop_back();
  return result;
}

// `REPEAT n command`
RunResult StatementRunner::repeat(const CommandText& command, const std::string& text) {
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || count < 0)
    return complain("repeat: expected a number of times and a command, found '" + text + "'", command.start);
  const std::string repeated = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  if (repeated.empty()) return complain("repeat: expected a command after the number", command.start);
  for (int turn = 0; turn < count; ++turn)
    if (const RunResult result = run({repeated, start_of(repeated, command)}); result != RunResult::ok) return result;
  return RunResult::ok;
}

}  // namespace queries
