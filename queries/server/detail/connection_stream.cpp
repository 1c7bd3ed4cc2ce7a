#include "queries/server/detail/connection_stream.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace queries {
namespace {

// Without a byte of a body, or of an answer that is taken.
constexpr std::chrono::milliseconds kSilence(20000);
constexpr std::size_t kBufferBytes = 16384;

using AskName = int (*)(int, sockaddr*, socklen_t*);

// The two ends of a connection are asked for by getpeername and getsockname.
void tell_end(AskName ask, int socket, std::string& address, int& port) {
  sockaddr_storage storage{};
  socklen_t size = sizeof(storage);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the interface of sockets
  if (ask(socket, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (storage.ss_family == AF_INET) {
    sockaddr_in end{};
    std::memcpy(&end, &storage, sizeof(end));
    inet_ntop(AF_INET, &end.sin_addr, text.data(), text.size());
    port = ntohs(end.sin_port);
  } else if (storage.ss_family == AF_INET6) {
    sockaddr_in6 end{};
    std::memcpy(&end, &storage, sizeof(end));
    inet_ntop(AF_INET6, &end.sin6_addr, text.data(), text.size());
    port = ntohs(end.sin6_port);
  }
  address = text.data();
}

}  // namespace

bool ConnectionStream::wait_for(short events) const {
  pollfd asked{socket_.number(), events, 0};
  waits_since_ = Clock::now().time_since_epoch().count();
  int found = 0;
  do found = poll(&asked, 1, static_cast<int>(kSilence.count()));
  while (found < 0 && errno == EINTR);
  waits_since_ = 0;
  if (found == 0) is_late_ = true;
  return found > 0;
}

std::optional<ConnectionStream::Clock::time_point> ConnectionStream::waits_since() const {
  const Clock::rep since = waits_since_;
  return since == 0 ? std::nullopt : std::optional(Clock::time_point(Clock::duration(since)));
}

void ConnectionStream::give_up() {
  is_late_ = true;
  shut(SHUT_RD);
  pollfd asked{socket_.number(), POLLOUT, 0};
  const bool is_taken = poll(&asked, 1, 0) > 0;  // the client reads, so it will get the refusal
  if (!is_taken) shut(SHUT_RDWR);
}

void ConnectionStream::shut(int how) const {
  shutdown(socket_.number(), how);
}

bool ConnectionStream::is_gone() const {
  pollfd asked{socket_.number(), POLLRDHUP, 0};
  return poll(&asked, 1, 0) > 0 && (asked.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

bool ConnectionStream::is_readable() const {
  return begin_ < buffer_.size() || wait_for(POLLIN);
}

bool ConnectionStream::is_writable() const {
  return wait_for(POLLOUT);
}

bool ConnectionStream::fill() {
  if (!wait_for(POLLIN)) return false;
  buffer_.resize(kBufferBytes);
  begin_ = 0;
  ssize_t count = 0;
  do count = recv(socket_.number(), buffer_.data(), buffer_.size(), 0);
  while (count < 0 && errno == EINTR);
  buffer_.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return count > 0;
}

ssize_t ConnectionStream::read(char* bytes, std::size_t size) {
  if (begin_ == buffer_.size() && !fill()) return -1;
  const std::size_t count = std::min(size, buffer_.size() - begin_);
  std::memcpy(bytes, buffer_.data() + begin_, count);
  begin_ += count;
  body_bytes_ -= std::min<std::uint64_t>(body_bytes_, count);
  return static_cast<ssize_t>(count);
}

ssize_t ConnectionStream::write(const char* bytes, std::size_t size) {
  if (!is_writable()) return -1;
  ssize_t count = 0;
  do count = send(socket_.number(), bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  while (count < 0 && errno == EINTR);
  return count;
}

bool ConnectionStream::is_unread() const {
  char byte = 0;
  return body_bytes_ > 0 || begin_ < buffer_.size() || recv(socket_.number(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;
}

algebra3d::Descriptor ConnectionStream::end() {
  shut(SHUT_WR);
  return is_unread() ? std::exchange(socket_, algebra3d::Descriptor(-1)) : algebra3d::Descriptor(-1);
}

void ConnectionStream::get_remote_ip_and_port(std::string& address, int& port) const {
  tell_end(getpeername, socket_.number(), address, port);
}

void ConnectionStream::get_local_ip_and_port(std::string& address, int& port) const {
  tell_end(getsockname, socket_.number(), address, port);
}

}  // namespace queries
