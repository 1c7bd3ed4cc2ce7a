#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "queries/server/detail/execution.h"
#include "queries/server/detail/refusal.h"
#include "queries/server/server_options.h"

namespace queries {

/// The results that clients can ask, by their ids: `r` and a number, which begins at a random one in each run of the
/// server, so that a page that is still open never gets the result of another run for its own. Beyond a number of them
/// for one client its one that was not used for longest is dropped, and so is one that nobody has used for a quarter of
/// an hour. Where all together are too many, or take too much, the client that holds most gives first; results that
/// have just been made and not been asked go last. All functions may be called by any thread.
class KeptResults {
 public:
  explicit KeptResults(const ServerLimits& limits);
  /// Drops all of them.
  ~KeptResults();
  KeptResults(const KeptResults&) = delete;
  KeptResults& operator=(const KeptResults&) = delete;

  /// Keeps the result of a statement for its client and returns its id.
  std::string keep(std::shared_ptr<Execution> execution);
  /// The result of this id. Refusals: not_found, gone.
  Reply<std::shared_ptr<Execution>> find(const std::string& id);
  /// Drops a result. False if there is none of this id.
  bool drop(const std::string& id);
  void drop_all();
  /// Drops what nobody has used for long, and results as long as copies take more than they may.
  void drop_what_is_too_much();
  /// Drops the result that was not used for longest of those that read the database, if there is one.
  void drop_oldest_reader();
  /// Has results give their sessions back, since others need them: small ones leave the database, and of those that
  /// cannot so many are dropped that the others hold no more than they may.
  void release_sessions();
  /// Drops results as long as they and others take more than half of the process's memory limit, and waits shortly for
  /// their memory.
  void make_room();
  /// Has all results leave the database, also those that come before `may_stay`, and waits for those that are there.
  void leave_database(Execution::Clock::time_point deadline);
  void may_stay();

 private:
  struct Kept {
    std::shared_ptr<Execution> execution;
    Execution::Clock::time_point used;
    bool is_asked = false;
    bool was_to_leave = false;  // whether it was asked to, because others need its session
  };
  using Results = std::map<std::uint64_t, Kept>;
  using Choice = std::function<bool(const Kept&)>;

  static bool is_any(const Kept&) { return true; }
  static bool holds_session(const Kept& kept) { return kept.execution->holds_session(); }
  std::vector<Results::iterator> those(const Choice& choice);
  Results::iterator oldest(const Choice& choice);
  Results::iterator next_to_go(const Choice& choice);
  void drop(Results::iterator result);

  const ServerLimits limits_;
  std::mutex mutex_;  // guards what follows
  Results results_;
  bool are_to_leave_ = false;  // whether new results leave the database, too
  std::uint64_t last_;
};

}  // namespace queries
