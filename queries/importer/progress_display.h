#pragma once

#include <chrono>
#include <cstdint>
#include <ostream>
#include <string>

#include "queries/importer/import_summary.h"

namespace queries {

/// Shows how far an import is: on a terminal as a bar in one line, ten times a second at most, elsewhere as a line
/// every ten seconds. The stream outlives the display.
class ProgressDisplay {
 public:
  enum class Style : std::uint8_t { none, lines, bar };

  ProgressDisplay(std::ostream& stream, Style style) : stream_(stream), style_(style) {}
  /// Ends the bar.
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows the state unless it has been shown just before. `pending_count`: files in the batch that is not committed.
  void update(const ImportSummary& summary, std::uint64_t pending_count);
  /// Makes room for other text.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& stream_;
  Style style_;
  Clock::time_point last_ = Clock::now();
  bool is_shown_ = false;
};

/// The line of a bar, without control characters; fits into 80 columns unless the figures are astronomic.
std::string progress_line(const ImportSummary& summary, std::uint64_t pending_count);

}  // namespace queries
