#include "base/progress_display.h"

#include <algorithm>

#include <fmt/format.h>

namespace algebra3d {
namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{10};
constexpr std::size_t kBarWidth = 10;

}  // namespace

std::string progress_line(double part, std::string_view text) {
  const auto filled = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * static_cast<double>(kBarWidth));
  return fmt::format("[{:<{}}] {}", std::string(filled, '#'), kBarWidth, text);
}

void ProgressDisplay::update(double part, const std::function<std::string()>& text) {
  if (style_ == Style::none) return;
  const auto now = Clock::now();
  if (style_ == Style::lines) {
    if (now - last_ < kLineInterval) return;
    last_ = now;
    stream_ << command_ << ": " << text() << std::endl;  // NOLINT(performance-avoid-endl)
    return;
  }
  if (is_shown_ && now - last_ < kBarInterval) return;
  last_ = now;
  is_shown_ = true;
  stream_ << "\r" << progress_line(part, text()) << "\x1b[K" << std::flush;
}

void ProgressDisplay::clear() {
  if (is_shown_) stream_ << "\r\x1b[K" << std::flush;
  is_shown_ = false;
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

}  // namespace algebra3d
