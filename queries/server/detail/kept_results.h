#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "queries/server/detail/execution.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// The results that clients can ask, by their ids: `r` and a number, which begins at a random one in each run of the
/// server, so that a page that is still open never gets the result of another run for its own. Beyond a number of them
/// the one that was not used for longest is dropped, and so is one that nobody has used for a quarter of an hour. All
/// functions may be called by any thread.
class KeptResults {
 public:
  explicit KeptResults(std::size_t most);
  /// Drops all of them.
  ~KeptResults();
  KeptResults(const KeptResults&) = delete;
  KeptResults& operator=(const KeptResults&) = delete;

  /// Keeps the result of a statement and returns its id.
  std::string keep(std::shared_ptr<Execution> execution);
  /// The result of this id. Refusals: not_found, gone.
  Reply<std::shared_ptr<Execution>> find(const std::string& id);
  /// Drops a result. False if there is none of this id.
  bool drop(const std::string& id);
  void drop_all();
  /// Drops what nobody has used for long.
  void drop_what_is_old();
  /// Drops the result that was not used for longest, if there is one.
  void drop_oldest();
  /// Drops results as long as they and others take more than half of the process's memory limit, those first that were
  /// not used for longest, and waits shortly for their memory.
  void make_room();
  /// Has all results leave the database, also those that come before `may_stay`, and waits for those that are there.
  void leave_database(Execution::Clock::time_point deadline);
  void may_stay();

 private:
  struct Kept {
    std::shared_ptr<Execution> execution;
    Execution::Clock::time_point used;
  };
  std::map<std::uint64_t, Kept>::iterator oldest();
  void drop(std::map<std::uint64_t, Kept>::iterator result);

  const std::size_t most_;
  std::mutex mutex_;  // guards what follows
  std::map<std::uint64_t, Kept> results_;
  bool are_to_leave_ = false;  // whether new results leave the database, too
  std::uint64_t last_;
};

}  // namespace queries
