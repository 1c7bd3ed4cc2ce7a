#include "queries/shell/detail/progress_line.h"

#include <algorithm>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/signal_block.h"
#include "queries/shell/detail/screen.h"

namespace queries {
namespace {

constexpr std::chrono::milliseconds kInterval{500};

std::string duration_text(std::chrono::seconds elapsed) {
  const auto seconds = elapsed.count();
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{}:{:02} min", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02} h", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace

std::string progress_text(std::string_view what, std::string_view how_far, std::chrono::seconds elapsed,
                          std::size_t columns) {
  constexpr std::size_t kLongest = 50;
  std::string rest = fmt::format("running for {}, Ctrl-C ends it", duration_text(elapsed));
  const std::string between = printable(how_far);
  const bool has_room = between.size() <= kLongest && between.size() + rest.size() + kLongest / 2 <= columns;
  rest = between.empty() || !has_room ? ": " + rest : fmt::format(": {}, {}", between, rest);
  const std::size_t room = std::min(kLongest, columns > rest.size() ? columns - rest.size() - 1 : 0);
  std::string shown = printable(what.substr(0, what.find('\n')));
  if (shown.size() < what.size() || shown.size() > room)
    shown = std::string(algebra3d::utf8_prefix(shown, room > 3 ? room - 3 : 0)) + "...";
  return shown + rest;
}

ProgressLine::ProgressLine(std::ostream& stream, std::string what, std::chrono::milliseconds delay)
    : stream_(stream), what_(std::move(what)), delay_(delay) {
  // Signals are for the thread that runs the statement.
  const algebra3d::SignalBlock block;
  thread_ = std::thread([this] { run(); });
}

void ProgressLine::advance(const std::string& how_far) {
  const std::lock_guard lock(mutex_);
  how_far_ = how_far;
}

void ProgressLine::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

void ProgressLine::run() {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  if (stopped_.wait_for(lock, delay_, [this] { return is_stopped_; })) return;
  do {
    const auto elapsed = std::chrono::steady_clock::now() - start;
    stream_ << '\r'
            << progress_text(what_, how_far_, std::chrono::duration_cast<std::chrono::seconds>(elapsed),
                             screen_size().columns)
            << "\x1b[K" << std::flush;
  } while (!stopped_.wait_for(lock, kInterval, [this] { return is_stopped_; }));
  stream_ << "\r\x1b[K" << std::flush;
}

}  // namespace queries
