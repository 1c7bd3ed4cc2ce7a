#include "queries/shell/detail/statement_runner.h"

#include <algorithm>
#include <array>
#include <chrono>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/diagnostics.h"
#include "base/memory_limit.h"
#include "base/without_exceptions.h"
#include "queries/language/parser.h"
#include "queries/shell/detail/interruption.h"
#include "queries/shell/detail/screen.h"

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

/// A line or command that is longer than any that was meant: a device that never ends, or a file that is not a script.
constexpr std::size_t kLongestCommand = std::size_t{1} << 30U;

// As std::getline, but stops reading behind the limit.
bool read_line(std::istream& script, std::string& line) {
  constexpr std::size_t kPiece = 4096;
  std::array<char, kPiece> piece{};
  line.clear();
  const std::size_t longest = std::min(kLongestCommand, algebra3d::memory_left() / 8);
  while (line.size() <= longest) {
    script.getline(piece.data(), piece.size());
    const auto count = static_cast<std::size_t>(script.gcount());
    const bool ends_here = script.good();
    line.append(piece.data(), ends_here ? count - 1 : count);  // the line end counts
    if (ends_here) return true;
    if (script.eof() || script.bad()) return !line.empty();
    script.clear();
  }
  return true;
}

std::optional<TransactionStep::Step> transaction_step(const CommandText& command, const algebra3d::Registry& registry) {
  const auto parsed =
      algebra3d::without_exceptions([&] { return parse_command(command.text, registry, command.start); });
  const auto* step = parsed ? std::get_if<TransactionStep>(&parsed->content) : nullptr;
  return step != nullptr ? std::optional(step->step) : std::nullopt;
}

/// Results as the user wants them, and how far a statement has come to the terminal.
class TerminalPresenter final : public Presenter {
 public:
  TerminalPresenter(Presenter& results, TerminalOutput* terminal, bool is_script)
      : results_(results), terminal_(terminal), is_script_(is_script) {}
  Status present(const TypeExpr& type, const Datum& value, Context& context) override {
    return results_.present(type, value, context);
  }
  Status present_inquiry(const NestedList& result) override { return results_.present_inquiry(result); }
  bool ends_at_failed_result() const override { return is_script_; }
  void advance(const std::string& how_far) override {
    if (terminal_ != nullptr) terminal_->advance(how_far);
  }

 private:
  Presenter& results_;
  TerminalOutput* terminal_;
  bool is_script_;
};

}  // namespace

Status StatementRunner::execute(const CommandText& command, Context& context) {
  const auto start = std::chrono::steady_clock::now();
  if (console_.terminal != nullptr) console_.terminal->begin_statement(command.text, session_.options().uses_pager);
  TerminalPresenter presenter(presenter_, console_.terminal, script_depth_ > 0);
  const algebra3d::Monitor::Report report = [&](const std::string& how_far) { presenter.advance(how_far); };
  context.report = &report;
  Status status = session_.execute(command.text, command.start, presenter, context);
  context.report = nullptr;
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
  if (failed_begin_) return refuse(command);
  Diagnostics diagnostics;
  Context context{diagnostics, &Interruption::flag(), {}};
  const Status status = execute(command, context);
  for (const std::string& line : diagnostics.summary()) console_.errors << "note: " << shown(line) << "\n";
  const RunResult result = conclude(command, status);
  return result == RunResult::ok ? judge_values(command, diagnostics) : result;
}

// A script is asked whether it did what it was to do, so a file that could not be read or written is a failure of the
// statement that was to do just this. At the prompt the note says it.
RunResult StatementRunner::judge_values(const CommandText& command, const Diagnostics& diagnostics) {
  using About = Diagnostics::About;
  if (script_depth_ == 0) return RunResult::ok;
  if (const std::string_view failed = session_.failed_result(); !failed.empty())
    return complain(fmt::format("the statement has failed: its result is {}", failed), command.start);
  const std::uint64_t count =
      diagnostics.count(About::undefined) + diagnostics.count(About::unreadable) + diagnostics.count(About::unwritten);
  if (!rules_.fails_on_undefined || count == 0) return RunResult::ok;
  return complain(fmt::format("{} value{} undefined, or FALSE for a file that was not written (--fail-on-undefined)",
                              count, count == 1 ? " is" : "s are"),
                  command.start);
}

