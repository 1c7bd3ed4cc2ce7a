#include "queries/shell/statement_runner.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "algebra3d/types/utf8.h"
#include "queries/shell/interruption.h"
#include "queries/shell/screen.h"

namespace queries {
namespace {

using algebra3d::Diagnostics;

std::string place_text(const SourcePlace& place) {
  if (!place.is_known()) return "";
  return fmt::format("{}:{}:{}: ", place.file.empty() ? "input" : place.file, place.line, place.column);
}

// Messages repeat what was typed or stands in a file: neither control characters must reach the terminal, nor
// megabytes.
std::string shown(std::string_view message) {
  constexpr std::size_t kLongest = 4000;
  const std::string_view kept = algebra3d::utf8_prefix(message, kLongest);
  const std::string text = printable(kept);
  return kept.size() < message.size() ? text + fmt::format("... ({} bytes)", message.size()) : text;
}

std::string time_text(std::chrono::steady_clock::duration elapsed) {
  constexpr double kLongestInMilliseconds = 10000;
  const double milliseconds = std::chrono::duration<double, std::milli>(elapsed).count();
  return milliseconds < kLongestInMilliseconds ? fmt::format("{:.1f} ms", milliseconds)
                                               : fmt::format("{:.1f} s", milliseconds / 1000);
}

/// Results as the user wants them, and how far a statement has come to the terminal.
class TerminalPresenter final : public Presenter {
 public:
  TerminalPresenter(Presenter& results, TerminalOutput* terminal) : results_(results), terminal_(terminal) {}
  Status present(const TypeExpr& type, const Datum& value, Context& context) override {
    return results_.present(type, value, context);
  }
  Status present_inquiry(const NestedList& result) override { return results_.present_inquiry(result); }
  void advance(const std::string& how_far) override {
    if (terminal_ != nullptr) terminal_->advance(how_far);
  }

 private:
  Presenter& results_;
  TerminalOutput* terminal_;
};

}  // namespace

Status StatementRunner::execute(const CommandText& command, Context& context) {
  const auto start = std::chrono::steady_clock::now();
  if (console_.terminal != nullptr) console_.terminal->begin_statement(command.text, session_.options().uses_pager);
  TerminalPresenter presenter(presenter_, console_.terminal);
  Status status = session_.execute(command.text, command.start, presenter, context);
  const auto end = std::chrono::steady_clock::now();
  if (console_.terminal != nullptr) {
    console_.terminal->end_statement();
    console_.out.clear();  // it has failed if the user has left the pager
  }
  console_.out.flush();
  if (session_.options().shows_timing) console_.errors << time_text(end - start) << "\n";
  return status;
}

RunResult StatementRunner::run(const CommandText& command) {
  if (is_shell_command(command.text)) return run_shell_command(command);
  Diagnostics diagnostics;
  Context context{diagnostics, &Interruption::flag(), {}};
  const Status status = execute(command, context);
  for (const std::string& line : diagnostics.summary()) console_.errors << "note: " << shown(line) << "\n";
  if (!status) {
    const bool is_interrupted = status.error().code == ErrorCode::interrupted;
    complain(status.error().message, status.error().place);
    if (!is_interrupted) return RunResult::failed;
  } else if (Interruption::flag()) {
    // The signal came when the statement was as good as done; those that follow are not to run.
    complain("interrupted after this statement", command.start);
  } else {
    return RunResult::ok;
  }
  Interruption::reset();
  return RunResult::interrupted;
}

RunResult StatementRunner::complain(const std::string& message, const SourcePlace& place) {
  console_.errors << place_text(place) << "error: " << shown(message) << "\n";
  console_.errors.flush();
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
