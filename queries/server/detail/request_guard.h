#pragma once

#include <optional>
#include <string>
#include <vector>

#include "queries/server/detail/http.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// Decides which requests a server answers at all, by their headers `Host`, `Origin` and `Authorization`. So a page of
/// another server cannot send statements from the browser of somebody who uses this one: its `Origin` is foreign, and
/// a name that its owner has bound to this machine's address (DNS rebinding) is a foreign `Host`.
class RequestGuard {
 public:
  /// `authorities`: names in `Host`, each `NAME:PORT`, or a NAME for any port. `token`: empty for none.
  RequestGuard(std::vector<std::string> authorities, std::string token)
      : authorities_(std::move(authorities)), token_(std::move(token)) {}

  /// Why the request is refused, if it is. `needs_token`: the token is required if there is one.
  std::optional<Refusal> refuse(const HttpRequest& request, bool needs_token) const;

 private:
  bool knows(std::string_view authority) const;
  bool has_token(const HttpRequest& request) const;

  std::vector<std::string> authorities_;
  std::string token_;
};

/// True for names and numbers of this machine's loopback interface: localhost, 127.x.y.z, ::1.
bool is_loopback(const std::string& address);

/// The authorities of a server that listens on `address` and `port`, and has the further names `hosts`.
std::vector<std::string> authorities_of(const std::string& address, int port, const std::vector<std::string>& hosts);

}  // namespace queries
