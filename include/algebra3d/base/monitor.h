#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "algebra3d/base/error.h"

namespace algebra3d {
namespace detail {

/// Leaves by an exception if the host of this thread wants its work to end (poll_interruption).
void poll_thread();

}  // namespace detail

/// Cancellation and progress of long work. Refers to a flag and a callback of the host, which must outlive the work. By
/// default there is neither.
class Monitor {
 public:
  /// Receives progress such as "finding crossings, 42 %", often, only on the thread that created the monitor.
  using Report = std::function<void(const std::string& how_far)>;

  // NOLINTNEXTLINE(google-explicit-constructor): a flag alone is enough
  Monitor(const std::atomic<bool>* cancel = nullptr, const Report* report = nullptr)
      : cancel_(cancel), report_(report), teller_(std::this_thread::get_id()) {}

  const std::atomic<bool>* cancel() const { return cancel_; }
  const Report* report() const { return report_; }
  /// Work without a flag is left by an exception, as poll_thread does: its callers expect no error.
  bool is_cancelled() const {
    if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed)) return true;
    detail::poll_thread();
    return false;
  }
  /// The error `interrupted` if the host has cancelled the work.
  Status check() const {
    if (is_cancelled()) return interrupted();
    return {};
  }
  static Error interrupted() { return {ErrorCode::interrupted, "interrupted"}; }
  /// A monitor with the same cancellation and without progress.
  Monitor silent() const { return {cancel_, nullptr}; }
  /// True if there is a callback and this is its thread.
  bool is_heard() const { return report_ != nullptr && std::this_thread::get_id() == teller_; }
  void tell(const std::string& how_far) const {
    if (is_heard()) (*report_)(how_far);
  }

 private:
  const std::atomic<bool>* cancel_;
  const Report* report_;
  std::thread::id teller_;
};

/// A stage of long work with a known number of steps. Copies count together, each on its own thread.
class Stage {
 public:
  Stage(const Monitor& monitor, std::string what, std::size_t step_count)
      : shared_(std::make_shared<Shared>(monitor, std::move(what), step_count)) {
    monitor.tell(shared_->what);
  }
  Stage(const Stage& other) : shared_(other.shared_) {}
  Stage& operator=(const Stage&) = delete;
  ~Stage() { count(); }

  /// To be called at the beginning of each step. False if the work is cancelled; checked at the first step and about
  /// every thousand steps.
  bool begin_step() { return steps_++ % kSteps != 0 || look(); }

 private:
  static constexpr std::size_t kSteps = 1024;

  struct Shared {
    Shared(const Monitor& its_monitor, std::string its_name, std::size_t its_step_count)
        : monitor(its_monitor), what(std::move(its_name)), step_count(its_step_count) {}

    const Monitor monitor;
    const std::string what;
    const std::size_t step_count;
    std::atomic<std::size_t> steps = 0;
    std::size_t percent = 0;  // of the reporting thread
  };

  bool look() {
    count();
    if (shared_->monitor.is_heard()) tell();
    return !shared_->monitor.is_cancelled();
  }

  void count() { shared_->steps += steps_ - std::exchange(counted_, steps_); }

  void tell() {
    const std::size_t percent = shared_->step_count == 0 ? 0 : shared_->steps * 100 / shared_->step_count;
    if (percent == shared_->percent) return;
    shared_->percent = percent;
    shared_->monitor.tell(shared_->what + ", " + std::to_string(percent) + " %");
  }

  std::shared_ptr<Shared> shared_;
  std::size_t steps_ = 0, counted_ = 0;
};

}  // namespace algebra3d
