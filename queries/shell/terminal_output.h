#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "queries/shell/progress_line.h"
#include "queries/shell/screen.h"

namespace queries {

/// What a statement shows, on its way to the terminal. It is held back until it fills the screen: what fits is printed
/// when the statement ends, what does not goes through the pager, which gets it while the statement runs. Between
/// statements text passes through. As long as nothing is shown, a long statement says that it still runs. If the user
/// leaves the pager early the stream fails until the statement ends. Used by one thread.
class TerminalOutput final : public std::streambuf {
 public:
  struct Settings {
    std::string pager = {};                             ///< a command of sh; empty: there is none
    std::function<ScreenSize()> screen = &screen_size;  ///< asked when a statement begins
    std::ostream* progress = nullptr;                   ///< where a long statement says that it runs; null: nowhere
  };

  /// The stream of the terminal outlives the object.
  TerminalOutput(std::ostream& terminal, Settings settings) : terminal_(terminal), settings_(std::move(settings)) {}
  ~TerminalOutput() override { end_statement(); }
  TerminalOutput(const TerminalOutput&) = delete;
  TerminalOutput& operator=(const TerminalOutput&) = delete;

  /// `what` is the text of the statement.
  void begin_statement(const std::string& what, bool uses_pager);
  /// How far the statement has come, for the line that says that it still runs.
  void advance(const std::string& how_far);
  /// Shows what is held back, and waits until the user has left the pager.
  void end_statement();

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize length) override;
  int sync() override;

 private:
  bool take(std::string_view text);
  bool pass(std::string_view text);
  bool start_pager();
  bool is_longer_than_screen(std::string_view text);

  std::ostream& terminal_;
  Settings settings_;
  ScreenSize screen_;
  bool is_holding_ = false;
  std::string held_;
  std::unique_ptr<ProgressLine> progress_;
  std::size_t row_count_ = 0;     // of what is held back
  std::size_t column_count_ = 0;  // of its last row
  int pager_input_ = -1;
  int pager_process_ = -1;
};

/// The pager that the user wants: `$PAGER`, or `less -FRX` if there is one, or none.
std::string usual_pager();

}  // namespace queries
