#pragma once

#include <csignal>

namespace algebra3d {

/// Blocks all signals for the calling thread, and for threads that it starts meanwhile, during the lifetime of the
/// object, so that another thread handles them.
class SignalBlock {
 public:
  SignalBlock() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalBlock() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalBlock(const SignalBlock&) = delete;
  SignalBlock& operator=(const SignalBlock&) = delete;

  /// The signals that were blocked before; for a thread that is to handle signals.
  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_;
};

}  // namespace algebra3d
