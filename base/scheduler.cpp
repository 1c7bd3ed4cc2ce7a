#include "base/scheduler.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <pthread.h>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/nearest_rounding.h"

namespace algebra3d {
namespace {

/// Ends the threads of oneTBB before the process forks: a child has the thread that forked and no other one, and the
/// scheduler would wait for its workers' help in vain.
class ForkGuard {
 public:
  /// Once before each use of the scheduler.
  static void prepare() {
    static ForkGuard guard;
    if (!guard.is_attached_.load(std::memory_order_acquire)) guard.attach();
  }

 private:
  ForkGuard() {
    self_ = this;
    pthread_atfork([] { self_->end_threads(); }, nullptr, nullptr);
  }

  void attach() {
    const std::lock_guard lock(mutex_);
    if (!handle_) handle_.emplace(tbb::attach{});
    is_attached_.store(true, std::memory_order_release);
  }

  void end_threads() {
    const std::lock_guard lock(mutex_);
    // Refused while other threads have tasks; these go on in the parent.
    if (handle_) static_cast<void>(tbb::finalize(*handle_, std::nothrow));
    handle_.reset();
    is_attached_.store(false, std::memory_order_release);
  }

  inline static ForkGuard* self_ = nullptr;  // NOLINT(readability-identifier-naming): a member like others
  std::atomic<bool> is_attached_ = false;
  std::mutex mutex_;
  std::optional<tbb::task_scheduler_handle> handle_;
};

}  // namespace

namespace {

// oneTBB tells nobody but the text that the system had no memory, or no number, for another thread.
template <typename Work>
void with_workers(const Work& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    if (std::string_view(error.what()).starts_with("pthread_create")) throw std::bad_alloc();
    throw;
  }
}

// Where a task of a call throws, oneTBB also cancels the calls within its other tasks. These then return as if they had
// done their work; the caller must not go on with what they left undone. The exception that is thrown for them is
// dropped in favour of the first one.
void throw_if_cancelled(bool is_cancelled) {
  if (is_cancelled) detail::throw_interrupted();
}

}  // namespace

namespace {

/// Whether this thread does all work by itself, without oneTBB: with_threads(1).
thread_local bool is_alone = false;

class AloneScope {
 public:
  explicit AloneScope(bool alone) : before_(std::exchange(is_alone, alone)) {}
  ~AloneScope() { is_alone = before_; }
  AloneScope(const AloneScope&) = delete;
  AloneScope& operator=(const AloneScope&) = delete;

 private:
  bool before_;
};

}  // namespace

namespace scheduler_detail {

void run_both(const std::function<void()>& first, const std::function<void()>& second) {
  if (is_alone) {
    const NearestRounding rounding;
    first();
    second();
    return;
  }
  ForkGuard::prepare();
  const auto rounding_to_nearest = [scope = detail::interruption_scope,
                                    user = MemoryUser::current()](const std::function<void()>& work) {
    return [&work, scope, user] {
      const MemoryUserScope memory(user);
      const NearestRounding rounding;
      const AdoptedInterruption interruption(scope);
      work();
    };
  };
  with_workers([&] {
    tbb::this_task_arena::isolate([&] {
      tbb::task_group tasks;
      tasks.run(rounding_to_nearest(second));
      throw_if_cancelled(tasks.run_and_wait(rounding_to_nearest(first)) == tbb::canceled);
    });
  });
}

void run_ranges(std::size_t count, std::size_t grain,
                const std::function<void(std::size_t begin, std::size_t end)>& visit) {
  if (is_alone) {
    const NearestRounding rounding;
    for (std::size_t begin = 0; begin < count; begin += std::min(grain, count - begin)) {
      poll_interruption();
      visit(begin, begin + std::min(grain, count - begin));
    }
    return;
  }
  ForkGuard::prepare();
  const auto visit_range = [&, scope = detail::interruption_scope,
                            user = MemoryUser::current()](const tbb::blocked_range<std::size_t>& range) {
    const MemoryUserScope memory(user);
    const NearestRounding rounding;
    const AdoptedInterruption interruption(scope);
    for (std::size_t begin = range.begin(); begin < range.end(); begin += grain) {
      poll_interruption();
      visit(begin, std::min(begin + grain, range.end()));
    }
  };
  with_workers([&] {
    tbb::this_task_arena::isolate([&] {
      tbb::task_group_context context;
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), visit_range, context);
      throw_if_cancelled(context.is_group_execution_cancelled());
    });
  });
}

}  // namespace scheduler_detail

void with_threads(int threads, const std::function<void()>& work) {
  if (threads == 1) {
    const AloneScope alone(true);
    work();
    return;
  }
  ForkGuard::prepare();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  with_workers([&] {
    tbb::task_arena(threads).execute([&] {
      const AloneScope alone(false);
      work();
    });
  });
}

}  // namespace algebra3d
