#include "queries/server/detail/connection_threads.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

namespace queries {

void ConnectionThreads::start(std::function<void()> task) {
  const std::lock_guard lock(mutex_);
  tasks_.push_back(std::move(task));
  if (tasks_.size() > idle_ && threads_.size() < most_) {
    try {
      threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      // No memory for one more: the task waits for one of those that are there.
    }
  }
  changed_.notify_one();
}

std::size_t ConnectionThreads::waiting() const {
  const std::lock_guard lock(mutex_);
  return tasks_.size() - std::min(tasks_.size(), idle_);
}

void ConnectionThreads::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    ++idle_;
    changed_.wait(lock, [this] { return is_closing_ || !tasks_.empty(); });
    --idle_;
    if (tasks_.empty()) return;
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    try {
      task();
    } catch (const std::bad_alloc&) {
      // There is no memory for this request: its connection is closed, and the others go on.
    }
    lock.lock();
  }
}

void ConnectionThreads::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
    changed_.notify_all();
  }
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
}

}  // namespace queries
