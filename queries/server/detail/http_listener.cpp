// With connection_stream the only source that knows the library for HTTP.
#include "queries/server/detail/http_listener.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/memory_limit.h"
#include "base/propagate.h"
#include "queries/server/detail/acceptor.h"
#include "queries/server/detail/answer_text.h"
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
// Connections that wait to be accepted; each request has one of its own.
constexpr int kBacklog = 511;
// Requests that wait for a thread; beyond them no connection is accepted.
constexpr std::size_t kMostWaiting = 1024;
// A client for whom a thread has waited for so long gives way when other requests wait.
constexpr std::chrono::seconds kPatience(1);

/// A body of announced length that the library reads piece by piece. The Acceptor drains the unread rest, if the body
/// is too large or the request is refused.
class ListenerBody final : public Body {
 public:
  ListenerBody(const httplib::ContentReader& reader, std::uint64_t size, const ConnectionStream& stream)
      : reader_(reader), size_(size), stream_(stream) {}

  Outcome read(std::size_t limit, const std::function<bool(std::string_view)>& take) override {
    if (size_ > limit) return Outcome::too_large;
    Outcome outcome = Outcome::complete;
    std::size_t bytes = 0;
    const auto start = Clock::now();
    const bool is_whole = reader_([&](const char* data, std::size_t size) {
      bytes += size;
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      if (elapsed > kBodyStart && static_cast<double>(bytes) < elapsed.count() * kSlowestBytesPerSecond)
        outcome = Outcome::too_slow;
      else if (!take({data, size}))
        outcome = Outcome::refused;
      return outcome == Outcome::complete;
    });
    if (is_whole || outcome != Outcome::complete) return outcome;
    return stream_.is_late() ? Outcome::too_slow : Outcome::broken;
  }

 private:
  const httplib::ContentReader& reader_;
  const std::uint64_t size_;
  const ConnectionStream& stream_;
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

// The announced length of the body; nothing for a text that is not a number.
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
  if (has_control || !request.target.starts_with('/')) return Refusal::bad_request("the request has no valid path");
  if (request.has_header("Transfer-Encoding"))
    return Refusal{411, "bad_request", "expected a body with the header 'Content-Length'"};
  if (request.get_header_value_count("Content-Length") > 1 || !length_of(request))
    return Refusal::bad_request("the header 'Content-Length' is not a number, or there are several");
  if (request.is_multipart_form_data())
    return Refusal{415, "bad_request", "expected JSON or the bytes of a file, got a form of several parts"};
  return std::nullopt;
}

/// Sends the pieces; the library may ask for a part of the whole, for a request with a range.
void give_pieces(HttpAnswer answer, httplib::Response& response) {
  std::size_t size = 0;
  for (const std::string& piece : answer.pieces) size += piece.size();
  response.set_content_provider(
      size, answer.type,
      [pieces = std::move(answer.pieces)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        for (const std::string_view piece : pieces) {
          if (offset < piece.size()) {
            const std::string_view part = piece.substr(offset, length);
            return sink.write(part.data(), part.size());
          }
          offset -= piece.size();
        }
        return false;
      });
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
  if (answer.status == 204 || answer.status == 304) return;
  if (!answer.pieces.empty()) return give_pieces(std::move(answer), response);
  // One copy less than set_content: files may have hundreds of megabytes.
  response.body = std::move(answer.body);
  response.set_header("Content-Type", answer.type);
}

// The library does not compress answers. Several lines of the header are one list.
void forget_wishes(httplib::Request& request) {
  request.headers.erase(kAcceptEncoding);
  std::vector<std::string> wishes;
  const auto [first, last] = request.headers.equal_range("Accept-Encoding");
  for (auto each = first; each != last; ++each) wishes.push_back(each->second);
  if (!wishes.empty()) request.set_header(kAcceptEncoding, fmt::format("{}", fmt::join(wishes, ",")));
  request.headers.erase("Accept-Encoding");
}

