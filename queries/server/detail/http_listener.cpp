// The only source that knows the library for sockets.
#include "queries/server/detail/http_listener.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <iterator>
#include <list>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "base/memory_limit.h"
#include "base/propagate.h"
#include "queries/server/detail/client_connection.h"
#include "queries/server/detail/connection_threads.h"
#include "queries/server/detail/content_coding.h"
#include "queries/server/detail/request_head.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using boost::asio::ip::tcp;
using SystemCode = boost::system::error_code;
using Clock = std::chrono::steady_clock;

// Until a head is complete, from the connection or, on one that stayed open, from its first byte.
constexpr std::chrono::seconds kHeadTime(10);
// Until the next request of a connection.
constexpr std::chrono::seconds kIdleTime(60);
// Until a client has taken its answer and closed, and what it may send until then.
constexpr std::chrono::seconds kDrainTime(20);
constexpr std::size_t kDrainBytes = std::size_t{64} << 20U;
// Connections that wait to be accepted.
constexpr int kBacklog = 511;
// The bytes that a slow reader must take before it counts as silent; the system would let it grow to megabytes.
constexpr int kSendBytes = 1 << 18;
// Requests that wait for a thread; beyond them no connection is accepted.
constexpr std::size_t kMostWaiting = 1024;
// A client for whom a thread has waited for so long gives way when other requests wait.
constexpr std::chrono::seconds kPatience(1);
// A client that sends its next request so soon keeps its thread.
constexpr std::chrono::milliseconds kHaste(3);
constexpr std::chrono::milliseconds kRound(1000);
constexpr std::chrono::milliseconds kBusyRound(50);

// Answers that nobody takes must not keep the memory of others.
bool is_memory_short() {
  return algebra3d::ProcessMemory::used() > algebra3d::ProcessMemory::limit() / 4 * 3;
}

bool is_out_of_descriptors(const SystemCode& code) {
  return code.value() == EMFILE || code.value() == ENFILE || code.value() == ENOBUFS || code.value() == ENOMEM;
}

/// A connection, and its place among those that no thread answers.
struct OpenConnection {
  explicit OpenConnection(tcp::socket accepted) : socket(std::move(accepted)), client(socket.native_handle()) {}

  tcp::socket socket;
  ClientConnection client;
  RequestHead head = RequestHead();
  Clock::time_point deadline = Clock::now() + kHeadTime;
  bool is_idle = false;      // answered a request, and got nothing since
  bool is_draining = false;  // got its last answer
  std::size_t drained = 0;
  std::list<std::shared_ptr<OpenConnection>>::iterator place = {};
};
using OpenPointer = std::shared_ptr<OpenConnection>;

/// The requests that are being answered.
class AnsweredClients {
 public:
  /// One of them, while it lives.
  class Entry {
   public:
    Entry(AnsweredClients& clients, ClientConnection& client) : clients_(clients), client_(client) {
      const std::lock_guard lock(clients_.mutex_);
      clients_.clients_.insert(&client_);
      if (clients_.is_ending_) client_.shut(SHUT_RD);
    }
    ~Entry() {
      const std::lock_guard lock(clients_.mutex_);
      clients_.clients_.erase(&client_);
    }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    AnsweredClients& clients_;
    ClientConnection& client_;
  };

  /// Gives up the clients, at most `count`, that have been waited for longest, if longer than kPatience.
  void give_up_slowest(std::size_t count) {
    const std::lock_guard lock(mutex_);
    std::multimap<Clock::time_point, ClientConnection*> slow;
    const auto latest = Clock::now() - kPatience;
    for (ClientConnection* client : clients_)
      if (const auto since = client->waits_since(); since && *since < latest) slow.emplace(*since, client);
    for (auto each = slow.begin(); each != slow.end() && count > 0; ++each, --count) each->second->give_up();
  }
  /// Ends all: those that wait for a body at once, those that still write an answer after a while.
  void end() {
    constexpr std::chrono::milliseconds kWhile(500);
    for (const auto end = Clock::now() + kWhile; shut(SHUT_RD) > 0 && Clock::now() < end;)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    shut(SHUT_RDWR);
  }

 private:
  std::size_t shut(int how) {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    for (const ClientConnection* client : clients_) client->shut(how);
    return clients_.size();
  }

  std::mutex mutex_;  // guards what follows
  std::set<ClientConnection*> clients_;
  bool is_ending_ = false;
};

// Also called for a client that is gone: the stream then ends what it tells about.
bool send_streamed(ClientConnection& client, const HttpAnswer& answer, bool in_chunks, bool is_sent) {
  answer.stream([&](std::string_view piece) {
    if (!in_chunks) return is_sent = is_sent && client.write(piece);
    // An empty chunk would be the end.
    if (!piece.empty()) is_sent = is_sent && client.write(fmt::format("{:x}\r\n{}\r\n", piece.size(), piece));
    return is_sent;
  });
  return is_sent && (!in_chunks || client.write("0\r\n\r\n"));
}

