#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "queries/transfer/detail/libpq.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

/// An answer of the server: rows of texts.
class ServerAnswer {
 public:
  ServerAnswer(const Libpq& pq, Libpq::Answer* answer) : pq_(&pq), answer_(answer, pq.clear) {}

  int row_count() const { return pq_->row_count(answer_.get()); }
  bool is_null(int row, int column) const { return pq_->cell_is_null(answer_.get(), row, column) != 0; }
  /// Empty for NULL.
  std::string text(int row, int column) const;
  bool is_true(int row, int column) const { return text(row, column) == "t"; }
  /// Number of rows that the statement has changed or copied; empty if it does not say.
  std::string affected() const { return pq_->affected(answer_.get()); }
  int status() const { return pq_->answer_status(answer_.get()); }
  /// The error, if it is one: the server's message with details, hint, and place in the copied rows.
  Status check() const;
  /// The SQL state of an error; else empty.
  std::string sql_state() const;

 private:
  const Libpq* pq_;
  std::unique_ptr<Libpq::Answer, void (*)(Libpq::Answer*)> answer_;
};

/// The environment of a connection, which outlives it.
struct ServerHost {
  const Libpq& pq;
  /// Ends waiting with the error `interrupted`, within a twentieth of a second; may be null.
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(const std::string&)> note;  ///< receives warnings of the server
};

/// A connection to a server of PostgreSQL that never blocks but in `wait`. Its texts are UTF-8. Used by one thread. The
/// destructor closes it, upon which the server undoes an open transaction.
class ServerConnection {
 public:
  /// Errors: wrong_usage for a text that is not a conninfo; io_error with the reason of the server or the system.
  static Result<std::unique_ptr<ServerConnection>> open(const ServerHost& host, const std::string& conninfo);
  ServerConnection(const ServerConnection&) = delete;
  ServerConnection& operator=(const ServerConnection&) = delete;
  ~ServerConnection() = default;

  const Libpq& pq() const { return host_.pq; }
  Libpq::Connection* handle() const { return connection_.get(); }
  std::string database() const { return pq().database(handle()); }

  /// Runs statements, the last of which may have rows; with parameters $1, $2, ... one statement. When it is
  /// interrupted, the server is asked to end it. Errors: those of the server, interrupted.
  Result<ServerAnswer> query(const std::string& sql, const std::vector<std::string>& parameters = {});
  /// Starts statements without waiting.
  Status send(const std::string& sql);
  /// The next answer to what was sent: waits for it. Nothing after the last one.
  Result<std::optional<ServerAnswer>> next_answer();
  /// The next answer without waiting: `is_ready` is set to false if it has not come yet.
  Result<std::optional<ServerAnswer>> next_answer_if_ready(bool& is_ready);

  struct Copied {
    std::unique_ptr<char, void (*)(void*)> bytes;
    std::size_t size = 0;
    std::string_view view() const { return {bytes.get(), size}; }
  };
  /// The next row that COPY TO STDOUT sends, after the answer kCopyOut; waits for it. Nothing at the end.
  Result<std::optional<Copied>> next_copied();

  /// Asks the server to end what it does, and waits for that a tenth of a second at most.
  void request_cancel() const;
  /// The error for a connection that does not work any more.
  Error lost() const;

  /// Waits until one of the connections can go on: there is input, or room for output if `is_writing`. Errors:
  /// interrupted.
  struct Waiting {
    const ServerConnection* connection;
    bool is_writing = false;
  };
  static Status wait(const std::vector<Waiting>& connections, const std::atomic<bool>* cancel);

 private:
  ServerConnection(const ServerHost& host, Libpq::Connection* connection)
      : host_(host), connection_(connection, host.pq.finish) {}
  Status establish();
  Status flush();
  Status wait_alone(bool is_writing) const { return wait({{this, is_writing}}, host_.cancel); }

  ServerHost host_;
  std::unique_ptr<Libpq::Connection, void (*)(Libpq::Connection*)> connection_;
};

/// An identifier of SQL in quotes.
std::string quoted_identifier(std::string_view name);

}  // namespace queries
