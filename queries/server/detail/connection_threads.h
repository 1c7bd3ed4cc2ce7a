#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace queries {

/// Threads for requests, started as they are needed, up to a number of them; beyond it requests wait for one.
class ConnectionThreads {
 public:
  explicit ConnectionThreads(std::size_t most) : most_(most) {}
  ConnectionThreads(const ConnectionThreads&) = delete;
  ConnectionThreads& operator=(const ConnectionThreads&) = delete;
  ~ConnectionThreads() { shutdown(); }

  /// Runs a task, which must not throw, on a thread, now or when one is free.
  void start(std::function<void()> task);
  /// The number of tasks that wait for a thread.
  std::size_t waiting() const;
  /// Ends the threads when all tasks are done.
  void shutdown();

 private:
  void work();

  const std::size_t most_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;
  bool is_closing_ = false;
};

}  // namespace queries
