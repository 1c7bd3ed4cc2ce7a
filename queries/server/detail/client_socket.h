#pragma once

#include <string>

#include "queries/server/detail/http.h"

namespace queries {

/// The connection of a request by its socket, which the HTTP library does not tell: it is the one of this process with
/// the client's address and port. A client that has closed its side for writing only counts as gone.
class ClientSocket final : public Connection {
 public:
  ClientSocket(const std::string& address, int port);
  bool is_gone() const override;

 private:
  int socket_ = -1;  // none: never gone
};

/// Closes all connections to a port of this process for reading, so that nobody waits for the next request.
void shut_connections(int port);

}  // namespace queries
