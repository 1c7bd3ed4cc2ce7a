#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <type_traits>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d {

/// Thrown by poll_interruption. Not a std::exception, so that nothing takes it for a failure: hosts turn it into the
/// error `interrupted` (as_interrupted).
struct Interrupted {};

class InterruptionScope;

namespace detail {
/// The innermost scope of this thread; null outside of all of them.
extern constinit thread_local const InterruptionScope* interruption_scope;  // NOLINT(readability-identifier-naming)
[[noreturn]] void throw_interrupted();
}  // namespace detail

/// While it exists, poll_interruption on this thread, and on threads that work for it through the scheduler
/// (scheduler.h), throws `Interrupted` once the flag is set. Scopes nest: a flag of an outer scope counts inside, too.
/// Work that takes a Monitor or a Context polls that as well; the scope is for all that has neither: texts, hashes,
/// orders, codecs, exact numbers. Used as a local variable.
class InterruptionScope {
 public:
  /// The flag may be null; it outlives the scope.
  explicit InterruptionScope(const std::atomic<bool>* flag)
      : flag_(flag), outer_(detail::interruption_scope), before_(outer_) {
    detail::interruption_scope = this;
  }
  ~InterruptionScope() { detail::interruption_scope = before_; }
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

  bool is_interrupted() const {
    for (const InterruptionScope* scope = this; scope != nullptr; scope = scope->outer_)
      if (scope->flag_ != nullptr && scope->flag_->load(std::memory_order_relaxed)) return true;
    return false;
  }

 protected:
  /// A scope inside `outer`, which may belong to another thread that waits, or be null.
  explicit InterruptionScope(const InterruptionScope* outer)
      : flag_(nullptr), outer_(outer), before_(detail::interruption_scope) {
    detail::interruption_scope = this;
  }

 private:
  const std::atomic<bool>* flag_;
  const InterruptionScope* outer_;
  const InterruptionScope* before_;
};

/// The scope of another thread, which waits, for the work that is done here for it.
class AdoptedInterruption : public InterruptionScope {
 public:
  explicit AdoptedInterruption(const InterruptionScope* of_other_thread) : InterruptionScope(of_other_thread) {}
};

/// While it exists, poll_interruption on this thread does not throw: for work that must come to its end, as undoing.
class UninterruptedScope : public InterruptionScope {
 public:
  UninterruptedScope() : InterruptionScope(static_cast<const InterruptionScope*>(nullptr)) {}
};

/// Whether the host wants the present work to end.
inline bool is_interrupted() {
  return detail::interruption_scope != nullptr && detail::interruption_scope->is_interrupted();
}

/// Throws `Interrupted` if the host wants the present work to end, and the thread is not unwinding already. To be
/// called at least every millisecond by everything whose time grows with its input, but not by destructors. Cost: a
/// nanosecond.
inline void poll_interruption() {
  if (is_interrupted() && std::uncaught_exceptions() == 0) [[unlikely]]
    detail::throw_interrupted();
}

/// poll_interruption at every 1024th step of a loop, counted by `step`.
inline void poll_interruption_at(std::size_t step) {
  constexpr std::size_t kSteps = 1024;
  if (step % kSteps == 0) poll_interruption();
}

/// The result of `work`, a Result or Status; `Interrupted` becomes the error interrupted.
template <typename Work>
std::invoke_result_t<const Work&> as_interrupted(const Work& work) {
  try {
    return work();
  } catch (const Interrupted&) {
    return Monitor::interrupted();
  }
}

}  // namespace algebra3d
