#pragma once

#include <condition_variable>
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

  /// At most `most` sessions work at once; `idle` of them stay open without work.
  SessionPool(const algebra3d::Registry& registry, SessionOptions options, std::filesystem::path file, std::size_t most,
              std::size_t idle);
  /// Waits for the end of all work.
  ~SessionPool();
  SessionPool(const SessionPool&) = delete;
  SessionPool& operator=(const SessionPool&) = delete;

  /// Runs `work`, which must not throw, on the thread of a session. Errors: limit_exceeded if too many work already,
  /// those of opening the database.
  Status run(Work work);
  /// The number of sessions that work.
  std::size_t working() const;

 private:
  class Worker;

  Result<std::unique_ptr<Worker>> idle_or_new();
  Status take_place();
  void put_back(Worker& worker);

  const algebra3d::Registry& registry_;
  const SessionOptions options_;
  const std::filesystem::path file_;
  const std::size_t most_;
  const std::size_t most_idle_;

  mutable std::mutex mutex_;  // guards what follows
  std::size_t places_ = 0;    // of working_, and of those that are being opened
  std::vector<std::unique_ptr<Worker>> working_;
  std::vector<std::unique_ptr<Worker>> idle_;
  std::condition_variable changed_;
};

}  // namespace queries
