// With connection_stream and connection_threads the only sources that know the library for HTTP.
#include "queries/server/detail/http_listener.h"

#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "queries/server/detail/connection_stream.h"
#include "queries/server/detail/connection_threads.h"
#include "queries/server/detail/content_coding.h"
#include "queries/server/detail/http_library.h"
#include "queries/server/detail/lower_case.h"
#include "queries/server/detail/refusal.h"

namespace queries {
namespace {

using Clock = std::chrono::steady_clock;
using algebra3d::Error;
using algebra3d::ErrorCode;

// A body must arrive at a tenth of a megabyte per second, after a start of some seconds.
constexpr double kSlowestBytesPerSecond = 1e5;
constexpr std::chrono::seconds kBodyStart(20);
// The bytes of a refused body that are still read, so that the client reads the refusal and no reset.
constexpr std::size_t kDrained = std::size_t{64} << 20U;
// Connections that wait to be accepted; each request has one of its own.
constexpr int kBacklog = 511;

/// A body of announced length that the library reads piece by piece.
class ListenerBody final : public Body {
 public:
  ListenerBody(const httplib::ContentReader& reader, std::uint64_t size) : reader_(reader), size_(size) {}

  Outcome read(std::size_t limit, const std::function<bool(std::string_view)>& take) override {
    if (size_ > limit) return drained(Outcome::too_large);
    is_read_ = true;
    Outcome outcome = Outcome::complete;
    std::size_t bytes = 0;
    const auto start = Clock::now();
    const bool is_whole = reader_([&](const char* data, std::size_t size) {
      bytes += size;
      if (outcome != Outcome::complete) return bytes < kDrained;  // the rest of what is refused
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      if (elapsed > kBodyStart && static_cast<double>(bytes) < elapsed.count() * kSlowestBytesPerSecond)
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
    const auto start = Clock::now();
    if (size_ <= kDrained) reader_([&](const char*, std::size_t) { return Clock::now() - start < kBodyStart; });
    return outcome;
  }

  const httplib::ContentReader& reader_;
  const std::uint64_t size_;
  bool is_read_ = false;
};

// The header under which `Accept-Encoding` is hidden from the library.
constexpr const char* kAcceptEncoding = "Algebra3d-Accept-Encoding";

HttpRequest request_of(const httplib::Request& request) {
  HttpRequest result;
  result.method = request.method;
  result.path = request.target.substr(0, request.target.find('?'));
  for (const auto& [name, value] : request.params) result.query.emplace(name, value);
  for (const auto& [name, value] : request.headers)
    result.headers.emplace(name == kAcceptEncoding ? "accept-encoding" : in_lower_case(name), value);
  return result;
}

// The announced length of the body; nothing for a text that is no number.
std::optional<std::uint64_t> length_of(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  if (text.empty()) return 0;
  constexpr std::size_t kMostDigits = 18;
  const bool is_number =
      text.size() <= kMostDigits && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
  return is_number ? std::optional<std::uint64_t>(std::stoull(text)) : std::nullopt;
}

// The refusal of requests that the library would misunderstand, or take without a limit.
std::optional<Refusal> refuse_form(const httplib::Request& request) {
  const bool has_control = std::ranges::any_of(request.path, [](unsigned char c) { return c < ' ' || c == 0x7F; });
  if (has_control || !request.target.starts_with('/')) return Refusal::bad_request("the path of the request is none");
  if (request.has_header("Transfer-Encoding"))
    return Refusal{411, "bad_request", "expected a body with the header 'Content-Length'"};
  if (request.get_header_value_count("Content-Length") > 1 || !length_of(request))
    return Refusal::bad_request("the header 'Content-Length' is no number, or there are several");
  if (request.is_multipart_form_data())
    return Refusal{415, "bad_request", "expected JSON or the bytes of a file, got a form of several parts"};
  return std::nullopt;
}

// Nobody shows our pages in theirs, and they run nothing that is not ours.
void set_security_headers(httplib::Response& response) {
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("X-Frame-Options", "DENY");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header(
      "Content-Security-Policy",
      "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
      "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
}

// Pages lie in the program as they are sent to browsers.
void unpack(HttpAnswer& answer) {
  const auto coding =
      std::ranges::find(answer.headers, "Content-Encoding", [](const auto& header) { return header.first; });
  if (coding == answer.headers.end()) return;
  std::string content;
  httplib::detail::gzip_decompressor decompressor;
  const bool is_whole =
      decompressor.decompress(answer.body.data(), answer.body.size(), [&](const char* data, std::size_t size) {
        content.append(data, size);
        return true;
      });
  if (!is_whole) {
    answer = Refusal{500, "internal", "a page of the program cannot be unpacked"}.answer();
    return;
  }
  answer.headers.erase(coding);
  answer.body = std::move(content);
}

void give(HttpAnswer answer, httplib::Response& response) {
  response.status = answer.status;
  set_security_headers(response);
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

// Only whole answers are given, and the library does not compress them.
void forget_wishes(httplib::Request& request) {
  request.ranges.clear();
  request.headers.erase(kAcceptEncoding);
  if (request.has_header("Accept-Encoding"))
    request.set_header(kAcceptEncoding, request.get_header_value("Accept-Encoding"));
  request.headers.erase("Accept-Encoding");
}

// Gives a body to refusals of the library itself, perhaps before the wishes of the request were forgotten.
void explain(const httplib::Request& request, httplib::Response& response) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the library's own object, which it made as a variable
  forget_wishes(const_cast<httplib::Request&>(request));
  if (!response.body.empty()) return;
  Refusal refusal{response.status, "bad_request", "the request is no HTTP that this server understands"};
  if (response.status == 404) refusal = Refusal::not_found("there is no path '" + request.path + "'");
  if (response.status == 413) refusal = {413, "too_large", "the body is too large"};
  if (response.status == 414) refusal = {414, "too_large", "the address is too long"};
  give(refusal.answer(), response);
}

/// The library's server with connections that are ours.
class Library final : public httplib::Server {
 public:
  using Handle = std::function<void(const httplib::Request&, httplib::Response&, Body*, const Connection*)>;

  Library(std::size_t most_connections, Handle handle) : handle_(std::move(handle)) {
    new_task_queue = [most_connections] { return new ConnectionThreads(most_connections); };
    // Without SO_REUSEPORT, which would let two servers share a port.
    set_socket_options([this](int socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
      // The bytes that a slow reader must take before it counts as silent; the system would let it grow to megabytes.
      const int send_bytes = 1 << 18;
      setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &send_bytes, sizeof(send_bytes));
      listening_ = socket;
    });
    set_error_handler(Handler(explain));
    set_exception_handler([](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
      give(Refusal{500, "internal", "the request could not be answered"}.answer(), response);
    });
    set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
      const auto refusal = refuse_form(request);
      if (refusal) give(refusal->answer(), response);
      return refusal ? HandlerResponse::Handled : HandlerResponse::Unhandled;
    });
    const char* const any = R"([\s\S]*)";
    const auto without_body = [this](const httplib::Request& request, httplib::Response& response) {
      handle_(request, response, nullptr, connection());
    };
    const auto with_body = [this](const httplib::Request& request, httplib::Response& response,
                                  const httplib::ContentReader& reader) {
      const std::uint64_t size = *length_of(request);
      if (size == 0) return handle_(request, response, nullptr, connection());
      ListenerBody body(reader, size);
      handle_(request, response, &body, connection());
      const int status = response.status;
      body.drain();
      response.status = status;  // the library changes it where a body is not read to its end
    };
    Get(any, without_body).Options(any, without_body);
    Post(any, with_body).Put(any, with_body).Patch(any, with_body).Delete(any, with_body);
  }

