#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "queries/server/detail/http.h"
#include "queries/server/detail/http_library.h"

namespace queries {

/// Limits of what a client may make the server wait for or keep.
struct ConnectionLimits {
  std::size_t head_bytes = std::size_t{64} << 10U;  ///< of the request line and the headers together
  std::chrono::seconds head_time{10};               ///< until they are complete
  std::chrono::seconds silence{20};                 ///< without a byte of a body, or of an answer that is taken
};

/// The connection of one request, as the HTTP library reads and writes it. It bounds the head of the request, which the
/// library would read without end, and knows whether the client is still there. Owns the socket.
class ConnectionStream final : public httplib::Stream, public Connection {
 public:
  ConnectionStream(int socket, const ConnectionLimits& limits) : socket_(socket), limits_(limits) {}
  ~ConnectionStream() override;
  ConnectionStream(const ConnectionStream&) = delete;
  ConnectionStream& operator=(const ConnectionStream&) = delete;

  bool is_gone() const override;

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& address, int& port) const override;
  void get_local_ip_and_port(std::string& address, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for(short events, Clock::duration time) const;
  bool fill();
  bool is_head_too_long(const char* bytes, std::size_t size);

  const int socket_;
  const ConnectionLimits limits_;
  const Clock::time_point start_ = Clock::now();
  std::array<char, 16384> buffer_{};
  std::size_t begin_ = 0;  // of what lies in the buffer
  std::size_t end_ = 0;
  std::size_t head_bytes_ = 0;
  std::size_t line_bytes_ = 1;  // of the line of the head that is being read
  bool is_head_complete_ = false;
};

}  // namespace queries
