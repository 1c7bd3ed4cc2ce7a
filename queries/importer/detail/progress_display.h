#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "queries/importer/detail/file_loader.h"
#include "queries/importer/detail/import_summary.h"

namespace queries {

/// Shows the progress of an import: on a terminal as a bar in one line, at most ten times a second, elsewhere as a line
/// every ten seconds. The stream outlives the display.
class ProgressDisplay {
 public:
  enum class Style : std::uint8_t { none, lines, bar };

  ProgressDisplay(std::ostream& stream, Style style) : stream_(stream), style_(style) {}
  /// Erases the bar.
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows the progress, unless it was shown very recently. `pending_count`: files that are not committed yet. A file
  /// that has been `at_work` for some seconds is named.
  void update(const ImportSummary& summary, std::uint64_t pending_count,
              const std::optional<FileLoader::AtWork>& at_work = {});
  /// Erases the bar before other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& stream_;
  Style style_;
  Clock::time_point last_ = Clock::now();
  bool is_shown_ = false;
};

/// The line of a bar, without control characters; fits into 80 columns except for extremely large numbers and long
/// names of files.
std::string progress_line(const ImportSummary& summary, std::uint64_t pending_count,
                          const std::optional<FileLoader::AtWork>& at_work = {});

}  // namespace queries
