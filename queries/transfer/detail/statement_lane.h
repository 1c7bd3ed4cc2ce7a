#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "queries/transfer/detail/server_connection.h"

namespace queries {

/// A connection that runs one statement after the other, also COPY FROM STDIN. It never waits: `advance` does what can
/// be done now.
class StatementLane {
 public:
  struct Step {
    std::string sql;                            ///< perhaps several statements, of which COPY is the last
    std::string rows = {};                      ///< for COPY, with beginning and end
    std::optional<std::uint64_t> changed = {};  ///< the rows that the last statement must change or copy
    /// The error for another number of rows, which it is given.
    std::function<Error(const std::string& affected)> when_others_changed = {};
  };

  explicit StatementLane(std::unique_ptr<ServerConnection> connection) : connection_(std::move(connection)) {}

  ServerConnection& connection() const { return *connection_; }
  /// Whether all statements have ended.
  bool is_idle() const { return steps_.empty(); }
  /// Adds a statement behind those that are to be run.
  Status add(Step step);
  /// Errors: those of the server, whose SQL state is then kept.
  Status advance();
  const std::string& sql_state() const { return sql_state_; }
  /// Whether the lane waits for room to send in; else for an answer.
  bool is_writing() const { return is_writing_; }

 private:
  Status start();
  Status send_rows();
  Status take_answers();
  Status take(const ServerAnswer& answer);

  std::unique_ptr<ServerConnection> connection_;
  std::deque<Step> steps_;  // the first one runs
  bool is_sending_ = false;
  std::size_t sent_ = 0;
  std::string affected_;  // by the last statement that has ended
  bool is_writing_ = false;
  std::string sql_state_;
};

}  // namespace queries
