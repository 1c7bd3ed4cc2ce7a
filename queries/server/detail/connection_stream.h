#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "base/input_file.h"
#include "queries/server/detail/http.h"
#include "queries/server/detail/http_library.h"

namespace queries {

/// The connection of one request whose head is there, as the HTTP library reads and writes it. It knows whether the
/// client is still there, and how long it has been waited for. Owns the socket.
class ConnectionStream final : public httplib::Stream, public Connection {
 public:
  using Clock = std::chrono::steady_clock;

  /// `bytes`: what has come; at least the head.
  ConnectionStream(algebra3d::Descriptor socket, std::string bytes)
      : socket_(std::move(socket)), buffer_(std::move(bytes)) {}
  ~ConnectionStream() override = default;
  ConnectionStream(const ConnectionStream&) = delete;
  ConnectionStream& operator=(const ConnectionStream&) = delete;

  bool is_gone() const override;

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& address, int& port) const override;
  void get_local_ip_and_port(std::string& address, int& port) const override;
  /// None: the library would refuse one that `select` cannot wait for, and waits by the functions above only.
  socket_t socket() const override { return INVALID_SOCKET; }

  /// The bytes of the body that the request announces; called when its head was read.
  void expect_body(std::uint64_t bytes) { body_bytes_ = bytes; }
  /// True if the client was silent for too long, or others needed its place.
  bool is_late() const { return is_late_; }
  /// Ends the answer. Returns the socket if the client has sent, or may still send, unread bytes.
  algebra3d::Descriptor end();

  /// Since when the client has been waited for; nothing while it is not. This and the following functions may be called
  /// by any thread.
  std::optional<Clock::time_point> waits_since() const;
  /// Ends the connection because others need its place.
  void give_up();
  /// Ends reading (SHUT_RD), or all (SHUT_RDWR).
  void shut(int how) const;

 private:
  bool wait_for(short events) const;
  bool fill();
  bool is_unread() const;

  algebra3d::Descriptor socket_;
  std::string buffer_;            // bytes that have come
  std::size_t begin_ = 0;         // of those that were not read yet
  std::uint64_t body_bytes_ = 0;  // that are announced and were not read
  mutable std::atomic<bool> is_late_ = false;
  mutable std::atomic<Clock::rep> waits_since_ = 0;  // 0: no
};

}  // namespace queries
