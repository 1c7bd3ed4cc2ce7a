#include "queries/server/detail/answer_head.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

namespace queries {
namespace {

// RFC 9110, section 15, and RFC 6585.
constexpr std::array<std::pair<int, std::string_view>, 21> kReasons = {{
    {200, "OK"},
    {204, "No Content"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {401, "Unauthorized"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {408, "Request Timeout"},
    {409, "Conflict"},
    {410, "Gone"},
    {411, "Length Required"},
    {413, "Content Too Large"},
    {414, "URI Too Long"},
    {415, "Unsupported Media Type"},
    {422, "Unprocessable Content"},
    {429, "Too Many Requests"},
    {431, "Request Header Fields Too Large"},
    {501, "Not Implemented"},
    {503, "Service Unavailable"},
    {505, "HTTP Version Not Supported"},
}};

std::string_view reason_of(int status) {
  const auto* const found = std::ranges::find(kReasons, status, &std::pair<int, std::string_view>::first);
  return found == kReasons.end() ? "Internal Server Error" : found->second;
}

std::size_t body_bytes_of(const HttpAnswer& answer) {
  std::size_t bytes = answer.pieces.empty() ? answer.body.size() : 0;
  for (const std::string& piece : answer.pieces) bytes += piece.size();
  return bytes;
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

bool has_body(const HttpAnswer& answer) {
  return answer.status != 204 && answer.status != 304;
}

std::string answer_head(const HttpAnswer& answer, const Headers& common, const AnswerForm& form) {
  std::string text;
  const auto line = [&](std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(text), "{}: {}\r\n", name, value);
  };
  fmt::format_to(std::back_inserter(text), "HTTP/1.1 {} {}\r\n", answer.status, reason_of(answer.status));
  for (const auto& [name, value] : common) line(name, value);
  for (const auto& [name, value] : answer.headers) line(name, value);
  if (has_body(answer)) line("Content-Type", answer.type);
  if (answer.stream && form.in_chunks) line("Transfer-Encoding", "chunked");
  if (!answer.stream && has_body(answer)) line("Content-Length", std::to_string(body_bytes_of(answer)));
  if (!form.stays_open) line("Connection", "close");
  return text + "\r\n";
}

}  // namespace queries
