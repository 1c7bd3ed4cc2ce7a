#include "queries/shell/detail/interruption.h"

#include <csignal>
#include <cstdlib>

namespace queries {
namespace {

std::atomic<bool> is_interrupted{false};
std::atomic<bool> has_terminated{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void on_signal(int signal) {
  if (signal == SIGTERM) has_terminated = true;
  if (is_interrupted.exchange(true)) std::_Exit(130);
}

}  // namespace

Interruption::Interruption() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file beyond the limit of ulimit is an error of the statement that writes it, not the end of the program.
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

bool Interruption::is_terminated() {
  return has_terminated;
}

std::atomic<bool>& Interruption::flag() {
  return is_interrupted;
}

}  // namespace queries