bool send_answer(ClientConnection& client, const HttpAnswer& answer, const Headers& common, const AnswerForm& form,
                 bool is_without_body) {
  const bool has_more = !is_without_body && has_body(answer);
  const bool is_sent = client.write(answer_head(answer, common, form), has_more && !answer.stream);
  if (answer.stream && has_more) return send_streamed(client, answer, form.in_chunks, is_sent);
  if (!is_sent || !has_more) return is_sent;
  if (answer.pieces.empty()) return client.write(answer.body);
  return std::ranges::all_of(answer.pieces, [&](const std::string& piece) { return client.write(piece); });
}

/// One thread accepts connections, reads the heads of requests and waits for clients that have their last answer, so
/// that clients that are slow with these hold no thread. A request whose head is complete gets a thread, which waits
/// for its client by itself.
class Listener final : public HttpListener {
 public:
  Listener(const ListenerLimits& limits, Headers common)
      : limits_(limits), common_(std::move(common)), threads_(limits.requests) {}
  ~Listener() override = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  algebra3d::Status bind_to(const std::string& address, int port) {
    SystemCode code;
    const auto found = tcp::resolver(sockets_).resolve(address, std::to_string(port), tcp::resolver::passive, code);
    const tcp::endpoint endpoint = code ? tcp::endpoint() : found.begin()->endpoint();
    if (!code) acceptor_.open(endpoint.protocol(), code);
    // Not SO_REUSEPORT, which would let two servers share a port. Connections inherit the others.
    if (!code) acceptor_.set_option(boost::asio::socket_base::reuse_address(true), code);
    if (!code) acceptor_.set_option(boost::asio::socket_base::send_buffer_size(kSendBytes), code);
    if (!code) acceptor_.set_option(tcp::no_delay(true), code);
    if (!code) acceptor_.bind(endpoint, code);
    if (!code) acceptor_.listen(kBacklog, code);
    if (code) return Error{ErrorCode::io_error, "cannot listen on {} port {}: {}", address, port, code.message()};
    port_ = acceptor_.local_endpoint().port();
    return {};
  }

  int port() const override { return port_; }
  void run(Answer answer) override {
    answer_ = std::move(answer);
    for (bool is_over = false; !is_over;) {
      try {
        begin_round();
        sockets_.run();
        is_over = true;
      } catch (const std::bad_alloc&) {
        // Memory did not suffice for this connection; the others go on.
      }
    }
    threads_.shutdown();
  }
  void stop() override {
    is_stopping_ = true;
    boost::asio::post(sockets_, [this] {
      SystemCode ignored;
      acceptor_.close(ignored);
      while (!waiting_.empty()) close(waiting_.front());
      sockets_.stop();
    });
    answered_.end();
  }

 private:
  // Closes who is late, and makes room where it is scarce.
  void begin_round() {
    is_busy_ = threads_.waiting() > 0 || is_memory_short();
    round_.expires_after(is_busy_ ? kBusyRound : kRound);
    round_.async_wait([this](const SystemCode& code) {
      if (!code) begin_round();
    });
    if (is_busy_) answered_.give_up_slowest(std::max<std::size_t>(threads_.waiting(), 1));
    close_late();
    if (!is_accepting_) accept();
  }

