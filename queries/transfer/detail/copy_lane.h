#pragma once

#include <memory>
#include <string>

#include "queries/transfer/detail/statement_lane.h"

namespace queries {

/// A connection that stores one batch of rows after the other, each in a transaction: COPY, then a statement beside it,
/// then COMMIT. It never waits: `advance` does what can be done now. Another lane may store the next batch meanwhile,
/// which is committed only when this one is.
class CopyLane {
 public:
  enum class State : std::uint8_t {
    free,        ///< ready for a batch
    storing,     ///< sends the rows, or waits for the server to have stored them
    stored,      ///< to be committed
    committing,  ///< waits for the end of the transaction
  };
  struct Batch {
    std::string rows;  ///< with beginning and end, as COPY takes them
    std::uint64_t row_count = 0;
    std::string record_sql;  ///< must change one row
  };

  explicit CopyLane(std::unique_ptr<ServerConnection> connection) : lane_(std::move(connection)) {}

  State state() const { return state_; }
  ServerConnection& connection() const { return lane_.connection(); }
  /// Requires `free`. The statements before COPY end with a semicolon, or are empty.
  Status store(Batch batch, const std::string& before_copy_sql, const std::string& copy_sql);
  /// Requires `stored`.
  Status commit();
  /// Errors: those of the server.
  Status advance();
  /// Whether the lane waits for room to send in; else for an answer.
  bool is_writing() const { return lane_.is_writing(); }

 private:
  StatementLane lane_;
  State state_ = State::free;
  std::string record_sql_;
};

}  // namespace queries
