#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/diagnostics.h"
#include "base/memory_limit.h"
#include "base/propagate.h"
#include "base/scheduler.h"
#include "base/text.h"
#include "queries/language/parser.h"
#include "queries/store/store.h"
#include "queries/streams/tuple_buffer.h"
#include "queries/transfer/detail/copy_format.h"
#include "queries/transfer/detail/libpq.h"
#include "queries/transfer/detail/moved_columns.h"
#include "queries/transfer/detail/transfer_report.h"
#include "queries/transfer/transfer.h"

namespace queries {
namespace {

/// Before the first row of every table.
constexpr const char* kFirstPlace = "(0,0)";

/// The place of a row in its table, from the bytes of COPY: a block and a position in it.
struct RowPlace {
  std::uint64_t block = 0, position = 0;

  static Result<RowPlace> of(std::optional<std::string_view> bytes);
  std::string text() const { return fmt::format("({},{})", block, position); }
  friend auto operator<=>(const RowPlace&, const RowPlace&) = default;
};

Result<RowPlace> RowPlace::of(std::optional<std::string_view> bytes) {
  constexpr std::size_t kBlockBytes = 4, kBytes = 6;
  if (!bytes || bytes->size() != kBytes)
    return Error{ErrorCode::database_corrupt, "the server sends a row without its place"};
  return RowPlace{big_endian(bytes->substr(0, kBlockBytes)), big_endian(bytes->substr(kBlockBytes))};
}

/// A row as it came.
struct ReceivedRow {
  ServerConnection::Copied message;
  CopyReader::Fields fields;  // in the message; the first is the place
  RowPlace place;
};

/// A row that was proved.
struct ProvedRow {
  Tuple tuple;
  RowDigest digest;
  Status status;
};

class Pull {
 public:
  Pull(const TransferOptions& options, const TransferHost& host)
      : options_(options), host_(host), report_(host, options.quiet, "pull") {}

  int run() {
    return reported(report_, host_, [&] { return transfer(); });
  }

 private:
  Status transfer();
  Status open_table();
  Status open_relation(const ExtensionTypes& extension);
  Status empty_relation(const TypeExpr& type);
  Status read_journal();
  Status check_relation();
  Status check_place();
  Status start_copy();
  Status copy_rows();
  Result<std::vector<ReceivedRow>> next_rows();
  ProvedRow proved(const ReceivedRow& row) const;
  Status store_rows(const std::vector<ReceivedRow>& rows);
  Status end_copy();
  Status compare();
  Result<RowDigest> relation_digest();

  const TransferOptions& options_;
  const TransferHost& host_;
  TransferReport report_;

  std::unique_ptr<ServerConnection> connection_;
  ServerTable table_;
  ExtensionTypes extension_;
  std::unique_ptr<Store> store_;
  std::string relation_;
  MovedColumns columns_;

