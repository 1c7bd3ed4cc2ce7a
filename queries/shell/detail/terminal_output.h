#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "queries/shell/detail/progress_line.h"
#include "queries/shell/detail/screen.h"

namespace queries {

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
