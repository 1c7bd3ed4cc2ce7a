#pragma once

#include <poll.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "queries/server/detail/answer_text.h"
#include "queries/server/detail/request_head.h"

namespace queries {

/// Limits of connections that nobody answers yet, or any more.
struct AcceptorLimits {
  std::size_t connections = 1024;       ///< at once; beyond it the oldest is closed
  std::chrono::seconds head_time{10};   ///< until a head is complete
  std::chrono::seconds drain_time{20};  ///< until a client has taken its answer and closed
  std::size_t drain_bytes = std::size_t{64} << 20U;
};

/// Accepts connections and reads the heads of their requests, all on one thread, so that clients that are slow with
/// them hold no thread and keep nobody waiting. Heads that are wrong or late are refused here. It also closes
/// connections whose client still sends when it has its answer: a connection closed at once would be reset, and the
/// client might lose the answer. Cost: linear in the open connections for each of its rounds.
class Acceptor {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Load : std::uint8_t {
    light,
    heavy,  ///< requests wait: ask again soon
    full,   ///< as many wait as may: accept no connection
  };
  /// Takes a connection whose head is complete, and the bytes that have come.
  using Take = std::function<void(algebra3d::Descriptor socket, std::string bytes)>;
  /// Called in each round with what it says of the requests that were taken.
  using EachRound = std::function<Load()>;

  /// `common`: headers of its refusals.
  Acceptor(const AcceptorLimits& limits, Headers common, Take take, EachRound each_round);
  Acceptor(const Acceptor&) = delete;
  Acceptor& operator=(const Acceptor&) = delete;
  ~Acceptor() = default;

  /// Accepts connections of a socket that listens, until `stop`; then closes those that it has.
  void run(int listening);
  /// Ends `run`, also one that has not begun. May be called by any thread.
  void stop();
  /// Closes a connection when its client has closed it, or does not in time. May be called by any thread.
  void drain(algebra3d::Descriptor socket);

 private:
  struct Open {
    algebra3d::Descriptor socket;
    Clock::time_point deadline;
    RequestHead head = RequestHead();
    bool is_draining = false;
    std::size_t drained = 0;
  };

  void wait(int listening, Load load);
  void take_drained();
  void accept_all(int listening);
  void read(Open& open);
  void refuse(Open& open, const Refusal& refusal);
  void close_late();
  void close_oldest();
  void wake();

  const AcceptorLimits limits_;
  const Headers common_;
  const Take take_;
  const EachRound each_round_;
  std::vector<Open> open_;      // oldest first
  std::vector<pollfd> polled_;  // of the bell, the listening socket and those of open_
  std::atomic<bool> is_stopping_ = false;
  algebra3d::Descriptor bell_;  // an eventfd that other threads ring

  std::mutex mutex_;  // guards what follows
  std::vector<algebra3d::Descriptor> to_drain_;
};

}  // namespace queries
