#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "queries/server/detail/answer_head.h"
#include "queries/server/detail/http.h"

namespace queries {

/// How many connections a server has at once.
struct ListenerLimits {
  std::size_t requests = 256;     ///< that are answered, each by a thread; others wait
  std::size_t unanswered = 1024;  ///< whose request has not come, or whose client has not taken its answer
};

/// Answers HTTP requests on a TCP port. A connection stays open for further requests, each of which comes when the one
/// before it is answered.
class HttpListener {
 public:
  using Answer = std::function<HttpAnswer(const HttpRequest&)>;

  /// Listens on an address; port 0 takes a free one. `common`: headers that every answer has. Errors: io_error with the
  /// reason.
  static algebra3d::Result<std::unique_ptr<HttpListener>> bind(const std::string& address, int port,
                                                               const ListenerLimits& limits, const Headers& common);
  virtual ~HttpListener() = default;
  HttpListener(const HttpListener&) = delete;
  HttpListener& operator=(const HttpListener&) = delete;

  virtual int port() const = 0;
  /// Answers requests by `answer`, which is called by several threads at once, until `stop`.
  virtual void run(Answer answer) = 0;
  /// Ends `run`, within a second also where clients neither send nor read; may be called by another thread, and before
  /// it has begun.
  virtual void stop() = 0;

 protected:
  HttpListener() = default;
};

}  // namespace queries
