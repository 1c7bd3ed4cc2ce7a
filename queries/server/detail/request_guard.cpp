#include "queries/server/detail/request_guard.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include <fmt/format.h>

#include "queries/server/detail/lower_case.h"

namespace queries {
namespace {

/// Without the port, if there is one: `[::1]:80` and `name:80`.
std::string_view name_of(std::string_view authority) {
  const std::size_t bracket = authority.rfind(']');
  const std::size_t colon = authority.rfind(':');
  const bool has_port = colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket);
  return has_port ? authority.substr(0, colon) : authority;
}

bool is_name_of(const SiteName& site, std::string_view host) {
  const std::string_view known = site.authority;
  return known == host || (name_of(known) == known && known == name_of(host));
}

// Takes as long for a wrong first character as for a wrong last one.
bool is_equal_in_constant_time(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b.empty() ? 0 : b[i % b.size()]);
  return difference == 0;
}

}  // namespace

bool RequestGuard::knows(std::string_view host) const {
  return std::ranges::any_of(names_, [&](const SiteName& site) { return is_name_of(site, host); });
}

std::vector<std::string> RequestGuard::origins_of(std::string_view host) const {
  std::vector<std::string> origins;
  for (const SiteName& site : names_)
    if (is_name_of(site, host)) origins.push_back(fmt::format("{}://{}", site.scheme, host));
  return origins;
}

bool RequestGuard::has_token(const HttpRequest& request) const {
  constexpr std::string_view kScheme = "bearer ";
  const std::string given = request.header("authorization");
  if (given.size() < kScheme.size() || in_lower_case(given.substr(0, kScheme.size())) != kScheme) return false;
  return is_equal_in_constant_time(std::string_view(given).substr(kScheme.size()), token_);
}

std::optional<Refusal> RequestGuard::refuse(const HttpRequest& request, bool needs_token) const {
  const std::string host = in_lower_case(request.header("host"));
  if (request.headers.count("host") != 1 || !knows(host)) {
    std::vector<std::string> known;
    for (const SiteName& site : names_) known.push_back(site.authority);
    return Refusal{403, "forbidden", fmt::format("Host '{}': expected {}", host, fmt::join(known, " or ")),
                   "Use the address that the server has printed; further names are given by --host."};
  }
  if (request.headers.contains("origin")) {
    const std::string origin = request.header("origin");
    const std::vector<std::string> own = origins_of(host);
    if (request.headers.count("origin") != 1 || std::ranges::find(own, in_lower_case(origin)) == own.end())
      return Refusal{403, "forbidden",
                     fmt::format("Origin '{}': pages of other servers cannot send requests to '{}'; expected {}",
                                 origin, host, fmt::join(own, " or ")),
                     "Behind a proxy that speaks https, start the server with --host https://NAME."};
  }
  if (needs_token && !token_.empty() && !has_token(request))
    return Refusal{401, "unauthorized",
                   request.headers.contains("authorization") ? "the token is wrong" : "a token is required",
                   "Send the header 'Authorization: Bearer TOKEN'; in a browser, add #token=TOKEN to the address."};
  return std::nullopt;
}

bool is_loopback(const std::string& address) {
  if (in_lower_case(address) == "localhost") return true;
  in_addr number{};
  if (inet_pton(AF_INET, address.c_str(), &number) == 1) return ntohl(number.s_addr) >> 24U == 127;
  in6_addr long_number{};
  return inet_pton(AF_INET6, address.c_str(), &long_number) == 1 && IN6_IS_ADDR_LOOPBACK(&long_number);
}

algebra3d::Result<SiteName> site_name(const std::string& text) {
  const std::string lower = in_lower_case(text);
  const std::size_t end = lower.find("://");
  const bool has_scheme = end != std::string::npos;
  SiteName site{.authority = has_scheme ? lower.substr(end + 3) : lower};
  if (has_scheme) site.scheme = lower.substr(0, end);
  const bool is_authority = !site.authority.empty() && site.authority.find_first_of("/?#@ \t,") == std::string::npos;
  if (is_authority && (site.scheme == "http" || site.scheme == "https")) return site;
  return algebra3d::Error{algebra3d::ErrorCode::wrong_usage,
                          "--host {}: expected NAME, NAME:PORT, or one of them after http:// or https://", text};
}

// It stands between blanks and semicolons of the header, so nothing but names, numbers and ports is taken.
algebra3d::Result<std::string> embedding_origin(const std::string& text) {
  std::string origin = in_lower_case(text);
  const std::size_t end = origin.find("://");
  const std::string_view authority = end == std::string::npos ? "" : std::string_view(origin).substr(end + 3);
  const std::string_view scheme = std::string_view(origin).substr(0, std::min(end, origin.size()));
  const bool is_authority = !authority.empty() && std::ranges::all_of(authority, [](unsigned char c) {
    return (std::isalnum(c) != 0 && c < 0x80) || c == '-' || c == '.' || c == ':' || c == '[' || c == ']';
  });
  if (is_authority && (scheme == "http" || scheme == "https")) return origin;
  return algebra3d::Error{algebra3d::ErrorCode::wrong_usage,
                          "--embed {}: expected an origin, such as https://parts.example or http://localhost:3000",
                          text};
}

std::vector<SiteName> site_names(const std::string& address, int port, std::vector<SiteName> further) {
  std::vector<std::string> names = {"localhost", "127.0.0.1", "[::1]"};
  const bool is_any = address == "0.0.0.0" || address == "::";
  const std::string own = address.find(':') == std::string::npos ? address : "[" + address + "]";
  if (!is_any && std::ranges::find(names, own) == names.end()) names.push_back(own);
  std::vector<SiteName> result;
  for (const std::string& name : names) {
    result.push_back({.authority = fmt::format("{}:{}", in_lower_case(name), port)});
    if (port == 80) result.push_back({.authority = in_lower_case(name)});  // which browsers leave out
  }
  std::ranges::move(further, std::back_inserter(result));
  return result;
}

}  // namespace queries
