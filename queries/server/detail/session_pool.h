#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/stack_thread.h"
#include "queries/session/session.h"

namespace queries {

/// Sessions on one database file, each on a thread of its own. All functions may be called by any thread.
class SessionPool {
 public:
  using Work = std::function<void(Session&)>;

  struct Limits {
    std::size_t most = 192;                    ///< sessions that work at once
    std::size_t idle = 8;                      ///< that stay open without work
    std::chrono::milliseconds patience{5000};  ///< until work for which no session is free is refused
  };

  SessionPool(const algebra3d::Registry& registry, SessionOptions options, std::filesystem::path file,
              const Limits& limits);
  /// Waits for the end of all work.
  ~SessionPool();
  SessionPool(const SessionPool&) = delete;
  SessionPool& operator=(const SessionPool&) = delete;

  /// Runs `work`, which must not throw, on the thread of a session, perhaps after it has waited for one. Errors:
  /// limit_exceeded if none became free in time, those of opening the database.
  Status run(Work work);
  /// The number of sessions that work.
  std::size_t working() const;
  /// Whether more than half of the sessions work.
  bool is_crowded() const { return working() > limits_.most / 2; }

 private:
  class Worker;

  Result<std::unique_ptr<Worker>> idle_or_new();
  Status take_place();
  void put_back(Worker& worker);

  const algebra3d::Registry& registry_;
  const SessionOptions options_;
  const std::filesystem::path file_;
  const Limits limits_;

  mutable std::mutex mutex_;  // guards what follows
  std::size_t places_ = 0;    // of working_, and of those that are being opened
  std::vector<std::unique_ptr<Worker>> working_;
  std::vector<std::unique_ptr<Worker>> idle_;
  std::condition_variable changed_;
};

}  // namespace queries
