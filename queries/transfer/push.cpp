#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/propagate.h"
#include "base/text.h"
#include "queries/store/store.h"
#include "queries/transfer/detail/copy_format.h"
#include "queries/transfer/detail/copy_lane.h"
#include "queries/transfer/detail/libpq.h"
#include "queries/transfer/detail/moved_columns.h"
#include "queries/transfer/detail/push_journal.h"
#include "queries/transfer/detail/pushed_tuples.h"
#include "queries/transfer/detail/transfer_report.h"
#include "queries/transfer/transfer.h"

namespace queries {
namespace {

class Push {
 public:
  Push(const TransferOptions& options, const TransferHost& host)
      : options_(options), host_(host), report_(host, options.quiet, "push") {}

  int run() {
    return reported(report_, host_, [&] { return transfer(); });
  }

 private:
  Status transfer();
  Status open_relation();
  Result<std::unique_ptr<ServerConnection>> connected();
  Status prepare_target(ServerConnection& connection);
  Status prepare_table(ServerConnection& connection);
  Status prepare_journal(ServerConnection& connection, PushJournal& journal);
  Status skip_pushed(const PushJournal& journal);
  Status send_all(const PushJournal& journal);
  Result<std::optional<CopyLane::Batch>> next_batch(const PushJournal& journal);
  Status start_batches(const PushJournal& journal);
  std::string before_copy_sql() const;
  Status end_batches();
  Status wait_for_lanes() const;
  Status stream(const PushJournal& journal);
  Status compare();

  const TransferOptions& options_;
  const TransferHost& host_;
  TransferReport report_;

  const Libpq* pq_ = nullptr;
  std::unique_ptr<Store> store_;
  RelationPtr relation_;
  TupleStreamPtr tuples_;
  TuplePtr next_tuple_;  // read ahead; null at the end
  std::int64_t tuple_count_ = 0;

  ServerTable table_;
  MovedColumns columns_;
  std::string copy_sql_;
  std::vector<std::unique_ptr<CopyLane>> lanes_;
  RowDigest at_start_;  // of the table

