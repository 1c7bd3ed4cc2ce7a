#pragma once

#include <string>

#include "queries/transfer/detail/row_digest.h"
#include "queries/transfer/detail/server_connection.h"
#include "queries/transfer/detail/server_table.h"

namespace queries {

/// What the table algebra3d_transfers on the server, in the schema of the target, says of pushes into the target: for
/// each relation the last tuple that was sent, and count and checksum of all of them.
class PushJournal {
 public:
  struct Entry {
    std::int64_t last_tuple = 0;
    RowDigest digest;
  };

  PushJournal(const ServerTable& target, std::string relation);

  /// Makes the table unless it is there, and reads it; other pushes of the relation wait until the transaction ends.
  /// Call in a transaction.
  Status open(ServerConnection& connection);
  /// Forgets all relations that were pushed into the target. Call in the same transaction.
  Status clear(ServerConnection& connection);

  /// That of the relation.
  const Entry& entry() const { return entry_; }
  /// All rows that pushes have put into the target.
  const RowDigest& all() const { return all_; }

  /// The statement that replaces one entry by another; it changes no row if another process has been there.
  std::string update_sql(const Entry& before, const Entry& after) const;

 private:
  std::string condition() const;

  ServerTable journal_;
  std::string target_, relation_;
  Entry entry_;
  RowDigest all_;
};

}  // namespace queries
