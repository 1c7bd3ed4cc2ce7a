#include "queries/shell/statement_runner.h"

#include <algorithm>
#include <iostream>

#include <fmt/format.h>

#include "algebra3d/types/utf8.h"
#include "queries/shell/interruption.h"

namespace queries {
namespace {

using algebra3d::Diagnostics;

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
  if (is_shell_command(command.text)) return run_shell_command(command.text);
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

RunResult StatementRunner::run_script(std::istream& script, const std::string& name, CommandReader::Skipping skipping) {
  CommandReader reader(name, skipping);
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
