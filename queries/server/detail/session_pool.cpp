#include "queries/server/detail/session_pool.h"

#include <algorithm>
#include <future>
#include <utility>

#include "base/propagate.h"
#include "base/signal_block.h"
#include "base/without_exceptions.h"

namespace queries {

/// A session and its thread. The session is made, used and closed on the thread.
class SessionPool::Worker {
 public:
  explicit Worker(SessionPool& pool) : pool_(pool) {}
  ~Worker() {
    post({});
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts the thread and opens the database.
  Status open();
  /// Gives it work; it must have none. Without any, it ends.
  void post(Work work) {
    const std::lock_guard lock(mutex_);
    next_ = std::move(work);
    changed_.notify_all();
  }

 private:
  void work_until_closed(std::promise<Status>& opened);
  Work next_work();

  SessionPool& pool_;
  std::mutex mutex_;  // guards next_
  std::condition_variable changed_;
  std::optional<Work> next_;
  algebra3d::StackThread thread_;
};

Status SessionPool::Worker::open() {
  std::promise<Status> opened;
  std::future<Status> outcome = opened.get_future();
  const algebra3d::SignalBlock block;  // signals are for the main thread
  if (!thread_.start([this, &opened] { work_until_closed(opened); }))
    return Error{ErrorCode::out_of_memory, "not enough memory to start a thread"};
  return outcome.get();
}

SessionPool::Work SessionPool::Worker::next_work() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return next_.has_value(); });
  return *std::exchange(next_, std::nullopt);
}

void SessionPool::Worker::work_until_closed(std::promise<Status>& opened) {
  Session session(pool_.registry_, pool_.options_);
  Status status = algebra3d::without_exceptions([&] { return session.open_file(pool_.file_); });
  const bool is_open = status.ok();
  opened.set_value(std::move(status));
  if (!is_open) return;
  while (const Work work = next_work()) {
    work(session);
    pool_.put_back(*this);
  }
}

SessionPool::SessionPool(const algebra3d::Registry& registry, SessionOptions options, std::filesystem::path file,
                         const Limits& limits)
    : registry_(registry), options_(std::move(options)), file_(std::move(file)), limits_(limits) {}

SessionPool::~SessionPool() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return working_.empty(); });
  std::vector<std::unique_ptr<Worker>> idle = std::move(idle_);
  lock.unlock();
  idle.clear();
}

std::size_t SessionPool::working() const {
  const std::lock_guard lock(mutex_);
  return working_.size();
}

Status SessionPool::take_place() {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, limits_.patience, [this] { return places_ < limits_.most; }))
    return Error{ErrorCode::limit_exceeded, "{} statements run or have large results; the limit is {}", places_,
                 limits_.most};
  ++places_;
  return {};
}

Result<std::unique_ptr<SessionPool::Worker>> SessionPool::idle_or_new() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<Worker> worker = std::move(idle_.back());
      idle_.pop_back();
      return worker;
    }
  }
  auto worker = std::make_unique<Worker>(*this);
  if (Status opened = worker->open(); !opened) return std::move(opened).error();
  return worker;
}

Status SessionPool::run(Work work) {
  A3D_TRY(take_place());
  Result<std::unique_ptr<Worker>> worker = idle_or_new();
  const std::lock_guard lock(mutex_);
  if (!worker) {
    --places_;
    changed_.notify_all();
    return std::move(worker).error();
  }
  Worker& its_worker = **worker;
  working_.push_back(*std::move(worker));
  its_worker.post(std::move(work));
  return {};
}

// Called on the worker's thread, which cannot end itself: a session too many ends when the next one comes back.
void SessionPool::put_back(Worker& worker) {
  std::unique_ptr<Worker> surplus;
  const std::lock_guard lock(mutex_);
  const auto place = std::ranges::find_if(working_, [&](const auto& each) { return each.get() == &worker; });
  if (idle_.size() > limits_.idle) {
    surplus = std::move(idle_.front());
    idle_.erase(idle_.begin());
  }
  idle_.push_back(std::move(*place));
  working_.erase(place);
  --places_;
  changed_.notify_all();
}

}  // namespace queries
