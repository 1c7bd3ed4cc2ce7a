#include "queries/server/detail/answer_text.h"

#include <string_view>

#include <fmt/format.h>

namespace queries {
namespace {

// RFC 9110, section 15, and RFC 6585, of the refusals that are written here.
std::string_view reason_of(int status) {
  switch (status) {
    case 408:
      return "Request Timeout";
    case 414:
      return "URI Too Long";
    case 431:
      return "Request Header Fields Too Large";
    case 501:
      return "Not Implemented";
    case 505:
      return "HTTP Version Not Supported";
    default:
      return "Bad Request";
  }
}

}  // namespace

// X-Frame-Options cannot name other origins, and browsers that know frame-ancestors do not need it.
Headers common_headers(const std::vector<std::string>& embedders) {
  Headers headers = {
      {"Accept-Ranges", "none"},
      {"X-Content-Type-Options", "nosniff"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Referrer-Policy", "no-referrer"},
      {"Content-Security-Policy",
       fmt::format(
           "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
           "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors {}",
           embedders.empty() ? "'none'" : fmt::format("{}", fmt::join(embedders, " ")))}};
  if (embedders.empty()) headers.emplace_back("X-Frame-Options", "DENY");
  return headers;
}

std::string answer_text(const HttpAnswer& answer, const Headers& common, bool is_without_body) {
  std::string text = fmt::format("HTTP/1.1 {} {}\r\n", answer.status, reason_of(answer.status));
  for (const auto& [name, value] : common) text += fmt::format("{}: {}\r\n", name, value);
  for (const auto& [name, value] : answer.headers) text += fmt::format("{}: {}\r\n", name, value);
  text += fmt::format("Content-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n", answer.type,
                      answer.body.size());
  return is_without_body ? text : text + answer.body;
}

}  // namespace queries