  std::optional<CopyReader> reader_;
  bool is_at_end_ = false;
  RowPlace last_place_;
  Store::PulledTable journal_;
  RowDigest all_pulled_;  // into the relation, also from other tables
  RowDigest begun_;       // of the table, as of the start of this pull
  RowDigest pulled_;      // of the table
  RowDigest at_start_;    // of the relation
  std::uint64_t bytes_ = 0;
};

Status Pull::transfer() {
  if (!options_.relation.empty()) A3D_TRY(check_object_name(options_.relation, "a relation"));
  A3D_ASSIGN(const Libpq* const pq, Libpq::load());
  A3D_ASSIGN(connection_,
             ServerConnection::open({*pq, host_.cancel, [this](const std::string& text) { report_.note(text); }},
                                    options_.server));
  A3D_TRY(open_table());
  A3D_ASSIGN(const ServerAnswer count, connection_->query("SELECT count(*) FROM ONLY " + table_.sql()));
  A3D_TRY(open_relation(extension_));
  A3D_TRY(read_journal());
  A3D_TRY(check_relation());
  report_.begin("the relation '" + relation_ + "'", journal_.count, std::stoull(count.text(0, 0)));
  A3D_TRY(check_place());
  A3D_TRY(start_copy());
  report_.set_resumable(true);
  A3D_TRY(copy_rows());
  A3D_TRY(end_copy());
  report_.set_resumable(false);
  A3D_TRY(compare());
  report_.conclude("the table " + table_.text(), pulled_);
  return {};
}

// All that is read of the table is of one moment.
Status Pull::open_table() {
  A3D_TRY(check_server(*connection_));
  A3D_TRY(connection_->query("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY; SET LOCAL synchronize_seqscans = off"));
  A3D_ASSIGN(extension_, find_extension_types(*connection_));
  A3D_ASSIGN(table_, find_table(*connection_, options_.table));
  if (!table_.is_there)
    return Error{ErrorCode::unknown_name, "there is no table {} in the database '{}'", table_.text(),
                 connection_->database()};
  if (table_.kind != 'r' && table_.kind != 'm')
    return Error{ErrorCode::type_error,
                 "{} is neither a table nor a materialized view, whose rows have places: make one of it, or pull the "
                 "partitions",
                 table_.text()};
  if (table_.has_children)
    return Error{ErrorCode::type_error,
                 "the table {} has tables that inherit from it: pull them one by one, or make a "
                 "materialized view",
                 table_.text()};
  return {};
}

Status Pull::open_relation(const ExtensionTypes& extension) {
  relation_ = options_.relation.empty() ? attribute_name(table_.name) : options_.relation;
  A3D_TRY(check_object_name(relation_, "a relation (see --relation)"));
  A3D_ASSIGN(const TypeExpr made_type, tuple_type_for(table_));
  A3D_ASSIGN(store_, Store::open(options_.database, OpenMode::open_or_create, host_.registry));
  if (!store_->opening_notice().empty()) report_.note(store_->opening_notice());
  store_->end_waiting_when(host_.cancel);
  A3D_ASSIGN(const auto found, store_->find(relation_));
  if (found && !found->type.is_relation())
    return Error{ErrorCode::type_error, "'{}' is of type {}, expected a relation", relation_, found->type.text()};
  const TypeExpr type = found ? found->type : TypeExpr::rel(made_type);
  A3D_ASSIGN(columns_,
             attributes_for(table_, type.element(), relation_, extension, connection_->database(), host_.registry));
  if (found && found->has_value && !options_.replaces) return {};
  A3D_TRY(store_->begin(true));
  if (!found) A3D_TRY(store_->create(relation_, type));
  A3D_TRY(empty_relation(type));
  return store_->commit();
}

Status Pull::empty_relation(const TypeExpr& type) {
  algebra3d::Diagnostics diagnostics;
  const algebra3d::Context context{.diagnostics = diagnostics, .folder = {}};
  const auto empty = std::make_shared<MemoryRelation>(type.element(), TupleBuffer(std::vector<TuplePtr>()));
  A3D_TRY(store_->assign(relation_, Datum{std::shared_ptr<Relation>(empty)}, context));
  return store_->forget_pulled(relation_);
}

Status Pull::read_journal() {
  journal_ = {.source = connection_->database() + "." + table_.text(), .place = kFirstPlace};
  A3D_ASSIGN(const auto tables, store_->pulled_tables(relation_));
  for (const Store::PulledTable& each : tables) {
    all_pulled_ = all_pulled_ + RowDigest{each.count, each.checksum};
    if (each.source == journal_.source) journal_ = each;
  }
  return {};
}

Result<RowDigest> Pull::relation_digest() {
  A3D_TRY(store_->begin(false));
  A3D_ASSIGN(const Datum datum, store_->read(relation_));
  A3D_ASSIGN(const RowDigest digest, columns_.digest_of(*datum.relation(), host_.cancel));
  store_->rollback();
  return digest;
}

Status Pull::check_relation() {
  report_.work_at("reading the relation");
  A3D_ASSIGN(at_start_, relation_digest());
  if (at_start_.count == 0 && all_pulled_.count > 0) {
    report_.note(fmt::format("the relation '{}' was emptied since the last pull; all rows are copied", relation_));
    A3D_TRY(store_->begin(true));
    A3D_TRY(store_->forget_pulled(relation_));
    A3D_TRY(store_->commit());
    journal_ = {.source = journal_.source, .place = kFirstPlace};
    all_pulled_ = {};
  }
  const RowDigest others = at_start_ - all_pulled_;
  if (at_start_.count < all_pulled_.count)
    return Error{
        ErrorCode::io_error,
        "the relation '{}' has {}, but {} were pulled into it: tuples were deleted since; --replace empties it and "
        "begins anew",
        relation_, algebra3d::counted(at_start_.count, "tuple"), all_pulled_.count};
  if (others.count > 0)
    report_.note(fmt::format("the relation '{}' has {} that no pull has put there; they stay", relation_,
                             algebra3d::counted(others.count, "tuple")));
  else if (others.checksum != 0)
    report_.note(fmt::format("tuples of '{}' were changed since they were pulled; they stay so", relation_));
  begun_ = pulled_ = {journal_.count, journal_.checksum};
  return {};
}

// The rows up to the last one that was pulled must be those that are there now: others would be missing here.
Status Pull::check_place() {
  if (journal_.count == 0) return {};
  report_.work_at("comparing the rows that were pulled before");
  A3D_ASSIGN(const RowDigest digest,
             columns_.digest_of(*connection_, table_, fmt::format("ctid <= '{}'::tid", journal_.place)));
  if (digest == begun_) return {};
  return Error{
      ErrorCode::io_error,
      "the rows of {} up to {} are not those that were pulled into '{}': {}, but {} were pulled. The table was "
      "changed since, or is that of another server; --replace empties the relation and begins anew",
      table_.text(),
      journal_.place,
      relation_,
      digest.text(),
      begun_.text()};
}

Status Pull::start_copy() {
  A3D_TRY(
      connection_->send(fmt::format("COPY (SELECT ctid, {} FROM ONLY {} WHERE ctid > '{}'::tid) TO STDOUT (FORMAT "
                                    "binary)",
                                    columns_.sent_sql(), table_.sql(), journal_.place)));
  A3D_ASSIGN(const auto answer, connection_->next_answer());
  if (!answer) return connection_->lost();
  A3D_TRY(answer->check());
  reader_.emplace(columns_.size() + 1);
  return {};
}

// What a batch holds: as much as is proved at once, on all processors.
Result<std::vector<ReceivedRow>> Pull::next_rows() {
  const double limit = std::min(options_.batch_megabytes * 1e6, static_cast<double>(algebra3d::memory_left()) / 16);
  std::vector<ReceivedRow> rows;
  for (double bytes = 0; rows.empty() || bytes < limit;) {
    A3D_ASSIGN(auto message, connection_->next_copied());
    if (!message) {
      is_at_end_ = true;
      break;
    }
    A3D_ASSIGN(const CopyReader::Fields* const fields, reader_->take(message->view()));
    if (fields == nullptr) continue;
    A3D_ASSIGN(const RowPlace place, RowPlace::of(fields->front()));
    if (place <= last_place_)
      return Error{ErrorCode::internal, "the server sends the row at {} behind that at {}", place.text(),
                   last_place_.text()};
    last_place_ = place;
    bytes += static_cast<double>(message->size);
    rows.push_back({*std::move(message), *fields, place});
  }
  return rows;
}

ProvedRow Pull::proved(const ReceivedRow& row) const {
  ProvedRow result;
  std::vector<Sha256> hashes(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const MovedColumn& column = columns_.all()[i];
    const auto& field = row.fields[i + 1];
    if (!field) {
      result.tuple.attributes.emplace_back(*column.type.type);
      continue;
    }
    auto value = received_value(column.type, *field);
    auto hashed = value ? hashed_bytes(column.type, *value, *field) : Result<std::string>(value.error());
    if (!hashed) {
      result.status =
          std::move(hashed).error().about(fmt::format("the row at {}: column {}", row.place.text(), column.column));
      return result;
    }
    hashes[i] = sha256(*hashed);
    result.tuple.attributes.push_back(*std::move(value));
  }
  result.digest = row_digest(hashes);
  return result;
}

Status Pull::store_rows(const std::vector<ReceivedRow>& rows) {
  std::vector<ProvedRow> ready(rows.size());
  algebra3d::parallel_for(rows.size(), 2, [&](std::size_t i) { ready[i] = proved(rows[i]); });
  A3D_TRY(store_->begin(true));
  A3D_ASSIGN(const Datum datum, store_->read(relation_));
  RowDigest digest = pulled_;
  for (ProvedRow& row : ready) {
    if (!row.status) return row.status;
    A3D_TRY(datum.relation()->insert(row.tuple));
    digest = digest + row.digest;
  }
  journal_.place = rows.back().place.text();
  journal_.count = digest.count;
  journal_.checksum = digest.checksum;
  A3D_TRY(store_->remember_pulled(relation_, journal_));
  A3D_TRY(store_->commit());
  pulled_ = digest;
  return {};
}

Status Pull::copy_rows() {
  while (!is_at_end_) {
    A3D_ASSIGN(const auto rows, next_rows());
    if (rows.empty()) break;
    for (const ReceivedRow& row : rows) bytes_ += row.message.size;
    report_.advance((pulled_ - begun_).count, rows.size(), bytes_);
    A3D_TRY(store_rows(rows));
    report_.advance((pulled_ - begun_).count, 0, bytes_);
  }
  return {};
}

Status Pull::end_copy() {
  std::string count;
  while (true) {
    A3D_ASSIGN(const auto answer, connection_->next_answer());
    if (!answer) break;
    A3D_TRY(answer->check());
    count = answer->affected();
  }
  const std::uint64_t came = (pulled_ - begun_).count;
  if (count != std::to_string(came))
    return Error{ErrorCode::io_error, "{} came, but the server has sent {}", algebra3d::counted(came, "row"), count};
  return {};
}

Status Pull::compare() {
  report_.work_at("comparing checksums");
  A3D_ASSIGN(const RowDigest there, columns_.digest_of(*connection_, table_));
  if (!(there == pulled_))
    return Error{ErrorCode::io_error, "the table {} has {}, but {} were pulled", table_.text(), there.text(),
                 pulled_.text()};
  A3D_ASSIGN(const RowDigest here, relation_digest());
  if (here - at_start_ == pulled_ - begun_) return {};
  return Error{
      ErrorCode::io_error,
      "{} were pulled, but the relation '{}' differs from before by {}: another program has changed it meanwhile",
      (pulled_ - begun_).text(), relation_, (here - at_start_).text()};
}

}  // namespace

int run_pull(const TransferOptions& options, const TransferHost& host) {
  return Pull(options, host).run();
}

}  // namespace queries
