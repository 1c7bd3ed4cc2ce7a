#include "queries/server/detail/request_guard.h"

#include <arpa/inet.h>

#include <algorithm>

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

// What follows `scheme://`; empty for the origin `null`.
std::string_view authority_of(std::string_view origin) {
  const std::size_t end = origin.find("://");
  return end == std::string_view::npos ? std::string_view() : origin.substr(end + 3);
}

// Takes as long for a wrong first character as for a wrong last one.
bool is_equal_in_constant_time(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b.empty() ? 0 : b[i % b.size()]);
  return difference == 0;
}

}  // namespace

bool RequestGuard::knows(std::string_view authority) const {
  const std::string given = in_lower_case(authority);
  return std::ranges::any_of(authorities_, [&](const std::string& known) {
    return known == given || (name_of(known) == known && known == name_of(given));
  });
}

bool RequestGuard::has_token(const HttpRequest& request) const {
  constexpr std::string_view kScheme = "bearer ";
  const std::string given = request.header("authorization");
  if (given.size() < kScheme.size() || in_lower_case(given.substr(0, kScheme.size())) != kScheme) return false;
  return is_equal_in_constant_time(std::string_view(given).substr(kScheme.size()), token_);
}

std::optional<Refusal> RequestGuard::refuse(const HttpRequest& request, bool needs_token) const {
  const std::string host = request.header("host");
  if (request.headers.count("host") != 1 || !knows(host))
    return Refusal{403, "forbidden", fmt::format("Host '{}': expected {}", host, fmt::join(authorities_, " or ")),
                   "Use the address that the server has printed; further names are given by --host."};
  if (request.headers.contains("origin")) {
    const std::string origin = request.header("origin");
    if (request.headers.count("origin") != 1 || in_lower_case(authority_of(origin)) != in_lower_case(host))
      return Refusal{403, "forbidden",
                     fmt::format("Origin '{}': pages of other servers cannot send requests to '{}'", origin, host)};
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

std::vector<std::string> authorities_of(const std::string& address, int port, const std::vector<std::string>& hosts) {
  std::vector<std::string> names = {"localhost", "127.0.0.1", "[::1]"};
  const bool is_any = address == "0.0.0.0" || address == "::";
  const std::string own = address.find(':') == std::string::npos ? address : "[" + address + "]";
  if (!is_any && std::ranges::find(names, own) == names.end()) names.push_back(own);
  std::vector<std::string> result;
  for (const std::string& name : names) {
    result.push_back(fmt::format("{}:{}", in_lower_case(name), port));
    if (port == 80) result.push_back(in_lower_case(name));  // which browsers leave out
  }
  for (const std::string& host : hosts) result.push_back(in_lower_case(host));
  return result;
}

}  // namespace queries