  void accept() {
    is_accepting_ = threads_.waiting() < kMostWaiting;
    if (!is_accepting_) return;
    acceptor_.async_accept([this](const SystemCode& code, tcp::socket socket) {
      is_accepting_ = false;
      if (is_stopping_) return;
      if (code && is_out_of_descriptors(code)) {
        if (waiting_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        close_oldest();
      }
      if (!code) {
        while (waiting_.size() >= limits_.unanswered) close_oldest();
        await(std::make_shared<OpenConnection>(std::move(socket)));
      }
      accept();
    });
  }

  void await(const OpenPointer& open) {
    open->place = waiting_.insert(waiting_.end(), open);
    await_bytes(open);
  }

  void await_bytes(const OpenPointer& open) {
    open->socket.async_wait(tcp::socket::wait_read, [this, open](const SystemCode& code) {
      if (!code) take_bytes(open);
    });
  }

  void take_bytes(const OpenPointer& open) {
    std::array<char, std::size_t{64} << 10U> piece;  // NOLINT(*-member-init): written by the system
    const ssize_t count = ::recv(open->client.socket(), piece.data(), piece.size(), MSG_DONTWAIT);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return await_bytes(open);
    if (count <= 0) return close(open);
    if (open->is_draining) {
      open->drained += static_cast<std::size_t>(count);
      return open->drained > kDrainBytes ? close(open) : await_bytes(open);
    }
    if (std::exchange(open->is_idle, false)) open->deadline = Clock::now() + kHeadTime;
    switch (open->head.add({piece.data(), static_cast<std::size_t>(count)})) {
      case RequestHead::State::incomplete:
        return await_bytes(open);
      case RequestHead::State::refused:
        refuse(open, open->head.refusal());
        return await_bytes(open);
      case RequestHead::State::complete:
        waiting_.erase(open->place);
        threads_.start([this, open] { answer(open); });
        if (!is_busy_ && (threads_.waiting() > 0 || is_memory_short())) begin_round();
    }
  }

  // On a thread of its own, which stays with a client that sends the next request at once.
  void answer(const OpenPointer& open) {
    auto next = RequestHead::State::complete;
    bool stays_open = true;
    {
      const AnsweredClients::Entry entry(answered_, open->client);
      while (next == RequestHead::State::complete && stays_open) {
        stays_open = answer_request(open->head, open->client);
        open->head = RequestHead();
        if (stays_open) next = read_next(open->head, open->client);
      }
    }
    boost::asio::post(sockets_, [this, open, stays_open, next] {
      if (!stays_open) {
        open->client.shut(SHUT_WR);
        drain(open);
      } else if (next == RequestHead::State::refused) {
        refuse(open, open->head.refusal());
      } else {
        open->is_idle = open->head.is_empty();
        open->deadline = Clock::now() + (open->is_idle ? kIdleTime : kHeadTime);
      }
      await(open);
    });
  }

  // Reads the next request if it begins within kHaste and no others wait for the thread: as much as has come.
  RequestHead::State read_next(RequestHead& head, ClientConnection& client) {
    if (threads_.waiting() > 0 || !client.has_come_within(kHaste)) return RequestHead::State::incomplete;
    std::array<char, std::size_t{16} << 10U> piece;  // NOLINT(*-member-init): written by the system
    const ssize_t count = ::recv(client.socket(), piece.data(), piece.size(), MSG_DONTWAIT);
    // An end is found again by whoever waits for the client next.
    return count > 0 ? head.add({piece.data(), static_cast<std::size_t>(count)}) : RequestHead::State::incomplete;
  }

  // False: the connection ends.
  bool answer_request(RequestHead& head, ClientConnection& client) {
    ClientBody body(client, head.body_bytes(), head.take_rest(), head.expects_continue());
    HttpRequest request = head.request();
    request.body = head.body_bytes() > 0 ? &body : nullptr;
    request.connection = &client;
    HttpAnswer answer;
    try {
      answer = answer_(request);
      encode(answer, request.list("accept-encoding"));
    } catch (const std::exception&) {
      answer = Refusal{500, "internal", "the request could not be answered"}.answer();
    }
    // The rest of a body, or bytes that have come too early, must never be taken for the next request.
    const bool stays_open = head.keeps_connection() && body.is_at_end() && !client.is_late() && !is_stopping_;
    const AnswerForm form{.stays_open = stays_open, .in_chunks = head.is_of_version_1_1()};
    return send_answer(client, answer, common_, form, head.is_of_head_method()) && stays_open;
  }

  // A connection closed at once would be reset if its client still sends, and the client might lose the answer.
  static void drain(const OpenPointer& open) {
    open->is_draining = true;
    open->deadline = Clock::now() + kDrainTime;
  }

  // The refusal is short, and nothing was sent before: the system takes it at once.
  void refuse(const OpenPointer& open, const Refusal& refusal) {
    const HttpAnswer answer = refusal.answer();
    const std::string text = answer_head(answer, common_, {}) + (open->head.is_of_head_method() ? "" : answer.body);
    (void)!::send(open->client.socket(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    open->client.shut(SHUT_WR);
    drain(open);
  }

  void close(const OpenPointer& open) {
    const OpenPointer kept = open;
    SystemCode ignored;
    kept->socket.close(ignored);
    waiting_.erase(kept->place);
  }

  // A connection on which nothing was sent is closed without a word: browsers open some in advance, and would take an
  // answer for that of their next request.
  static bool is_told(const OpenConnection& open) { return !open.is_draining && !open.head.is_empty(); }

  void close_late() {
    const auto now = Clock::now();
    for (auto each = waiting_.begin(); each != waiting_.end();) {
      const OpenPointer open = *each++;
      if (open->deadline > now) continue;
      if (is_told(*open))
        refuse(open, {408, "timeout", "the head of the request did not arrive in time"});
      else
        close(open);
    }
  }

  // A client whose head is whole within the round is never the oldest for long; those that send none are.
  void close_oldest() {
    if (waiting_.empty()) return;
    const OpenPointer open = waiting_.front();
    if (is_told(*open))
      refuse(open, {408, "timeout", "the head of the request had not arrived when others needed the place"});
    close(open);
  }

  const ListenerLimits limits_;
  const Headers common_;
  Answer answer_;
  int port_ = 0;
  std::atomic<bool> is_stopping_ = false;
  boost::asio::io_context sockets_{1};
  tcp::acceptor acceptor_{sockets_};
  boost::asio::steady_timer round_{sockets_};
  bool is_accepting_ = false;
  bool is_busy_ = false;            // requests wait, or memory is short
  std::list<OpenPointer> waiting_;  // connections that no thread answers, oldest first
  AnsweredClients answered_;
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