// Gives a body to refusals of the library itself, perhaps before the wishes of the request were forgotten.
void explain(const httplib::Request& request, httplib::Response& response) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the library's own object, which it made as a variable
  forget_wishes(const_cast<httplib::Request&>(request));
  if (!response.body.empty()) return;
  Refusal refusal{response.status, "bad_request", "the request has no valid address"};
  if (response.status == 404) refusal = Refusal::not_found("there is no path '" + request.path + "'");
  if (response.status == 413) refusal = {413, "too_large", "the body is too large"};
  give(refusal.answer(), response);
}

/// The requests that are being answered.
class OpenStreams {
 public:
  void add(ConnectionStream& stream) {
    const std::lock_guard lock(mutex_);
    streams_.insert(&stream);
    if (is_ending_) stream.shut(SHUT_RD);
  }
  void remove(ConnectionStream& stream) {
    const std::lock_guard lock(mutex_);
    streams_.erase(&stream);
  }
  /// Gives up the streams, at most `count`, whose clients have been waited for longest, if longer than kPatience.
  void give_up_slowest(std::size_t count) {
    const std::lock_guard lock(mutex_);
    std::multimap<Clock::time_point, ConnectionStream*> slow;
    const auto latest = Clock::now() - kPatience;
    for (ConnectionStream* stream : streams_)
      if (const auto since = stream->waits_since(); since && *since < latest) slow.emplace(*since, stream);
    for (auto each = slow.begin(); each != slow.end() && count > 0; ++each, --count) each->second->give_up();
  }
  /// Ends all: those that wait for a request at once, those that still write an answer after a while.
  void end() {
    constexpr std::chrono::milliseconds kWhile(500);
    shut(SHUT_RD);
    for (const auto end = Clock::now() + kWhile; Clock::now() < end && shut(SHUT_RD) > 0;)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    shut(SHUT_RDWR);
  }

 private:
  std::size_t shut(int how) {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    for (const ConnectionStream* stream : streams_) stream->shut(how);
    return streams_.size();
  }

  std::mutex mutex_;  // guards what follows
  std::set<ConnectionStream*> streams_;
  bool is_ending_ = false;
};

/// The library's server, which binds the address and understands requests; connections are ours.
class Library final : public httplib::Server {
 public:
  using Handle = std::function<void(const httplib::Request&, httplib::Response&, Body*, const Connection*)>;

  Library(const Headers& common, Handle handle) : handle_(std::move(handle)) {
    set_default_headers({common.begin(), common.end()});
    // Without SO_REUSEPORT, which would let two servers share a port.
    set_socket_options([](int socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
      // The bytes that a slow reader must take before it counts as silent; the system would let it grow to megabytes.
      const int send_bytes = 1 << 18;
      setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &send_bytes, sizeof(send_bytes));
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
      handle_(request, response, nullptr, current());
    };
    const auto with_body = [this](const httplib::Request& request, httplib::Response& response,
                                  const httplib::ContentReader& reader) {
      const std::uint64_t size = *length_of(request);
      if (size == 0) return handle_(request, response, nullptr, current());
      ListenerBody body(reader, size, *current());
      handle_(request, response, &body, current());
    };
    Get(any, without_body).Options(any, without_body);
    Post(any, with_body).Put(any, with_body).Patch(any, with_body).Delete(any, with_body);
  }

  /// Starts to listen; the socket.
  int listening() const {
    const int socket = svr_sock_;
    ::listen(socket, kBacklog);
    ::fcntl(socket, F_SETFL, O_NONBLOCK);  // NOLINT(*-vararg)
    return socket;
  }
  void close() {
    if (const int socket = svr_sock_.exchange(INVALID_SOCKET); socket != INVALID_SOCKET) ::close(socket);
  }

