#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

namespace queries {

/// Shows on a terminal that a statement still runs: after `delay` a line with the elapsed time, renewed every half
/// second and erased by `stop`. A thread of its own writes it; the stream is used by nobody else until `stop`.
class ProgressLine {
 public:
  static constexpr std::chrono::milliseconds kDelay{2000};

  /// `what` is the beginning of the statement, as it is shown. The stream outlives the object.
  ProgressLine(std::ostream& stream, std::string what, std::chrono::milliseconds delay = kDelay);
  ~ProgressLine() { stop(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// How far the statement has come; shown when the line is next renewed.
  void advance(const std::string& how_far);
  /// Makes room for other text. May be called again.
  void stop();

 private:
  void run();

  std::ostream& stream_;
  std::string what_;
  std::chrono::milliseconds delay_;
  std::mutex mutex_;  // of what stands between here and the thread
  std::string how_far_;
  std::condition_variable stopped_;
  bool is_stopped_ = false;
  std::thread thread_;  // last: it uses the others
};

/// `query Parts feed ...: running for 12 s, Ctrl-C ends it`, in at most `columns` columns; `how_far`, if it is not
/// empty and there is room, stands in between.
std::string progress_text(std::string_view what, std::string_view how_far, std::chrono::seconds elapsed,
                          std::size_t columns);

}  // namespace queries