  PushJournal::Entry sent_;       // as of the last batch that was made
  PushJournal::Entry committed_;  // as of the last batch that was committed
  PushJournal::Entry begun_;      // as of the start of this push
  struct Running {
    CopyLane* lane;
    PushJournal::Entry after;
  };
  std::deque<Running> running_;  // in the order of batches
  std::uint64_t bytes_ = 0;
};

Status Push::transfer() {
  A3D_TRY(open_relation());
  A3D_ASSIGN(pq_, Libpq::load());
  A3D_ASSIGN(auto connection, connected());
  A3D_TRY(prepare_table(*connection));
  PushJournal journal(table_, options_.relation);
  A3D_TRY(connection->query("BEGIN"));
  A3D_TRY(prepare_journal(*connection, journal));
  A3D_TRY(connection->query("COMMIT"));
  report_.begin("the table " + table_.text(), journal.entry().digest.count, static_cast<std::uint64_t>(tuple_count_));
  lanes_.push_back(std::make_unique<CopyLane>(std::move(connection)));
  A3D_TRY(skip_pushed(journal));
  report_.set_resumable(true);
  A3D_TRY(stream(journal));
  report_.set_resumable(false);
  A3D_TRY(compare());
  report_.conclude("the relation " + options_.relation, committed_.digest);
  return {};
}

Status Push::open_relation() {
  A3D_ASSIGN(store_, Store::open(options_.database, OpenMode::read_only, host_.registry));
  store_->end_waiting_when(host_.cancel);
  A3D_TRY(store_->begin(false));
  A3D_ASSIGN(relation_, relation_to_push(*store_, options_));
  A3D_ASSIGN(tuple_count_, relation_->count());
  return {};
}

Result<std::unique_ptr<ServerConnection>> Push::connected() {
  return ServerConnection::open({*pq_, host_.cancel, [this](const std::string& text) { report_.note(text); }},
                                options_.server);
}

// The table itself is made with the journal, in one transaction.
Status Push::prepare_table(ServerConnection& connection) {
  A3D_TRY(check_server(connection));
  A3D_ASSIGN(const ExtensionTypes extension, find_extension_types(connection));
  A3D_ASSIGN(table_, find_table(connection, options_.table.empty() ? options_.relation : options_.table));
  if (table_.is_there && table_.kind != 'r' && table_.kind != 'p')
    return Error{ErrorCode::type_error, "{} is a view, a sequence or a foreign table; a push needs a table",
                 table_.text()};
  A3D_ASSIGN(columns_, columns_for(relation_->tuple_type(), table_, extension, connection.database(), host_.registry));
  copy_sql_ = fmt::format("COPY {} ({}) FROM STDIN (FORMAT binary)", table_.sql(), columns_.names_sql());
  return {};
}

Status Push::prepare_journal(ServerConnection& connection, PushJournal& journal) {
  if (!table_.is_there)
    A3D_TRY(connection.query(fmt::format("CREATE TABLE {} ({})", table_.sql(), columns_.definitions_sql())));
  if (options_.replaces && table_.is_there) A3D_TRY(connection.query("DELETE FROM " + table_.sql()));
  A3D_TRY(journal.open(connection));
  if (options_.replaces || !table_.is_there) A3D_TRY(journal.clear(connection));
  report_.work_at("reading the table");
  A3D_ASSIGN(at_start_, columns_.digest_of(connection, table_));
  if (at_start_.count == 0 && journal.all().count > 0) {
    report_.note(fmt::format("the table {} was emptied since the last push; all rows are sent", table_.text()));
    A3D_TRY(journal.clear(connection));
  }
  const RowDigest others = at_start_ - journal.all();
  if (at_start_.count < journal.all().count)
    return Error{ErrorCode::io_error,
                 "the table {} has {}, but {} were pushed into it: rows were deleted since; --replace deletes all and "
                 "begins anew",
                 table_.text(), algebra3d::counted(at_start_.count, "row"), journal.all().count};
  if (others.count > 0)
    report_.note(fmt::format("the table {} has {} that no push has put there; they stay", table_.text(),
                             algebra3d::counted(others.count, "row")));
  else if (others.checksum != 0)
    report_.note(fmt::format("rows of the table {} were changed since they were pushed; they stay so", table_.text()));
  begun_ = sent_ = committed_ = journal.entry();
  return {};
}

// The tuples that were sent before must be those that are here now: others would be missing on the server.
Status Push::skip_pushed(const PushJournal& journal) {
  A3D_ASSIGN(tuples_, relation_->scan());
  A3D_ASSIGN(const RowDigest digest,
             skip_pushed_tuples(*tuples_, next_tuple_, columns_, journal.entry().last_tuple,
                                [&] { report_.work_at("comparing the tuples that were pushed before"); }));
  if (digest == journal.entry().digest) return {};
  return Error{
      ErrorCode::io_error,
      "the first tuples of '{}' are not those that were pushed into {}: {}, but {} were pushed. The relation was "
      "changed since, or is that of another database; --replace deletes the rows of the table and begins anew",
      options_.relation,
      table_.text(),
      digest.text(),
      journal.entry().digest.text()};
}

Result<std::optional<CopyLane::Batch>> Push::next_batch(const PushJournal& journal) {
  if (next_tuple_ == nullptr) return std::optional<CopyLane::Batch>();
  const PushJournal::Entry before = sent_;
  const auto limit = static_cast<std::size_t>(options_.batch_megabytes * 1e6);
  CopyLane::Batch batch;
  batch.rows = copy_beginning();
  while (next_tuple_ != nullptr && (batch.row_count == 0 || batch.rows.size() < limit)) {
    algebra3d::poll_interruption();
    A3D_ASSIGN(const MovedColumns::Row row, columns_.row_of(*next_tuple_));
    append_copy_row(batch.rows, row.fields);
    ++batch.row_count;
    sent_ = {next_tuple_->id, sent_.digest + row.digest};
    A3D_ASSIGN(next_tuple_, tuples_->next());
  }
  bytes_ += batch.rows.size();
  batch.rows += copy_end();
  batch.record_sql = journal.update_sql(before, sent_);
  return std::optional(std::move(batch));
}

Status Push::start_batches(const PushJournal& journal) {
  for (const auto& lane : lanes_) {
    if (lane->state() != CopyLane::State::free) continue;
    A3D_ASSIGN(auto batch, next_batch(journal));
    if (!batch) return {};
    A3D_TRY(lane->store(*std::move(batch), before_copy_sql(), copy_sql_));
    running_.push_back({lane.get(), sent_});
  }
  return {};
}

// A batch that waits for a later one, whose rows have the same keys, would wait for ever.
std::string Push::before_copy_sql() const {
  return lanes_.size() > 1 ? "SET LOCAL lock_timeout = '3s'; " : "";
}

// Batches are committed in their order, so that one number says how far the relation has come.
Status Push::end_batches() {
  for (const auto& lane : lanes_) A3D_TRY(lane->advance());
  while (!running_.empty()) {
    const Running& first = running_.front();
    if (first.lane->state() == CopyLane::State::stored) A3D_TRY(first.lane->commit());
    if (first.lane->state() != CopyLane::State::free) break;
    committed_ = first.after;
    running_.pop_front();
  }
  report_.advance((committed_.digest - begun_.digest).count, (sent_.digest - committed_.digest).count, bytes_);
  return {};
}

Status Push::wait_for_lanes() const {
  std::vector<ServerConnection::Waiting> waiting;
  for (const Running& each : running_) {
    if (each.lane->state() == CopyLane::State::stored) continue;
    waiting.push_back({&each.lane->connection(), each.lane->is_writing()});
  }
  return ServerConnection::wait(waiting, host_.cancel);
}

Status Push::send_all(const PushJournal& journal) {
  while (true) {
    A3D_TRY(start_batches(journal));
    A3D_TRY(end_batches());
    const bool can_start = next_tuple_ != nullptr && std::ranges::any_of(lanes_, [](const auto& lane) {
                             return lane->state() == CopyLane::State::free;
                           });
    if (can_start) continue;
    if (running_.empty()) return {};
    A3D_TRY(wait_for_lanes());
  }
}

Status Push::stream(const PushJournal& journal) {
  while (next_tuple_ != nullptr && lanes_.size() < static_cast<std::size_t>(options_.connections)) {
    A3D_ASSIGN(auto connection, connected());
    lanes_.push_back(std::make_unique<CopyLane>(std::move(connection)));
  }
  Status status = algebra3d::as_interrupted([&] { return send_all(journal); });
  if (!status && status.error().code == ErrorCode::interrupted)
    for (const Running& each : running_) each.lane->connection().request_cancel();
  return status;
}

Status Push::compare() {
  report_.work_at("comparing checksums");
  A3D_ASSIGN(const RowDigest at_end, columns_.digest_of(lanes_.front()->connection(), table_));
  const RowDigest came = at_end - at_start_;
  const RowDigest sent = committed_.digest - begun_.digest;
  if (came == sent) return {};
  return Error{
      ErrorCode::io_error,
      "{} were sent, but the table {} differs from before by {}: another session, or a trigger of the table, has "
      "changed rows meanwhile",
      sent.text(), table_.text(), came.text()};
}

}  // namespace

int run_push(const TransferOptions& options, const TransferHost& host) {
  return Push(options, host).run();
}

}  // namespace queries
