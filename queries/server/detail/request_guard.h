#pragma once

#include <optional>
#include <string>
#include <vector>

#include "queries/server/detail/http.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// A name of the server, as addresses have it: `http://localhost:8737`.
struct SiteName {
  std::string scheme = "http";  ///< of the pages that have it: `https` where a proxy speaks it
  std::string authority;        ///< in lower case: NAME:PORT, or NAME for any port
};

/// Decides which requests a server answers at all, by their headers `Host`, `Origin` and `Authorization`. So a page of
/// another server cannot send statements from the browser of somebody who uses this one: its `Origin` is foreign, and
/// a name that its owner has bound to this machine's address (DNS rebinding) is a foreign `Host`. The scheme counts,
/// too: whoever changes what goes through the network can make a page of `http` for every name, but none of `https`.
class RequestGuard {
 public:
  /// `names`: those of the server. `token`: empty for none.
  RequestGuard(std::vector<SiteName> names, std::string token) : names_(std::move(names)), token_(std::move(token)) {}

  /// Why the request is refused, if it is. `needs_token`: the token is required if there is one.
  std::optional<Refusal> refuse(const HttpRequest& request, bool needs_token) const;

 private:
  bool knows(std::string_view host) const;
  std::vector<std::string> origins_of(std::string_view host) const;
  bool has_token(const HttpRequest& request) const;

  std::vector<SiteName> names_;
  std::string token_;
};

/// True for names and numbers of this machine's loopback interface: localhost, 127.x.y.z, ::1.
bool is_loopback(const std::string& address);

/// A further name of a server: `[SCHEME://]NAME[:PORT]`, where the scheme is http if it is not given. Errors:
/// wrong_usage.
algebra3d::Result<SiteName> site_name(const std::string& text);

/// An origin whose pages may show ours, as the header Content-Security-Policy has it: `SCHEME://NAME[:PORT]` of http or
/// https. Errors: wrong_usage.
algebra3d::Result<std::string> embedding_origin(const std::string& text);

/// The names of a server that listens on `address` and `port`, with its further names.
std::vector<SiteName> site_names(const std::string& address, int port, std::vector<SiteName> further);

}  // namespace queries
