#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "queries/server/detail/http.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// Limits of the head of a request: its request line and headers.
struct HeadLimits {
  std::size_t line_bytes = 8192;  ///< of one line with its end
  std::size_t bytes = std::size_t{64} << 10U;
};

/// The head of a request, put together from pieces as they arrive, and checked line by line, so that the first wrong
/// line is known before the rest is there. RFC 9112 is read strictly where clients and servers differ (ends of lines,
/// blanks before colons, folded lines, lengths of bodies), as smuggled requests live from such differences.
class RequestHead {
 public:
  enum class State : std::uint8_t { incomplete, complete, refused };

  explicit RequestHead(const HeadLimits& limits = {}) : limits_(limits) {}

  /// Takes the next bytes; not to be called when the head is complete or refused. Bytes behind the head are kept.
  State add(std::string_view piece);
  /// True if nothing but empty lines has come.
  bool is_empty() const { return head_bytes_ == 0 && rest_.empty(); }
  /// True for a request whose answer has no body.
  bool is_of_head_method() const { return method_ == "HEAD"; }
  /// Why it is refused. Statuses: 400, 411, 414, 415, 431, 501, 505.
  const Refusal& refusal() const { return *refusal_; }

  // The rest is for a complete head.

  /// The request without its body, and without the headers `Range`, which the server ignores.
  HttpRequest request() const;
  /// The announced length of the body.
  std::uint64_t body_bytes() const { return body_bytes_; }
  /// True for HTTP/1.1, whose clients know answers in chunks, and leave the connection open.
  bool is_of_version_1_1() const { return is_of_version_1_1_; }
  /// True if the client may send another request on the connection.
  bool keeps_connection() const;
  /// True if the client waits to be told that it may send the body.
  bool expects_continue() const;
  /// The bytes that came after the head.
  std::string take_rest() { return std::move(rest_); }

 private:
  State refuse(Refusal refusal);
  std::optional<Refusal> refuse_size(std::size_t line_bytes) const;
  std::optional<Refusal> take_line(std::string_view line);
  std::optional<Refusal> take_request_line(std::string_view line);
  std::optional<Refusal> take_header(std::string_view line);
  std::optional<Refusal> take_form();
  bool has_token(const std::string& name, std::string_view token) const;

  HeadLimits limits_;
  std::string method_;  // empty until the request line was read
  std::string target_;
  bool is_of_version_1_1_ = false;
  std::multimap<std::string, std::string> headers_;  // names in lower case
  std::uint64_t body_bytes_ = 0;
  std::size_t head_bytes_ = 0;  // of the lines that were read
  std::string rest_;            // what came after them
  std::optional<Refusal> refusal_;
};

}  // namespace queries
