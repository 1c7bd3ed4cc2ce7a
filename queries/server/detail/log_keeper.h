#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "queries/server/detail/kept_results.h"
#include "queries/server/detail/session_pool.h"
#include "queries/server/server_options.h"

namespace queries {

/// Keeps the write-ahead log of a database short. SQLite begins it anew when all readers have seen its end; kept
/// results are readers, so they leave the database for that (docs/decisions/0023-server.md).
class LogKeeper {
 public:
  /// `results` and `sessions` outlive the use of this object; the work of the sessions uses it. A server that only
  /// reads does not empty the log.
  LogKeeper(const std::filesystem::path& database, bool is_read_only, const ServerLimits& limits, KeptResults& results,
            SessionPool& sessions);

  /// To be called about every second, by one thread: empties a log that is long, for which small results leave the
  /// database, and drops the oldest result while the log is very long.
  void tend();

 private:
  void empty(std::uintmax_t bytes);

  const std::filesystem::path log_;
  const bool is_read_only_;
  const ServerLimits limits_;
  KeptResults& results_;
  SessionPool& sessions_;
  std::atomic<bool> is_emptying_ = false;
  std::atomic<std::uintmax_t> longest_;             // so long the log may become before it is emptied
  Execution::Clock::time_point last_attempt_ = {};  // to empty it
};

}  // namespace queries
