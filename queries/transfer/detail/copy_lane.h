#pragma once

#include <memory>
#include <string>

#include "queries/transfer/detail/server_connection.h"

namespace queries {

/// A connection that stores one batch of rows after the other, each in a transaction: COPY, then a statement beside it,
/// then COMMIT. It never waits: `advance` does what can be done now. Another lane may store the next batch meanwhile,
/// which is committed only when this one is.
class CopyLane {
 public:
  enum class State : std::uint8_t {
    free,        ///< ready for a batch
    opening,     ///< waits for the server to take the rows
    sending,     ///< sends them
    ending,      ///< waits for the server to have stored them
    stored,      ///< to be committed
    recording,   ///< the statement beside the rows runs
    committing,  ///< waits for the end of the transaction
  };
  struct Batch {
    std::string rows;  ///< with beginning and end, as COPY takes them
    std::uint64_t row_count = 0;
    std::string record_sql;  ///< must change one row
  };

  explicit CopyLane(std::unique_ptr<ServerConnection> connection) : connection_(std::move(connection)) {}

  State state() const { return state_; }
  ServerConnection& connection() { return *connection_; }
  /// Requires `free`. The statements before COPY end with a semicolon, or are empty.
  Status store(Batch batch, const std::string& before_copy_sql, const std::string& copy_sql);
  /// Requires `stored`.
  Status commit();
  /// Errors: those of the server.
  Status advance();
  /// Whether the lane waits for room to send in; else for an answer.
  bool is_writing() const { return is_writing_; }

 private:
  Status send_rows();
  Status take_answers();
  Status take(const ServerAnswer& answer);
  Status end_of_answers();

  std::unique_ptr<ServerConnection> connection_;
  State state_ = State::free;
  Batch batch_;
  std::size_t sent_ = 0;
  bool has_sent_end_ = false;
  bool is_writing_ = false;
};

}  // namespace queries
