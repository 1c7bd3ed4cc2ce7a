#include "queries/importer/detail/progress_display.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"

namespace queries {
namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{10};
constexpr std::uint64_t kBarWidth = 10;

std::string figures(const ImportSummary& summary, std::uint64_t pending_count,
                    const std::optional<FileLoader::AtWork>& at_work) {
  constexpr std::chrono::seconds kLong{3};
  std::string text =
      fmt::format("{}/{} files, {:.1f} MB/s, {} undefined, {} in this batch", summary.done_count(), summary.file_count,
                  summary.megabytes_per_second(), summary.undefined_count, pending_count);
  if (!at_work || at_work->time < kLong) return text;
  return text + fmt::format(", {} for {} s",
                            algebra3d::shown_as_text(at_work->path.substr(at_work->path.rfind('/') + 1)),
                            std::chrono::duration_cast<std::chrono::seconds>(at_work->time).count());
}

}  // namespace

std::string progress_line(const ImportSummary& summary, std::uint64_t pending_count,
                          const std::optional<FileLoader::AtWork>& at_work) {
  // By bytes, which is what takes the time, and by files if all of them are empty.
  const std::uint64_t total = summary.byte_count > 0 ? summary.byte_count : summary.file_count;
  const std::uint64_t done = std::min(summary.byte_count > 0 ? summary.done_bytes : summary.done_count(), total);
  const auto filled = total == 0 ? kBarWidth
                                 : static_cast<std::uint64_t>(static_cast<double>(done) / static_cast<double>(total) *
                                                              static_cast<double>(kBarWidth));
  return fmt::format("[{:<{}}] {}", std::string(filled, '#'), kBarWidth, figures(summary, pending_count, at_work));
}

void ProgressDisplay::update(const ImportSummary& summary, std::uint64_t pending_count,
                             const std::optional<FileLoader::AtWork>& at_work) {
  if (style_ == Style::none) return;
  const auto now = Clock::now();
  if (style_ == Style::lines) {
    if (now - last_ < kLineInterval) return;
    last_ = now;
    stream_ << "import: " << figures(summary, pending_count, at_work) << std::endl;  // NOLINT(performance-avoid-endl)
    return;
  }
  if (is_shown_ && now - last_ < kBarInterval) return;
  last_ = now;
  is_shown_ = true;
  stream_ << "\r" << progress_line(summary, pending_count, at_work) << "\x1b[K" << std::flush;
}

void ProgressDisplay::clear() {
  if (is_shown_) stream_ << "\r\x1b[K" << std::flush;
  is_shown_ = false;
}

}  // namespace queries
