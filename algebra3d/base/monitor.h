#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// What long work asks and tells while it runs: whether it is to end, and how far it has come. The host owns what is
/// referred to, for longer than the work. By default nobody asks and nobody listens.
class Monitor {
 public:
  /// Takes "finding crossings, 42 %", often, and from the thread that began the work alone.
  using Report = std::function<void(const std::string& how_far)>;

  // NOLINTNEXTLINE(google-explicit-constructor): who has no more than a flag gives that
  Monitor(const std::atomic<bool>* cancel = nullptr, const Report* report = nullptr)
      : cancel_(cancel), report_(report) {}

  const std::atomic<bool>* cancel() const { return cancel_; }
  const Report* report() const { return report_; }
  bool is_cancelled() const { return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed); }
  /// The error `interrupted` once the host has asked to stop.
  Status check() const {
    if (is_cancelled()) return interrupted();
    return {};
  }
  static Error interrupted() { return {ErrorCode::interrupted, "interrupted"}; }
  /// Asks, and tells nobody.
  Monitor silent() const { return {cancel_, nullptr}; }
  void tell(const std::string& how_far) const {
    if (report_ != nullptr) (*report_)(how_far);
  }

 private:
  const std::atomic<bool>* cancel_;
  const Report* report_;
};

/// One stage of long work, of which it is known how many steps it has.
class Stage {
 public:
  Stage(const Monitor& monitor, std::string what, std::size_t step_count)
      : monitor_(monitor), what_(std::move(what)), step_count_(step_count) {
    monitor_.tell(what_);
  }

  /// Another step is about to begin. False if the work is to end; that is asked every thousand steps or so.
  bool begin_step() { return ++steps_ % kSteps != 0 || look(); }

 private:
  static constexpr std::size_t kSteps = 1024;

  bool look() {
    const std::size_t percent = step_count_ == 0 ? 0 : steps_ * 100 / step_count_;
    if (percent != percent_) {
      percent_ = percent;
      monitor_.tell(what_ + ", " + std::to_string(percent) + " %");
    }
    return !monitor_.is_cancelled();
  }

  Monitor monitor_;
  std::string what_;
  std::size_t step_count_, steps_ = 0, percent_ = 0;
};

}  // namespace algebra3d
