#include "queries/server/detail/client_connection.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace queries {
namespace {

// Without a byte of a body, or of an answer that is taken.
constexpr std::chrono::milliseconds kSilence(20000);
// A body must arrive at a tenth of a megabyte per second, after a start of some seconds.
constexpr double kSlowestBytesPerSecond = 1e5;
constexpr std::chrono::seconds kBodyStart(20);
constexpr std::size_t kPieceBytes = std::size_t{64} << 10U;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

bool must_wait(ssize_t outcome) {
  return outcome < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
}

}  // namespace

bool ClientConnection::wait_for(short events) {
  pollfd asked{socket_, events, 0};
  waits_since_ = Clock::now().time_since_epoch().count();
  int found = 0;
  do found = poll(&asked, 1, static_cast<int>(kSilence.count()));
  while (found < 0 && errno == EINTR);
  waits_since_ = 0;
  if (found == 0) is_late_ = true;
  return found > 0;
}

std::optional<ClientConnection::Clock::time_point> ClientConnection::waits_since() const {
  const Clock::rep since = waits_since_;
  return since == 0 ? std::nullopt : std::optional(Clock::time_point(Clock::duration(since)));
}

void ClientConnection::give_up() {
  is_late_ = true;
  shut(SHUT_RD);
  pollfd asked{socket_, POLLOUT, 0};
  const bool is_taken = poll(&asked, 1, 0) > 0;  // the client reads, so it will get the refusal
  if (!is_taken) shut(SHUT_RDWR);
}

void ClientConnection::shut(int how) const {
  shutdown(socket_, how);
}

bool ClientConnection::is_gone() const {
  pollfd asked{socket_, POLLRDHUP, 0};
  return poll(&asked, 1, 0) > 0 && (asked.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

bool ClientConnection::has_come_within(std::chrono::milliseconds time) const {
  pollfd asked{socket_, POLLIN, 0};
  return poll(&asked, 1, static_cast<int>(time.count())) > 0;
}

bool ClientConnection::is_unread() const {
  char byte = 0;
  return recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;
}

std::size_t ClientConnection::read(char* bytes, std::size_t size) {
  ssize_t count = recv(socket_, bytes, size, MSG_DONTWAIT);
  while (must_wait(count) && wait_for(POLLIN)) count = recv(socket_, bytes, size, MSG_DONTWAIT);
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool ClientConnection::write(std::string_view bytes, bool goes_on) {
  while (!bytes.empty()) {
    const ssize_t count =
        send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT | (goes_on ? MSG_MORE : 0));
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    if (count < 0 && !(must_wait(count) && wait_for(POLLOUT))) return false;
  }
  return true;
}

Body::Outcome ClientBody::read(std::size_t limit, const std::function<bool(std::string_view)>& take) {
  if (size_ > limit) return Outcome::too_large;
  if (is_expected_ && bytes_.empty() && !connection_.write(kContinue)) return Outcome::broken;
  const auto start = ClientConnection::Clock::now();
  std::uint64_t bytes = 0;
  while (size_ > 0) {
    std::string piece = std::move(bytes_);
    bytes_.clear();
    if (piece.empty()) {
      piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size_, kPieceBytes)));
      piece.resize(connection_.read(piece.data(), piece.size()));
      if (piece.empty()) return connection_.is_late() ? Outcome::too_slow : Outcome::broken;
    }
    if (piece.size() > size_) {
      bytes_ = piece.substr(static_cast<std::size_t>(size_));
      piece.resize(static_cast<std::size_t>(size_));
    }
    size_ -= piece.size();
    bytes += piece.size();
    const std::chrono::duration<double> elapsed = ClientConnection::Clock::now() - start;
    if (elapsed > kBodyStart && static_cast<double>(bytes) < elapsed.count() * kSlowestBytesPerSecond)
      return Outcome::too_slow;
    if (!take(piece)) return Outcome::refused;
  }
  return Outcome::complete;
}

}  // namespace queries
