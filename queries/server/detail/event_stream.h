#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "queries/server/detail/http.h"

namespace queries {

/// Writes server-sent events. Source: WHATWG HTML, section 9.2.
class EventStream {
 public:
  explicit EventStream(const SendPiece& send) : send_(send) {}
  /// Sends an event. False if the client is gone.
  bool send(std::string_view event, std::string json) {
    std::ranges::replace(json, '\n', ' ');  // a line end would end the data, and is white space in JSON
    is_open_ = is_open_ && send_(fmt::format("event: {}\ndata: {}\n\n", event, json));
    return is_open_;
  }
  bool is_open() const { return is_open_; }

 private:
  const SendPiece& send_;
  bool is_open_ = true;
};

}  // namespace queries
