#include "queries/server/detail/acceptor.h"

#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <iterator>
#include <utility>

namespace queries {
namespace {

using algebra3d::Descriptor;

constexpr std::size_t kPieceBytes = std::size_t{64} << 10U;
constexpr std::chrono::milliseconds kSoon(50);
constexpr std::chrono::seconds kLongestRound(1);

// Connections that have ended stay in the list, without a socket, until the end of the round.
bool is_over(const Descriptor& socket) {
  return socket.number() < 0;
}

bool is_out_of_descriptors(int reason) {
  return reason == EMFILE || reason == ENFILE || reason == ENOBUFS || reason == ENOMEM;
}

}  // namespace

Acceptor::Acceptor(const AcceptorLimits& limits, Headers common, Take take, EachRound each_round)
    : limits_(limits),
      common_(std::move(common)),
      take_(std::move(take)),
      each_round_(std::move(each_round)),
      bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

void Acceptor::wake() {
  const std::uint64_t one = 1;
  (void)!::write(bell_.number(), &one, sizeof(one));
}

void Acceptor::stop() {
  is_stopping_ = true;
  wake();
}

void Acceptor::drain(Descriptor socket) {
  {
    const std::lock_guard lock(mutex_);
    to_drain_.push_back(std::move(socket));
  }
  wake();
}

void Acceptor::run(int listening) {
  Load load = Load::light;
  while (!is_stopping_) {
    wait(listening, load);
    for (std::size_t i = 0; i < open_.size(); ++i)
      if (polled_[i + 2].revents != 0) read(open_[i]);
    close_late();
    std::erase_if(open_, [](const Open& open) { return is_over(open.socket); });
    take_drained();
    if (polled_[1].revents != 0) accept_all(listening);
    load = each_round_();
  }
  open_.clear();
}

// A descriptor below 0 is not waited for.
void Acceptor::wait(int listening, Load load) {
  polled_ = {{bell_.number(), POLLIN, 0}, {load == Load::full ? -1 : listening, POLLIN, 0}};
  auto until = Clock::now() + (load == Load::light ? std::chrono::milliseconds(kLongestRound) : kSoon);
  for (const Open& open : open_) {
    polled_.push_back({open.socket.number(), POLLIN, 0});
    until = std::min(until, open.deadline);
  }
  const auto time = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  const int found = ::poll(polled_.data(), polled_.size(), std::max(0, static_cast<int>(time.count())));
  if (found <= 0)
    for (pollfd& each : polled_) each.revents = 0;
  // More than the process may have open by now: its limit was lowered.
  if (found < 0 && errno == EINVAL && !open_.empty()) close_oldest();
  std::uint64_t rings = 0;
  if (polled_[0].revents != 0) (void)!::read(bell_.number(), &rings, sizeof(rings));
}

void Acceptor::take_drained() {
  const std::lock_guard lock(mutex_);
  for (Descriptor& socket : to_drain_)
    open_.push_back({.socket = std::move(socket), .deadline = Clock::now() + limits_.drain_time, .is_draining = true});
  to_drain_.clear();
}

// A client whose head is whole within the round is never the oldest for long; those that send none are.
void Acceptor::accept_all(int listening) {
  constexpr int kMostAtOnce = 64;
  for (int i = 0; i < kMostAtOnce; ++i) {
    while (open_.size() >= limits_.connections) close_oldest();
    Descriptor socket(::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!is_over(socket)) {
      open_.push_back({.socket = std::move(socket), .deadline = Clock::now() + limits_.head_time});
      continue;
    }
    if (!is_out_of_descriptors(errno)) return;  // nobody waits, or who did is gone
    if (open_.empty()) return (void)::usleep(1000);
    close_oldest();
  }
}

void Acceptor::read(Open& open) {
  std::array<char, kPieceBytes> piece;  // NOLINT(*-member-init): written by the system
  const ssize_t count = ::recv(open.socket.number(), piece.data(), piece.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count > 0 && open.is_draining && (open.drained += static_cast<std::size_t>(count)) <= limits_.drain_bytes) return;
  if (count <= 0 || open.is_draining) return (void)(open.socket = Descriptor(-1));
  switch (open.head.add({piece.data(), static_cast<std::size_t>(count)})) {
    case RequestHead::State::incomplete:
      return;
    case RequestHead::State::refused:
      return refuse(open, open.head.refusal());
    case RequestHead::State::complete:
      take_(std::exchange(open.socket, Descriptor(-1)), open.head.take());
  }
}

// It is short, and nothing was sent before: the system takes it at once.
void Acceptor::refuse(Open& open, const Refusal& refusal) {
  const std::string text = answer_text(refusal.answer(), common_, open.head.is_of_head_method());
  (void)!::send(open.socket.number(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ::shutdown(open.socket.number(), SHUT_WR);
  open.is_draining = true;
  open.deadline = Clock::now() + limits_.drain_time;
}

// A connection on which nothing was sent is closed without a word: browsers open some in advance, and would take an
// answer for that of their next request.
void Acceptor::close_late() {
  const auto now = Clock::now();
  for (Open& open : open_) {
    if (is_over(open.socket) || open.deadline > now) continue;
    if (open.is_draining || open.head.is_empty())
      open.socket = Descriptor(-1);
    else
      refuse(open, {408, "timeout", "the head of the request did not arrive in time"});
  }
}

void Acceptor::close_oldest() {
  Open& oldest = open_.front();
  if (!oldest.is_draining && !oldest.head.is_empty())
    refuse(oldest, {408, "timeout", "the head of the request had not arrived when others needed the place"});
  open_.erase(open_.begin());
}

}  // namespace queries
