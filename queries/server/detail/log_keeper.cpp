#include "queries/server/detail/log_keeper.h"

#include <chrono>
#include <system_error>

namespace queries {

LogKeeper::LogKeeper(const std::filesystem::path& database, bool is_read_only, const ServerLimits& limits,
                     KeptResults& results, SessionPool& sessions)
    : log_(database.native() + "-wal"),
      is_read_only_(is_read_only),
      limits_(limits),
      results_(results),
      sessions_(sessions),
      longest_(limits.usual_log_bytes) {}

void LogKeeper::tend() {
  constexpr std::chrono::seconds kBetweenAttempts(30);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(log_, error);
  if (error) return;
  if (bytes > limits_.log_bytes) results_.drop_oldest_reader();
  if (is_read_only_) return;
  const bool is_time = Execution::Clock::now() - last_attempt_ > kBetweenAttempts;
  if (bytes > (is_time ? limits_.usual_log_bytes : longest_.load())) empty(bytes);
}

// Where readers follow one another without a gap, that needs a pause of the writers. After a failure the next attempt
// comes when the log has grown again, or half a minute later: SQLite may begin the log anew without making it shorter.
void LogKeeper::empty(std::uintmax_t bytes) {
  static constexpr int kLongestPause = 500;  // milliseconds
  static constexpr std::chrono::seconds kLongestWait(5);
  if (is_emptying_.exchange(true)) return;
  last_attempt_ = Execution::Clock::now();
  const Status started = sessions_.run([this, bytes](Session& session) {
    results_.leave_database(Execution::Clock::now() + kLongestWait);
    const Result<bool> is_empty = session.store()->empty_log(kLongestPause);
    results_.may_stay();
    longest_ = limits_.usual_log_bytes + (is_empty && *is_empty ? 0 : bytes);
    is_emptying_ = false;
  });
  if (!started) is_emptying_ = false;
}

}  // namespace queries