RunResult StatementRunner::conclude(const CommandText& command, const Status& status) {
  const bool is_interrupted = status ? Interruption::flag().load() : status.error().code == ErrorCode::interrupted;
  // The terminal has written ^C where the cursor stood.
  if (is_interrupted && console_.terminal != nullptr) console_.errors << "\n";
  if (!status) {
    complain(status.error().text(), status.error().place);
    const bool has_begun = session_.store() != nullptr && session_.store()->is_in_explicit_transaction();
    if (script_depth_ > 0 && !has_begun &&
        transaction_step(command, session_.registry()) == TransactionStep::Step::begin)
      failed_begin_ = command.start;
    if (!is_interrupted) return RunResult::failed;
  } else if (is_interrupted) {
    // The signal came when the statement was as good as done; those that follow are not to run.
    complain("interrupted after this statement", command.start);
  } else {
    return RunResult::ok;
  }
  Interruption::reset();
  return RunResult::interrupted;
}

// A statement of a transaction that could not begin would be committed at once, and no abort would undo it.
RunResult StatementRunner::refuse(const CommandText& command) {
  using Step = TransactionStep::Step;
  const auto step = transaction_step(command, session_.registry());
  const std::string why =
      fmt::format("the transaction of {}:{} could not begin", failed_begin_->file, failed_begin_->line);
  if (!step) return complain("not run, since " + why, command.start);
  failed_begin_.reset();
  if (*step == Step::begin) return run(command);
  return *step == Step::abort ? RunResult::ok : complain("nothing is committed, since " + why, command.start);
}

RunResult StatementRunner::complain(const std::string& message, const SourcePlace& place) {
  console_.errors << place_text(place) << "error: " << shown(message) << "\n";
  console_.errors.flush();
  return RunResult::failed;
}

RunResult StatementRunner::run_script(std::istream& script, const std::string& name, CommandReader::Skipping skipping) {
  CommandReader reader(name, skipping);
  ++script_depth_;
  const RunResult result = run_lines(script, reader);
  --script_depth_;
  if (script_depth_ == 0) failed_begin_.reset();
  return result;
}

// A failure stays a failure, whatever follows, unless the user interrupts.
RunResult StatementRunner::run_lines(std::istream& script, CommandReader& reader) {
  bool has_failed = false;
  for (std::string line; read_line(script, line);) {
    if (line.size() + reader.pending_size() > kLongestCommand)
      return complain("a command of more than 1 GB; is this a script?", {reader.file(), reader.line() + 1, 1});
    const RunResult result = run_all(reader.add_line(line), has_failed);
    if (result == RunResult::quit && has_failed) return RunResult::failed;
    if (result != RunResult::ok) return result;
  }
  if (Interruption::flag().load()) {
    complain("interrupted while the script was read", {reader.file(), reader.line(), 1});
    Interruption::reset();
    return RunResult::interrupted;
  }
  if (script.bad()) return complain("the script cannot be read to its end", {reader.file(), reader.line(), 1});
  if (auto last = reader.finish()) {
    const RunResult result = run_all({std::move(*last)}, has_failed);
    if (result != RunResult::ok) return result;
  }
  if (const auto block = reader.open_block())
    return complain("this comment is not closed by a line that begins with */; what follows was not run", *block);
  return has_failed ? RunResult::failed : RunResult::ok;
}

// `ok` if the script goes on.
RunResult StatementRunner::run_all(const std::vector<CommandText>& commands, bool& has_failed) {
  for (const CommandText& command : commands) {
    const RunResult result = run(command);
    has_failed = has_failed || result == RunResult::failed;
    if (result == RunResult::quit || result == RunResult::interrupted) return result;
    if (result == RunResult::failed && rules_.stops_on_error) return result;
  }
  return RunResult::ok;
}

}  // namespace queries
