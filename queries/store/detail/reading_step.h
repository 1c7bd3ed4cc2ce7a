#pragma once

namespace queries {

/// While it exists, SQLite's steps on this thread hear the interruption scope (interruption_scope.h), if they only
/// read: SQLite would undo the whole transaction of a step that writes.
class ReadingStep {
 public:
  explicit ReadingStep(bool reads) : before_(reads_) { reads_ = reads; }
  ~ReadingStep() { reads_ = before_; }
  ReadingStep(const ReadingStep&) = delete;
  ReadingStep& operator=(const ReadingStep&) = delete;

  /// Whether the step that runs on this thread only reads, and is interrupted.
  static bool is_interrupted();

 private:
  static thread_local bool reads_;  // NOLINT(readability-identifier-naming): a member like others
  bool before_;
};

}  // namespace queries
