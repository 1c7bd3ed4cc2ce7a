#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

/// The connection of a request, as far as whoever answers it must know.
class Connection {
 public:
  virtual ~Connection() = default;
  Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  /// True if the client has closed it; asked now and then while a statement runs.
  virtual bool is_gone() const = 0;
};

/// The body of a request, read when it is asked for.
class Body {
 public:
  enum class Outcome : std::uint8_t { complete, too_large, too_slow, broken, refused };

  virtual ~Body() = default;
  Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  /// Passes the body in pieces to `take`, up to `limit` bytes; ends with `refused` if `take` returns false. Called
  /// once.
  virtual Outcome read(std::size_t limit, const std::function<bool(std::string_view)>& take) = 0;
};

/// A request as it was read from the network.
struct HttpRequest {
  std::string method;
  std::string path;  ///< as it was sent: its parts are percent-encoded
  std::multimap<std::string, std::string> query;
  std::multimap<std::string, std::string> headers;  ///< names in lower case
  Body* body = nullptr;                             ///< null: none
  const Connection* connection = nullptr;

  /// The first header of this name (in lower case), or empty.
  std::string header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? std::string() : found->second;
  }
  /// The headers of this name as one list, joined by commas.
  std::string list(const std::string& name) const {
    std::string result;
    const auto [first, last] = headers.equal_range(name);
    for (auto each = first; each != last; ++each) result += (each == first ? "" : ",") + each->second;
    return result;
  }
};

/// Sends a piece of a streamed answer. False if the client is gone.
using SendPiece = std::function<bool(std::string_view)>;

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
  /// If there are any, they are the body, one behind the other: a large one need not lie in one piece. None is empty.
  std::vector<std::string> pieces = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
  /// Whether the body is compressed for clients that take gzip; JSON is without being asked.
  bool is_compressible = false;
  /// If set, produces the body in pieces instead; must not throw. Called once, also where the client is gone already.
  std::function<void(const SendPiece&)> stream = {};
};

}  // namespace queries
