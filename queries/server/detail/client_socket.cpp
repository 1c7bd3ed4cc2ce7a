#include "queries/server/detail/client_socket.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <charconv>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>

namespace queries {
namespace {

struct Endpoint {
  std::string address;
  int port = 0;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

std::optional<Endpoint> endpoint_of(const sockaddr_storage& storage) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (storage.ss_family == AF_INET) {
    sockaddr_in address{};
    std::memcpy(&address, &storage, sizeof(address));
    if (inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size()) == nullptr) return std::nullopt;
    return Endpoint{text.data(), ntohs(address.sin_port)};
  }
  if (storage.ss_family == AF_INET6) {
    sockaddr_in6 address{};
    std::memcpy(&address, &storage, sizeof(address));
    if (inet_ntop(AF_INET6, &address.sin6_addr, text.data(), text.size()) == nullptr) return std::nullopt;
    return Endpoint{text.data(), ntohs(address.sin6_port)};
  }
  return std::nullopt;
}

std::optional<Endpoint> peer_of(int socket) {
  sockaddr_storage storage{};
  socklen_t size = sizeof(storage);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the interface of sockets
  if (getpeername(socket, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return std::nullopt;
  return endpoint_of(storage);
}

int own_port_of(int socket) {
  sockaddr_storage storage{};
  socklen_t size = sizeof(storage);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the interface of sockets
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return 0;
  const auto endpoint = endpoint_of(storage);
  return endpoint ? endpoint->port : 0;
}

// Until `visit` returns true.
void for_each_descriptor(const std::function<bool(int)>& visit) {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir("/proc/self/fd"), closedir);
  if (folder == nullptr) return;
  while (const dirent* const entry = readdir(folder.get())) {
    const std::string_view name = entry->d_name;
    int descriptor = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (error == std::errc() && end == name.data() + name.size() && visit(descriptor)) return;
  }
}

}  // namespace

ClientSocket::ClientSocket(const std::string& address, int port) {
  const Endpoint client{address, port};
  for_each_descriptor([&](int descriptor) {
    const bool is_it = peer_of(descriptor) == client;
    if (is_it) socket_ = descriptor;
    return is_it;
  });
}

bool ClientSocket::is_gone() const {
  if (socket_ < 0) return false;
  pollfd asked{socket_, POLLRDHUP, 0};
  return poll(&asked, 1, 0) > 0 && (asked.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

void shut_connections(int port) {
  for_each_descriptor([port](int descriptor) {
    if (own_port_of(descriptor) == port && peer_of(descriptor)) shutdown(descriptor, SHUT_RD);
    return false;
  });
}

}  // namespace queries
