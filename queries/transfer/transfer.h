#pragma once

#include <atomic>
#include <ostream>

#include "algebra3d/operators/registry/registry.h"
#include "queries/transfer/transfer_options.h"

namespace queries {

/// The environment of a transfer. Everything that it refers to outlives the transfer.
struct TransferHost {
  const algebra3d::Registry& registry;
  std::ostream& out;  ///< receives the summary
  std::ostream& err;  ///< receives progress, notes and errors
  bool err_is_terminal = false;
  /// If set, the transfer ends; complete batches are committed.
  const std::atomic<bool>* cancel = nullptr;
};

/// Copies a relation into a table of a server, by COPY in binary format over several connections. A batch of tuples is
/// one transaction, which also records in the table algebra3d_transfers how far the relation has come; batches are
/// committed in the order of tuples. So a repeated push goes on where the last one ended, once it has found the tuples
/// that were sent before unchanged, and no tuple is stored twice.
///
/// Returns the exit status: 0 all tuples are in the table, and count and checksum of the rows that came into the table
/// are those of the tuples; 1 the push failed; 2 wrong usage; 130 interrupted. Never throws.
int run_push(const TransferOptions& options, const TransferHost& host);

/// Copies a relation into one that is divided among several servers (docs/scaling.md), straight into their tables; the
/// server of the options is the coordinator. A batch of tuples is one transaction over all of them, one batch after the
/// other; the coordinator, which has algebra3d_transfers, commits last. What was committed only by some of them
/// algebra3d_shard_repair() takes back: a push that meets it ends with an error that says so.
///
/// Returns the exit status like run_push.
int run_push_into_shards(const TransferOptions& options, const TransferHost& host);

/// Copies a table of a server into a relation, in the order of rows in the table, as the table was at one moment. A
/// batch of rows is one transaction, which also records the place of the last row. A repeated pull goes on behind it,
/// once the server has found the rows up to there to be those that were pulled. Values are proved to be valid.
///
/// Returns the exit status like run_push.
int run_pull(const TransferOptions& options, const TransferHost& host);

/// With standard output and standard error.
int run_push(const TransferOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel);
int run_pull(const TransferOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel);

}  // namespace queries
