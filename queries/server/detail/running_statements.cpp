#include "queries/server/detail/running_statements.h"

#include <algorithm>

namespace queries {

std::string RunningStatements::new_id() {
  const std::lock_guard lock(mutex_);
  while (true)
    if (std::string id = "q" + std::to_string(++ids_); !by_id_.contains(id)) return id;
}

bool RunningStatements::add(const std::shared_ptr<Execution>& execution) {
  const std::lock_guard lock(mutex_);
  return by_id_.emplace(execution->request().id, execution).second;
}

void RunningStatements::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  by_id_.erase(id);
}

bool RunningStatements::cancel(const std::string& id, const std::string& why) {
  const std::lock_guard lock(mutex_);
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return false;
  found->second->cancel(why);
  return true;
}

void RunningStatements::cancel_all(const std::string& why) {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, execution] : by_id_) execution->cancel(why);
}

std::vector<std::shared_ptr<Execution>> RunningStatements::list() const {
  std::vector<std::shared_ptr<Execution>> result;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, execution] : by_id_) result.push_back(execution);
  }
  std::ranges::sort(result, std::ranges::less(), [](const auto& execution) { return execution->start(); });
  return result;
}

}  // namespace queries
