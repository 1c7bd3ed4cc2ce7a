#include "queries/server/detail/request_head.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "queries/server/detail/lower_case.h"

namespace queries {
namespace {

constexpr std::array<std::string_view, 7> kMethods = {"GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"};
constexpr std::string_view kEnd = "\r\n";
constexpr std::string_view kLastEnd = "\r\n\r\n";
// As much of a wrong line as a message shows.
constexpr std::size_t kShown = 80;

// RFC 9110, section 5.6.2: methods and names of headers.
bool is_token(std::string_view text) {
  constexpr std::string_view kSigns = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::ranges::all_of(text, [&](unsigned char c) {
    return (c < 0x80 && std::isalnum(c) != 0) || kSigns.find(static_cast<char>(c)) != std::string_view::npos;
  });
}

bool has_control(std::string_view line) {
  return std::ranges::any_of(line, [](unsigned char c) { return (c < ' ' && c != '\t') || c == 0x7F; });
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// `HTTP/1.1`, and also `HTTP/2`, as some write it.
bool is_version(std::string_view text) {
  constexpr std::string_view kName = "HTTP/";
  if (!text.starts_with(kName)) return false;
  text.remove_prefix(kName.size());
  return (text.size() == 1 && is_digit(text[0])) ||
         (text.size() == 3 && is_digit(text[0]) && text[1] == '.' && is_digit(text[2]));
}

std::optional<Refusal> refuse_request_line(std::string_view line) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  const bool has_parts = first != std::string_view::npos && first < last;
  const std::string_view method = line.substr(0, first);
  const std::string_view target = has_parts ? line.substr(first + 1, last - first - 1) : std::string_view();
  const std::string_view version = has_parts ? line.substr(last + 1) : std::string_view();
  if (!is_token(method) || target.empty() || target.find(' ') != std::string_view::npos || !is_version(version))
    return Refusal::bad_request(
        fmt::format("the first line '{}' is not a request; expected METHOD TARGET HTTP/1.1", line.substr(0, kShown)));
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    return Refusal{505, "bad_request", fmt::format("{}: expected HTTP/1.1 or HTTP/1.0", version)};
  if (std::ranges::find(kMethods, method) == kMethods.end())
    return Refusal{
        501, "method_not_allowed",
        fmt::format("no path has the method {}; known are {}", method.substr(0, kShown), fmt::join(kMethods, ", "))};
  return std::nullopt;
}

std::optional<Refusal> refuse_header(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon != std::string_view::npos && is_token(line.substr(0, colon))) return std::nullopt;
  return Refusal::bad_request(
      fmt::format("the line '{}' is not a header; expected NAME: VALUE on one line", line.substr(0, kShown)));
}

bool is_range(std::string_view line) {
  return in_lower_case(line.substr(0, line.find(':'))) == "range";
}

}  // namespace

RequestHead::State RequestHead::refuse(Refusal refusal) {
  refusal_ = std::move(refusal);
  return State::refused;
}

std::optional<Refusal> RequestHead::refuse_size(std::size_t line_bytes) const {
  if (line_bytes > limits_.line_bytes && head_.empty())
    return Refusal{414, "too_large",
                   fmt::format("the first line, with the address, is longer than {} bytes", limits_.line_bytes)};
  if (line_bytes > limits_.line_bytes)
    return Refusal{431, "too_large", fmt::format("a header is longer than {} bytes", limits_.line_bytes)};
  if (head_bytes_ + line_bytes > limits_.bytes)
    return Refusal{431, "too_large", fmt::format("the headers are longer than {} bytes together", limits_.bytes)};
  return std::nullopt;
}

std::optional<Refusal> RequestHead::refuse_line(std::string_view line) const {
  if (has_control(line))
    return Refusal::bad_request("a line of the head ends without CR LF, or has control characters");
  return head_.empty() ? refuse_request_line(line) : refuse_header(line);
}

RequestHead::State RequestHead::add(std::string_view piece) {
  rest_ += piece;
  // RFC 9112, section 2.2: empty lines before a request are left out.
  while (head_.empty() && rest_.starts_with(kEnd)) rest_.erase(0, kEnd.size());
  if (head_.empty() && kEnd.starts_with(rest_)) return State::incomplete;
  // Clients that speak TLS send no ends of lines: without this refusal they would wait until the time is over.
  if (head_.empty() && !is_token({rest_.data(), 1}))
    return refuse(
        Refusal::bad_request("expected a request of HTTP; is the address meant to begin with http, not https?"));
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = rest_.find('\n', begin);
    const bool is_whole = end != std::string::npos;
    const std::string_view line = std::string_view(rest_).substr(begin, is_whole ? end + 1 - begin : end);
    if (auto refusal = refuse_size(line.size())) return refuse(*std::move(refusal));
    if (!is_whole) break;
    const bool is_last = line == kEnd;
    const std::string_view content = line.ends_with(kEnd) ? line.substr(0, line.size() - kEnd.size()) : line;
    if (auto refusal = is_last ? std::nullopt : refuse_line(content)) return refuse(*std::move(refusal));
    if (!is_range(content)) head_ += line;
    head_bytes_ += line.size();
    begin = end + 1;
    if (is_last) break;
  }
  const bool is_complete = head_.ends_with(kLastEnd);
  rest_.erase(0, begin);
  return is_complete ? State::complete : State::incomplete;
}

}  // namespace queries
