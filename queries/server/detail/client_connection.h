#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "queries/server/detail/http.h"

namespace queries {

/// The connection of a request while a thread answers it. It knows whether the client is still there, and how long it
/// has been waited for. The socket, which does not block, is another's.
class ClientConnection final : public Connection {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ClientConnection(int socket) : socket_(socket) {}
  ~ClientConnection() override = default;
  ClientConnection(const ClientConnection&) = delete;
  ClientConnection& operator=(const ClientConnection&) = delete;

  int socket() const { return socket_; }
  bool is_gone() const override;
  /// Reads what has come, at most `size` bytes; waits for the first. 0: the client has closed, or is late.
  std::size_t read(char* bytes, std::size_t size);
  /// Sends all bytes. `goes_on`: more follow at once. False: the client has closed, or is late.
  bool write(std::string_view bytes, bool goes_on = false);
  /// True if bytes, or the end, come in this time.
  bool has_come_within(std::chrono::milliseconds time) const;
  /// True if bytes have come that were not read.
  bool is_unread() const;
  /// True if the client was silent for too long, or others needed its place.
  bool is_late() const { return is_late_; }

  /// Since when the client has been waited for; nothing while it is not. This and the following functions may be called
  /// by any thread.
  std::optional<Clock::time_point> waits_since() const;
  /// Ends the connection because others need its place.
  void give_up();
  /// Ends reading (SHUT_RD), writing (SHUT_WR), or both (SHUT_RDWR).
  void shut(int how) const;

 private:
  bool wait_for(short events);

  const int socket_;
  std::atomic<bool> is_late_ = false;
  std::atomic<Clock::rep> waits_since_ = 0;  // 0: no
};

/// The body of a request, whose beginning has come with its head.
class ClientBody final : public Body {
 public:
  /// `bytes`: what came after the head. `is_expected`: the client waits to be told that it may send the body.
  ClientBody(ClientConnection& connection, std::uint64_t size, std::string bytes, bool is_expected)
      : connection_(connection), size_(size), bytes_(std::move(bytes)), is_expected_(is_expected) {}

  Outcome read(std::size_t limit, const std::function<bool(std::string_view)>& take) override;
  /// True if it was read, and nothing has come after it.
  bool is_at_end() const { return size_ == 0 && bytes_.empty() && !connection_.is_unread(); }

 private:
  ClientConnection& connection_;
  std::uint64_t size_;  // of what was not read yet
  std::string bytes_;
  const bool is_expected_;
};

}  // namespace queries
