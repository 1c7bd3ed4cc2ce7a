#include "queries/database/detail/handover.h"

#include <utility>

#include "algebra3d/base/monitor.h"

namespace algebra3d::database::detail {

void Handover::put_columns(ColumnsPtr columns) {
  const std::lock_guard lock(mutex_);
  columns_ = std::move(columns);
  changed_.notify_all();
}

Status Handover::put_rows(std::vector<Row> rows) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !rows_ || is_abandoned_; });
  if (is_abandoned_) return Monitor::interrupted();
  rows_ = std::move(rows);
  changed_.notify_all();
  return {};
}

Status Handover::await_end() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return (!rows_ && is_asked_) || is_abandoned_; });
  if (is_abandoned_) return Monitor::interrupted();
  return {};
}

void Handover::tell(const std::string& how_far) {
  const std::lock_guard lock(mutex_);
  how_far_ = how_far;
  changed_.notify_all();
}

void Handover::finish(Status status, Report report) {
  const std::lock_guard lock(mutex_);
  status_ = std::move(status);
  report_ = std::move(report);
  is_finished_ = true;
  changed_.notify_all();
}

template <typename Condition>
void Handover::wait_until(std::unique_lock<std::mutex>& lock, const Tell& tell, const Condition& condition) {
  while (!condition()) {
    if (!how_far_) changed_.wait(lock);
    auto how_far = std::exchange(how_far_, std::nullopt);
    if (!how_far || !tell) continue;
    lock.unlock();
    tell(*how_far);
    lock.lock();
  }
}

ColumnsPtr Handover::wait_for_columns(const Tell& tell) {
  std::unique_lock lock(mutex_);
  wait_until(lock, tell, [this] { return columns_ != nullptr || is_finished_; });
  return columns_;
}

std::optional<std::vector<Row>> Handover::take_rows(const Tell& tell) {
  std::unique_lock lock(mutex_);
  is_asked_ = true;
  changed_.notify_all();
  wait_until(lock, tell, [this] { return rows_ || is_finished_; });
  is_asked_ = false;
  auto rows = std::exchange(rows_, std::nullopt);
  changed_.notify_all();
  return rows;
}

void Handover::abandon() {
  std::unique_lock lock(mutex_);
  is_abandoned_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return is_finished_; });
}

}  // namespace algebra3d::database::detail
