#include "queries/shell/statement_runner.h"

#include <algorithm>
#include <cctype>
#include <iostream>

#include <fmt/format.h>

#include "algebra3d/registry/documentation.h"
#include "algebra3d/types/utf8.h"
#include "queries/shell/interruption.h"

namespace queries {
namespace {

using algebra3d::Diagnostics;

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string place_text(const SourcePlace& place) {
  if (!place.is_known()) return "";
  return fmt::format("{}:{}:{}: ", place.file.empty() ? "input" : place.file, place.line, place.column);
}

// Messages repeat what was typed or stands in a file: control characters must not reach the terminal, nor megabytes.
std::string shown(std::string_view message) {
  constexpr std::size_t kLongest = 4000;
  std::size_t end = std::min(message.size(), kLongest);
  while (end < message.size() && end > 0 && algebra3d::is_utf8_continuation(message[end])) --end;
  std::string text;
  for (const char c : message.substr(0, end)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < ' ' && c != '\n' && c != '\t') || byte == 0x7F)
      text += fmt::format("\\x{:02x}", byte);
    else
      text += c;
  }
  if (end < message.size()) text += fmt::format("... ({} bytes)", message.size());
  return text;
}

}  // namespace

RunResult StatementRunner::run(const CommandText& command) {
  const std::string word = lower_case(command.text.substr(0, command.text.find_first_of(" \t\n")));
  if (word == "q" || word == "quit") return RunResult::quit;
  if ((word == "help" || word == "?") && run_help(command.text.substr(word.size()))) return RunResult::ok;
  Diagnostics diagnostics;
  Context context{diagnostics, &Interruption::flag(), {}};
  const Status status = session_.execute(command.text, command.start, presenter_, context);
  std::cout.flush();
  for (const std::string& line : diagnostics.summary()) errors_ << "note: " << shown(line) << "\n";
  if (status) return RunResult::ok;
  errors_ << place_text(status.error().place) << "error: " << shown(status.error().message) << "\n";
  errors_.flush();
  if (status.error().code == ErrorCode::interrupted) {
    Interruption::reset();
    return RunResult::interrupted;
  }
  return RunResult::failed;
}

bool StatementRunner::run_help(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\n");
  if (begin == std::string::npos) {
    std::cout << algebra3d::help_overview(session_.registry());
    return true;
  }
  const std::string name = text.substr(begin);
  const algebra3d::Operator* op = session_.registry().find_operator(name);
  if (op == nullptr) {
    const std::string suggestion = session_.registry().suggestion(name);
    errors_ << "error: there is no operator '" << name << "'"
            << (suggestion.empty() ? "" : ", did you mean '" + suggestion + "'?") << "\n";
    return true;
  }
  std::cout << algebra3d::help_text(*op);
  return true;
}

RunResult StatementRunner::run_script(std::istream& script, const std::string& name) {
  CommandReader reader(name);
  RunResult worst = RunResult::ok;
  const auto run_all = [&](const std::vector<CommandText>& commands) {
    for (const CommandText& command : commands) {
      const RunResult result = run(command);
      if (result != RunResult::ok) worst = result;
      if (result == RunResult::quit || result == RunResult::interrupted) return false;
      if (result == RunResult::failed && stops_on_error_) return false;
    }
    return true;
  };
  bool has_failed = false;
  for (std::string line; std::getline(script, line);) {
    const bool goes_on = run_all(reader.add_line(line));
    has_failed = has_failed || worst == RunResult::failed;
    if (!goes_on) return worst == RunResult::quit && has_failed ? RunResult::failed : worst;
  }
  if (auto last = reader.finish()) run_all({std::move(*last)});
  return has_failed && worst == RunResult::ok ? RunResult::failed : worst;
}

}  // namespace queries