  /// Answers the request of a connection. One request on each: the unread rest of a refused body can never be taken for
  /// the next request.
  void answer(ConnectionStream& stream) {
    current() = &stream;
    bool is_closed = false;
    process_request(stream, true, is_closed, [&stream](httplib::Request& request) {
      forget_wishes(request);
      const bool is_endless = request.has_header("Transfer-Encoding") || !length_of(request);
      stream.expect_body(is_endless ? std::numeric_limits<std::uint64_t>::max() : *length_of(request));
    });
    current() = nullptr;
  }

 private:
  // The connection of the request that this thread answers.
  static ConnectionStream*& current() {
    thread_local ConnectionStream* stream = nullptr;
    return stream;
  }

  const Handle handle_;
};

class Listener final : public HttpListener {
 public:
  Listener(const ListenerLimits& limits, const Headers& common)
      : library_(common,
                 [this](const httplib::Request& request, httplib::Response& response, Body* body,
                        const Connection* connection) {
                   HttpRequest given = request_of(request);
                   given.body = body;
                   given.connection = connection;
                   HttpAnswer answer = answer_(given);
                   encode(answer, given.header("accept-encoding"));
                   give(std::move(answer), response);
                 }),
        acceptor_(
            {.connections = limits.unanswered}, common,
            [this](auto socket, auto bytes) { take(std::move(socket), std::move(bytes)); }, [this] { return load(); }),
        threads_(limits.requests) {}
  ~Listener() override { library_.close(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  algebra3d::Status bind_to(const std::string& address, int port) {
    const bool is_bound =
        port == 0 ? (port_ = library_.bind_to_any_port(address)) > 0 : library_.bind_to_port(address, port);
    if (!is_bound)
      return Error{ErrorCode::io_error, "cannot listen on {} port {}: {}", address, port, std::strerror(errno)};
    if (port != 0) port_ = port;
    listening_ = library_.listening();
    return {};
  }

  int port() const override { return port_; }
  void run(Answer answer) override {
    answer_ = std::move(answer);
    acceptor_.run(listening_);
    library_.close();
    threads_.shutdown();
  }
  void stop() override {
    acceptor_.stop();
    streams_.end();
  }

 private:
  void take(algebra3d::Descriptor socket, std::string bytes) {
    const auto stream = std::make_shared<ConnectionStream>(std::move(socket), std::move(bytes));
    threads_.start([this, stream] {
      streams_.add(*stream);
      library_.answer(*stream);
      streams_.remove(*stream);
      if (algebra3d::Descriptor unread = stream->end(); unread.number() >= 0) acceptor_.drain(std::move(unread));
    });
  }

  // Answers that nobody takes must not keep the memory of others.
  static bool is_memory_short() { return algebra3d::ProcessMemory::used() > algebra3d::ProcessMemory::limit() / 4 * 3; }

  // Clients that are slow with a body, or in taking an answer, hold a thread each; where these are too few, they go.
  Acceptor::Load load() {
    const std::size_t waiting = threads_.waiting();
    if (is_memory_short()) {
      streams_.give_up_slowest(1);
      return Acceptor::Load::heavy;
    }
    if (waiting == 0) return Acceptor::Load::light;
    streams_.give_up_slowest(waiting);
    return waiting < kMostWaiting ? Acceptor::Load::heavy : Acceptor::Load::full;
  }

  Library library_;
  Answer answer_;
  int listening_ = -1;
  int port_ = 0;
  OpenStreams streams_;
  Acceptor acceptor_;
  ConnectionThreads threads_;
};

}  // namespace

algebra3d::Result<std::unique_ptr<HttpListener>> HttpListener::bind(const std::string& address, int port,
                                                                    const ListenerLimits& limits,
                                                                    const Headers& common) {
  auto listener = std::make_unique<Listener>(limits, common);
  A3D_TRY(listener->bind_to(address, port));
  return std::unique_ptr<HttpListener>(std::move(listener));
}

}  // namespace queries
