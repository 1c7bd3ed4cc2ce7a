#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <thread>

#include "queries/shell/detail/screen.h"

namespace queries {

/// Shows on a terminal that a statement is running: after `delay` a line with the elapsed time, updated every half
/// second and erased by `stop`. It is written by a separate thread; the stream must not be used otherwise until `stop`.
class ProgressLine {
 public:
  static constexpr std::chrono::milliseconds kDelay{2000};

  /// `what`: the beginning of the statement, for display. The stream outlives the object.
  ProgressLine(std::ostream& stream, std::string what, std::chrono::milliseconds delay = kDelay);
  ~ProgressLine() { stop(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Sets the progress of the statement, shown at the next update.
  void advance(const std::string& how_far);
  /// Erases the line before other output. May be called repeatedly.
  void stop();

 private:
  void run();

  std::ostream& stream_;
  std::string what_;
  std::chrono::milliseconds delay_;
  std::mutex mutex_;  // guards the members between here and the thread
  std::string how_far_;
  std::condition_variable stopped_;
  bool is_stopped_ = false;
  std::thread thread_;  // last member: it uses the others
};

/// `query Parts feed ...: running for 12 s, Ctrl-C ends it`, in at most `columns` columns, with `how_far` if it is not
/// empty and fits.
std::string progress_text(std::string_view what, std::string_view how_far, std::chrono::seconds elapsed,
                          std::size_t columns);

/// Buffers the output of a statement for the terminal. Output that fits on the screen is printed when the statement
/// ends; longer output goes to the pager while the statement runs. Between statements text is printed directly. While
/// nothing is shown, a progress line is displayed. Control characters are written as `\x1b`, whatever the format of
/// results, so that values cannot control the terminal. If the user leaves the pager early, the stream fails until the
/// statement ends. Used by one thread.
class TerminalOutput final : public std::streambuf {
 public:
  struct Settings {
    std::string pager = {};                             ///< a command of sh; empty: no pager
    std::function<ScreenSize()> screen = &screen_size;  ///< called when a statement begins
    std::ostream* progress = nullptr;                   ///< stream of the progress line; may be null
  };

  /// The stream of the terminal outlives the object.
  TerminalOutput(std::ostream& terminal, Settings settings) : terminal_(terminal), settings_(std::move(settings)) {}
  ~TerminalOutput() override { end_statement(); }
  TerminalOutput(const TerminalOutput&) = delete;
  TerminalOutput& operator=(const TerminalOutput&) = delete;

  /// `what` is the text of the statement.
  void begin_statement(const std::string& what, bool uses_pager);
  /// Sets the progress of the statement for the progress line.
  void advance(const std::string& how_far);
  /// Prints the buffered output, and waits until the user has left the pager.
  void end_statement();

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize length) override;
  int sync() override;

 private:
  bool take_printable(std::string_view text);
  bool take(std::string_view text);
  bool pass(std::string_view text);
  bool start_pager();
  bool is_longer_than_screen(std::string_view text);

  std::ostream& terminal_;
  Settings settings_;
  ScreenSize screen_;
  bool is_holding_ = false;
  std::string incomplete_;  // the first byte of a character whose second one has not come yet
  std::string held_;
  std::unique_ptr<ProgressLine> progress_;
  std::size_t row_count_ = 0;     // of the buffered output
  std::size_t column_count_ = 0;  // of its last row
  int pager_input_ = -1;
  int pager_process_ = -1;
};

/// The user's pager: `$PAGER`, else `less -FRX` if available, else none.
std::string usual_pager();

}  // namespace queries
