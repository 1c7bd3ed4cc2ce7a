#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "queries/server/detail/refusal.h"

namespace queries {

/// Limits of the head of a request: its request line and headers.
struct HeadLimits {
  std::size_t line_bytes = 8192;  ///< of one line with its end
  std::size_t bytes = std::size_t{64} << 10U;
};

/// The head of a request, put together from pieces as they arrive, and checked line by line, so that the first wrong
/// line is known before the rest is there. The HTTP library understands every accepted head as it is meant: RFC 9112 is
/// read strictly where clients and servers differ (ends of lines, blanks before colons, folded lines), as smuggled
/// requests live from such differences.
class RequestHead {
 public:
  enum class State : std::uint8_t { incomplete, complete, refused };

  explicit RequestHead(const HeadLimits& limits = {}) : limits_(limits) {}

  /// Takes the next bytes; not to be called when the head is complete or refused. Bytes behind the head are kept.
  State add(std::string_view piece);
  /// True if nothing but empty lines has come.
  bool is_empty() const { return head_.empty() && rest_.empty(); }
  /// True for a request whose answer has no body.
  bool is_of_head_method() const { return head_.starts_with("HEAD "); }
  /// Why it is refused. Statuses: 400, 414, 431, 501, 505.
  const Refusal& refusal() const { return *refusal_; }
  /// The complete head without the headers `Range`, which the server ignores, and what came after it.
  std::string take() { return head_ + rest_; }

 private:
  State refuse(Refusal refusal);
  std::optional<Refusal> refuse_size(std::size_t line_bytes) const;
  std::optional<Refusal> refuse_line(std::string_view line) const;

  HeadLimits limits_;
  std::string head_;            // the lines that were checked
  std::size_t head_bytes_ = 0;  // of them, and of those that were left out
  std::string rest_;            // what came after them
  std::optional<Refusal> refusal_;
};

}  // namespace queries
