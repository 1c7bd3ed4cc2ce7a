#include "queries/shell/detail/interruption.h"

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace queries {
namespace {

std::atomic<bool> is_interrupted{false};
std::atomic<bool> has_terminated{false};
std::atomic<std::int64_t> first_signal{0};  // in milliseconds
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// A terminal and a program between it and this one may both send the signal of one key.
constexpr std::int64_t kMillisecondsOfOneKey = 100;

std::int64_t milliseconds() {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

extern "C" void on_signal(int signal) {
  if (signal == SIGTERM) has_terminated = true;
  const std::int64_t now = milliseconds();
  if (!is_interrupted.exchange(true)) {
    first_signal = now;
  } else if (now - first_signal > kMillisecondsOfOneKey) {
    std::_Exit(130);
  }
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
