#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "queries/server/detail/execution.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// The statements that have not answered yet, by their ids. All functions may be called by any thread.
class RunningStatements {
 public:
  /// A new id, for a statement that was given none.
  std::string new_id();
  /// Adds a statement under the id of its request. False if a statement of this id runs.
  bool add(const std::shared_ptr<Execution>& execution);
  void remove(const std::string& id);
  /// Cancels a statement. False if there is none of this id.
  bool cancel(const std::string& id, const std::string& why);
  void cancel_all(const std::string& why);
  /// The statements, longest running first.
  std::vector<std::shared_ptr<Execution>> list() const;

 private:
  mutable std::mutex mutex_;  // guards what follows
  std::map<std::string, std::shared_ptr<Execution>> by_id_;
  std::uint64_t ids_ = 0;
};

}  // namespace queries
