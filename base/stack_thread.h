#pragma once

#include <pthread.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace algebra3d {

/// A thread with a stack large enough for statements: the maximum nesting of expressions and calls is fixed and must
/// not depend on `ulimit -s`. The stack uses memory only as far as it is used.
class StackThread {
 public:
  static constexpr std::size_t kStackBytes = std::size_t{64} << 20U;

  StackThread() = default;
  ~StackThread() { join(); }
  StackThread(const StackThread&) = delete;
  StackThread& operator=(const StackThread&) = delete;

  /// Runs `work`, which must not throw, on the thread, which rounds to nearest. False if the system has no memory for
  /// it. Not to be called while work is running.
  bool start(std::function<void()> work);
  /// Waits for the end of the work; does nothing if there is none.
  void join();

  /// Sets this stack size for all threads that the process starts from now on.
  static void make_default();

 private:
  std::function<void()> work_;
  pthread_t thread_ = {};
  bool is_running_ = false;
};

}  // namespace algebra3d
