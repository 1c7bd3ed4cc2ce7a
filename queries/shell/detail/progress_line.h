#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

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

}  // namespace queries