  int listening_socket() const { return listening_; }
  /// Ends all connections: those that wait for a request at once, those that still write an answer after a while.
  void shut_connections() {
    constexpr std::chrono::milliseconds kWhile(500);
    shut(SHUT_RD);
    for (const auto end = Clock::now() + kWhile; Clock::now() < end && shut(SHUT_RD) > 0;)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    shut(SHUT_RDWR);
  }

 private:
  // The connection of the request that this thread answers.
  static const Connection*& connection() {
    thread_local const Connection* current = nullptr;
    return current;
  }

  // One request on a connection: what a refused body leaves unread can never be taken for the next request.
  bool process_and_close_socket(int socket) override {
    note(socket, true);
    bool is_answered = false;
    {
      ConnectionStream stream(socket, {});
      connection() = &stream;
      bool is_closed = false;
      is_answered = process_request(stream, true, is_closed, forget_wishes);
      connection() = nullptr;
      note(socket, false);
    }
    return is_answered;
  }

  std::size_t shut(int how) {
    const std::lock_guard lock(mutex_);
    for (const int socket : sockets_) shutdown(socket, how);
    return sockets_.size();
  }

  void note(int socket, bool is_open) {
    const std::lock_guard lock(mutex_);
    if (is_open)
      sockets_.insert(socket);
    else
      sockets_.erase(socket);
  }

  const Handle handle_;
  int listening_ = -1;
  std::mutex mutex_;  // guards sockets_
  std::set<int> sockets_;
};

class Listener final : public HttpListener {
 public:
  explicit Listener(std::size_t most_connections)
      : server_(most_connections, [this](const httplib::Request& request, httplib::Response& response, Body* body,
                                         const Connection* connection) {
          HttpRequest given = request_of(request);
          given.body = body;
          given.connection = connection;
          HttpAnswer answer = answer_(given);
          if (!takes_gzip(given.header("accept-encoding"))) unpack(answer);
          give(std::move(answer), response);
        }) {}

  algebra3d::Status bind_to(const std::string& address, int port) {
    const bool is_bound =
        port == 0 ? (port_ = server_.bind_to_any_port(address)) > 0 : server_.bind_to_port(address, port);
    if (!is_bound)
      return Error{ErrorCode::io_error, "cannot listen on {} port {}: {}", address, port, std::strerror(errno)};
    if (port != 0) port_ = port;
    listen(server_.listening_socket(), kBacklog);
    return {};
  }

  int port() const override { return port_; }
  void run(Answer answer) override {
    answer_ = std::move(answer);
    server_.listen_after_bind();
  }
  bool is_running() const override { return server_.is_running(); }
  void stop() override {
    server_.stop();
    server_.shut_connections();
  }

 private:
  Library server_;
  Answer answer_;
  int port_ = 0;
};

}  // namespace

algebra3d::Result<std::unique_ptr<HttpListener>> HttpListener::bind(const std::string& address, int port,
                                                                    std::size_t most_connections) {
  auto listener = std::make_unique<Listener>(most_connections);
  ALGEBRA3D_RETURN_IF_ERROR(listener->bind_to(address, port));
  return std::unique_ptr<HttpListener>(std::move(listener));
}

}  // namespace queries
