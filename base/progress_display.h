#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

namespace algebra3d {

/// Shows the progress of a command: on a terminal as a bar in one line, at most ten times a second, elsewhere as a line
/// every ten seconds. The stream outlives the display.
class ProgressDisplay {
 public:
  enum class Style : std::uint8_t { none, lines, bar };

  /// `command` begins the lines, and is a literal.
  ProgressDisplay(std::ostream& stream, Style style, std::string_view command)
      : stream_(stream), style_(style), command_(command) {}
  /// Erases the bar.
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// The bar on a terminal, else lines; nothing if `is_quiet`.
  static Style usual_style(bool is_quiet, bool is_terminal) {
    if (is_quiet) return Style::none;
    return is_terminal ? Style::bar : Style::lines;
  }

  /// Shows the progress, unless it was shown very recently: how much is done, as a part of 1, and a text, which is made
  /// when it is needed.
  void update(double part, const std::function<std::string()>& text);
  /// Erases the bar before other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& stream_;
  Style style_;
  std::string_view command_;
  Clock::time_point last_ = Clock::now();
  bool is_shown_ = false;
};

/// The line of a bar, without control characters: ten columns for the bar, then the text.
std::string progress_line(double part, std::string_view text);

/// A number with separators: "1,234,567".
std::string grouped(std::uint64_t number);

}  // namespace algebra3d
