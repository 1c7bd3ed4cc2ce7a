// The only source that knows the library for HTTP.
#include "queries/server/detail/http_listener.h"

#include <httplib.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "queries/server/detail/client_socket.h"
#include "queries/server/detail/connection_threads.h"
#include "queries/server/detail/refusal.h"

namespace queries {
namespace {

using Clock = std::chrono::steady_clock;
using algebra3d::Error;
using algebra3d::ErrorCode;

// A body must arrive at a tenth of a megabyte per second, after a start of some seconds.
constexpr double kSlowestBytesPerSecond = 1e5;
constexpr std::chrono::seconds kBodyStart(20);
// What of a refused body is still read, so that the client reads the refusal and no reset.
constexpr std::size_t kDrained = std::size_t{64} << 20U;

/// A body that the library reads piece by piece.
class ListenerBody final : public Body {
 public:
  ListenerBody(const httplib::Request& request, const httplib::ContentReader& reader)
      : reader_(reader), announced_(request.has_header("Content-Length")
                                        ? request.get_header_value<std::uint64_t>("Content-Length")
                                        : 0) {}

  Outcome read(std::size_t limit, const std::function<bool(std::string_view)>& take) override {
    is_read_ = true;
    if (announced_ > limit) return drained(Outcome::too_large);
    Outcome outcome = Outcome::complete;
    std::size_t bytes = 0;
    const auto start = Clock::now();
    const bool is_whole = reader_([&](const char* data, std::size_t size) {
      bytes += size;
      if (outcome != Outcome::complete) return bytes < kDrained;  // the rest of what is refused
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      if (bytes > limit)
        outcome = Outcome::too_large;
      else if (elapsed > kBodyStart && static_cast<double>(bytes) < elapsed.count() * kSlowestBytesPerSecond)
        outcome = Outcome::too_slow;
      else if (!take({data, size}))
        outcome = Outcome::refused;
      return outcome != Outcome::too_slow;
    });
    return is_whole || outcome != Outcome::complete ? outcome : Outcome::broken;
  }

  /// Reads what nobody has read.
  void drain() {
    if (!is_read_) (void)drained(Outcome::refused);
  }

 private:
  Outcome drained(Outcome outcome) {
    is_read_ = true;
    std::size_t bytes = 0;
    const auto start = Clock::now();
    if (announced_ <= kDrained)
      reader_([&](const char*, std::size_t size) {
        bytes += size;
        return bytes <= kDrained && Clock::now() - start < kBodyStart;
      });
    return outcome;
  }

  const httplib::ContentReader& reader_;
  std::uint64_t announced_;
  bool is_read_ = false;
};

std::string in_lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

HttpRequest request_of(const httplib::Request& request) {
  HttpRequest result;
  result.method = request.method;
  result.path = request.path;
  for (const auto& [name, value] : request.params) result.query.emplace(name, value);
  for (const auto& [name, value] : request.headers) result.headers.emplace(in_lower_case(name), value);
  return result;
}

void give(HttpAnswer answer, httplib::Response& response) {
  response.status = answer.status;
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  if (answer.stream) {
    response.set_chunked_content_provider(
        answer.type, [stream = std::move(answer.stream)](std::size_t, httplib::DataSink& sink) {
          stream([&](std::string_view piece) { return sink.write(piece.data(), piece.size()); });
          sink.done();
          return true;
        });
    return;
  }
  if (answer.status == 204) return;
  // One copy less than set_content: files may have hundreds of megabytes.
  response.body = std::move(answer.body);
  response.set_header("Content-Type", answer.type);
}

// What the library refuses by itself.
void explain(const httplib::Request& request, httplib::Response& response) {
  if (!response.body.empty()) return;
  Refusal refusal{response.status, "bad_request", "the request is no HTTP that this server understands"};
  if (response.status == 404) refusal = Refusal::not_found("there is no path '" + request.path + "'");
  if (response.status == 413) refusal = {413, "too_large", "the body is too large"};
  if (response.status == 414) refusal = {414, "too_large", "the address is too long"};
  give(refusal.answer(), response);
}

class Listener final : public HttpListener {
 public:
  explicit Listener(std::size_t most_connections) {
    server_.new_task_queue = [most_connections] { return new ConnectionThreads(most_connections); };
    // One request on a connection: what a refused body leaves unread can never be taken for the next request.
    server_.set_keep_alive_max_count(1);
    server_.set_tcp_nodelay(true);
    server_.set_read_timeout(10);
    server_.set_write_timeout(30);
    server_.set_error_handler(httplib::Server::Handler(explain));
    const auto with_body = [this](const httplib::Request& request, httplib::Response& response,
                                  const httplib::ContentReader& reader) {
      ListenerBody body(request, reader);
      answer(request, response, &body);
      body.drain();
    };
    const auto without_body = [this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response, nullptr);
    };
    server_.Get(".*", without_body).Options(".*", without_body);
    server_.Post(".*", with_body).Put(".*", with_body).Patch(".*", with_body).Delete(".*", with_body);
  }

  algebra3d::Status bind_to(const std::string& address, int port) {
    const bool is_bound = port == 0 ? (port_ = server_.bind_to_any_port(address)) > 0 : server_.bind_to_port(address, port);
    if (!is_bound)
      return Error{ErrorCode::io_error, "cannot listen on {} port {}: {}", address, port, std::strerror(errno)};
    if (port != 0) port_ = port;
    return {};
  }

  int port() const override { return port_; }
  void run(Answer answer) override {
    answer_ = std::move(answer);
    server_.listen_after_bind();
  }
  void stop() override {
    server_.stop();
    shut_connections(port_);
  }

 private:
  void answer(const httplib::Request& request, httplib::Response& response, Body* body) {
    // Streams outlive this call, and so must what they ask.
    const auto connection = std::make_shared<ClientSocket>(request.remote_addr, request.remote_port);
    HttpRequest given = request_of(request);
    given.body = body;
    given.connection = connection.get();
    HttpAnswer answer = answer_(given);
    if (answer.stream)
      answer.stream = [connection, stream = std::move(answer.stream)](const SendPiece& send) { stream(send); };
    give(std::move(answer), response);
  }

  httplib::Server server_;
  Answer answer_;
  int port_ = 0;
};

// The library waits with select(), which cannot know descriptors beyond this number.
void limit_descriptors() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur <= FD_SETSIZE) return;
  limit.rlim_cur = FD_SETSIZE;
  setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

algebra3d::Result<std::unique_ptr<HttpListener>> HttpListener::bind(const std::string& address, int port,
                                                                    std::size_t most_connections) {
  limit_descriptors();
  auto listener = std::make_unique<Listener>(most_connections);
  ALGEBRA3D_RETURN_IF_ERROR(listener->bind_to(address, port));
  return std::unique_ptr<HttpListener>(std::move(listener));
}

}  // namespace queries
