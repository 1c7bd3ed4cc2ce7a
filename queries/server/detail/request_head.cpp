#include "queries/server/detail/request_head.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "queries/server/detail/lower_case.h"
#include "queries/server/detail/percent_coding.h"

namespace queries {
namespace {

constexpr std::array<std::string_view, 7> kMethods = {"GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"};
constexpr std::string_view kEnd = "\r\n";
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

// A text of form-urlencoded pairs, in which a blank is a plus sign.
std::string form_decoded(std::string_view text) {
  std::string result(text);
  std::ranges::replace(result, '+', ' ');
  return percent_decoded(result);
}

// The parameters behind the question mark of an address.
std::multimap<std::string, std::string> parameters_of(std::string_view text) {
  std::multimap<std::string, std::string> result;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string_view value = pair.substr(std::min(equals + 1, pair.size()));
    if (!pair.empty()) result.emplace(form_decoded(pair.substr(0, equals)), form_decoded(value));
  }
  return result;
}

// Nothing for a text that is not a number.
std::optional<std::uint64_t> length_of(std::string_view text) {
  constexpr std::size_t kMostDigits = 18;
  if (text.empty() || text.size() > kMostDigits || !std::ranges::all_of(text, is_digit)) return std::nullopt;
  std::uint64_t result = 0;
  for (const char c : text) result = result * 10 + static_cast<std::uint64_t>(c - '0');
  return result;
}

}  // namespace

RequestHead::State RequestHead::refuse(Refusal refusal) {
  refusal_ = std::move(refusal);
  return State::refused;
}

std::optional<Refusal> RequestHead::refuse_size(std::size_t line_bytes) const {
  if (line_bytes > limits_.line_bytes && method_.empty())
    return Refusal{414, "too_large",
                   fmt::format("the first line, with the address, is longer than {} bytes", limits_.line_bytes)};
  if (line_bytes > limits_.line_bytes)
    return Refusal{431, "too_large", fmt::format("a header is longer than {} bytes", limits_.line_bytes)};
  if (head_bytes_ + line_bytes > limits_.bytes)
    return Refusal{431, "too_large", fmt::format("the headers are longer than {} bytes together", limits_.bytes)};
  return std::nullopt;
}

std::optional<Refusal> RequestHead::take_line(std::string_view line) {
  if (has_control(line))
    return Refusal::bad_request("a line of the head ends without CR LF, or has control characters");
  return method_.empty() ? take_request_line(line) : take_header(line);
}

std::optional<Refusal> RequestHead::take_request_line(std::string_view line) {
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
  method_ = method;
  target_ = target.substr(0, target.find('#'));
  is_of_version_1_1_ = version == "HTTP/1.1";
  return std::nullopt;
}

std::optional<Refusal> RequestHead::take_header(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
    return Refusal::bad_request(
        fmt::format("the line '{}' is not a header; expected NAME: VALUE on one line", line.substr(0, kShown)));
  std::string name = in_lower_case(line.substr(0, colon));
  if (name != "range") headers_.emplace(std::move(name), algebra3d::trimmed(line.substr(colon + 1)));
  return std::nullopt;
}

// The address and the form of the body, about which several lines decide together.
std::optional<Refusal> RequestHead::take_form() {
  if (!target_.starts_with('/') || has_control(percent_decoded(target_.substr(0, target_.find('?')))))
    return Refusal::bad_request("the request has no valid path");
  if (headers_.contains("transfer-encoding"))
    return Refusal{411, "bad_request", "expected a body with the header 'Content-Length'"};
  const auto [first, last] = headers_.equal_range("content-length");
  const auto length = first == last ? 0 : length_of(first->second);
  if (!length || std::distance(first, last) > 1)
    return Refusal::bad_request("the header 'Content-Length' is not a number, or there are several");
  body_bytes_ = *length;
  if (const auto type = headers_.find("content-type");
      type != headers_.end() && in_lower_case(type->second).starts_with("multipart/form-data"))
    return Refusal{415, "bad_request", "expected JSON or the bytes of a file, got a form of several parts"};
  if (const auto coding = headers_.find("content-encoding");
      coding != headers_.end() && in_lower_case(coding->second) != "identity")
    return Refusal{415, "bad_request", "expected a body without 'Content-Encoding'"};
  return std::nullopt;
}

RequestHead::State RequestHead::add(std::string_view piece) {
  rest_ += piece;
  // RFC 9112, section 2.2: empty lines before a request are left out.
  while (method_.empty() && rest_.starts_with(kEnd)) rest_.erase(0, kEnd.size());
  if (method_.empty() && kEnd.starts_with(rest_)) return State::incomplete;
  // Clients that speak TLS send no ends of lines: without this refusal they would wait until the time is over.
  if (method_.empty() && !is_token({rest_.data(), 1}))
    return refuse(
        Refusal::bad_request("expected a request of HTTP; is the address meant to begin with http, not https?"));
  std::size_t begin = 0;
  bool is_complete = false;
  while (!is_complete) {
    const std::size_t end = rest_.find('\n', begin);
    const bool is_whole = end != std::string::npos;
    const std::string_view line = std::string_view(rest_).substr(begin, is_whole ? end + 1 - begin : end);
    if (auto refusal = refuse_size(line.size())) return refuse(*std::move(refusal));
    if (!is_whole) break;
    is_complete = line == kEnd;
    const std::string_view content = line.ends_with(kEnd) ? line.substr(0, line.size() - kEnd.size()) : line;
    if (auto refusal = is_complete ? take_form() : take_line(content)) return refuse(*std::move(refusal));
    head_bytes_ += line.size();
    begin = end + 1;
  }
  rest_.erase(0, begin);
  return is_complete ? State::complete : State::incomplete;
}

HttpRequest RequestHead::request() const {
  const std::size_t mark = std::min(target_.find('?'), target_.size());
  return {.method = method_,
          .path = target_.substr(0, mark),
          .query = parameters_of(std::string_view(target_).substr(std::min(mark + 1, target_.size()))),
          .headers = headers_};
}

// Whether a header, a list of tokens in one line or several, has a token.
bool RequestHead::has_token(const std::string& name, std::string_view token) const {
  const auto [first, last] = headers_.equal_range(name);
  return std::any_of(first, last,
                     [&](const auto& header) { return in_lower_case(header.second).find(token) != std::string::npos; });
}

bool RequestHead::keeps_connection() const {
  return is_of_version_1_1_ && !has_token("connection", "close");
}

bool RequestHead::expects_continue() const {
  return is_of_version_1_1_ && has_token("expect", "100-continue");
}

}  // namespace queries
