#include "queries/server/detail/connection_stream.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace queries {
namespace {

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

// Half closed first, so that the client gets what was written, also if it has sent what nobody has read.
ConnectionStream::~ConnectionStream() {
  shutdown(socket_, SHUT_WR);
  close(socket_);
}

bool ConnectionStream::wait_for(short events, Clock::duration time) const {
  const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(std::max(time, Clock::duration::zero()));
  pollfd asked{socket_, events, 0};
  int found = 0;
  do found = poll(&asked, 1, static_cast<int>(milliseconds.count()));
  while (found < 0 && errno == EINTR);
  return found > 0;
}

bool ConnectionStream::is_gone() const {
  pollfd asked{socket_, POLLRDHUP, 0};
  return poll(&asked, 1, 0) > 0 && (asked.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

bool ConnectionStream::is_readable() const {
  return begin_ < end_ || wait_for(POLLIN, limits_.silence);
}

bool ConnectionStream::is_writable() const {
  return wait_for(POLLOUT, limits_.silence);
}

bool ConnectionStream::fill() {
  const Clock::duration time = is_head_complete_ ? limits_.silence : start_ + limits_.head_time - Clock::now();
  if (!wait_for(POLLIN, time)) return false;
  ssize_t count = 0;
  do count = recv(socket_, buffer_.data(), buffer_.size(), 0);
  while (count < 0 && errno == EINTR);
  begin_ = 0;
  end_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return count > 0;
}

// The head ends with an empty line.
bool ConnectionStream::is_head_too_long(const char* bytes, std::size_t size) {
  for (std::size_t i = 0; i < size && !is_head_complete_; ++i) {
    ++head_bytes_;
    if (bytes[i] == '\n') {
      is_head_complete_ = line_bytes_ == 0;
      line_bytes_ = 0;
    } else if (bytes[i] != '\r') {
      ++line_bytes_;
    }
  }
  return head_bytes_ > limits_.head_bytes;
}

ssize_t ConnectionStream::read(char* bytes, std::size_t size) {
  if (begin_ == end_ && !fill()) return -1;
  const std::size_t count = std::min(size, end_ - begin_);
  std::memcpy(bytes, buffer_.data() + begin_, count);
  begin_ += count;
  if (is_head_too_long(bytes, count)) return -1;
  return static_cast<ssize_t>(count);
}

ssize_t ConnectionStream::write(const char* bytes, std::size_t size) {
  if (!is_writable()) return -1;
  ssize_t count = 0;
  do count = send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  while (count < 0 && errno == EINTR);
  return count;
}

void ConnectionStream::get_remote_ip_and_port(std::string& address, int& port) const {
  tell_end(getpeername, socket_, address, port);
}

void ConnectionStream::get_local_ip_and_port(std::string& address, int& port) const {
  tell_end(getsockname, socket_, address, port);
}

}  // namespace queries
