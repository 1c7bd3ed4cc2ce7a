#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/values/types/value.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/text.h"
#include "queries/store/store.h"
#include "queries/transfer/detail/copy_format.h"
#include "queries/transfer/detail/libpq.h"
#include "queries/transfer/detail/moved_columns.h"
#include "queries/transfer/detail/push_journal.h"
#include "queries/transfer/detail/pushed_tuples.h"
#include "queries/transfer/detail/statement_lane.h"
#include "queries/transfer/detail/transfer_report.h"
#include "queries/transfer/transfer.h"

namespace queries {
namespace {

constexpr const char* kRepair =
    "SELECT * FROM algebra3d_shard_repair() at the coordinator takes back what was not completed";

/// Of a relation that is divided into tiles (docs/scaling.md).
struct DividedRelation {
  std::string relation;  ///< qualified and quoted, as the extension names it
  std::string schema, name, geometry;
};

/// The foreign server of a tile, and its table there.
struct TilePlace {
  std::string server, table;
};

/// A number as COPY sends it.
std::string sent_number(std::int64_t number, std::size_t size = sizeof(std::int64_t)) {
  std::string bytes;
  append_big_endian(bytes, static_cast<std::uint64_t>(number), size);
  return bytes;
}

/// The element of an array literal of rect3 for the box of a value.
std::string box_text(const Value& value) {
  if (!value.is_defined()) return "NULL";
  const algebra3d::Box3 box = value.header().box;
  if (box.is_empty()) return "NULL";
  return fmt::format("\"({} {} {} {} {} {})\"", box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z);
}

/// The numbers of an array literal without quotes.
std::vector<int> numbers_of(const std::string& array) {
  std::vector<int> numbers;
  for (std::size_t place = 1; place + 1 < array.size();) {
    const std::size_t end = std::min(array.find(',', place), array.size() - 1);
    numbers.push_back(std::stoi(array.substr(place, end - place)));
    place = end + 1;
  }
  return numbers;
}

class ShardedPush {
 public:
  ShardedPush(const TransferOptions& options, const TransferHost& host)
      : options_(options), host_(host), report_(host, options.quiet, "push") {}

  int run() {
    return reported(report_, host_, [&] { return transfer(); });
  }

 private:
  /// A tile that the present transaction writes.
  struct Tile {
    std::string server;
    std::int64_t generation = 0;
    std::string rows;  // as COPY takes them
    std::uint64_t row_count = 0;
  };
  using Tiles = std::map<int, Tile>;

  Status transfer();
  Status open_relation();
  Status find_relation();
  Status find_columns();
  Status connect_shards();
  Result<RowDigest> digest();
  Status prepare(PushJournal& journal);
  Status delete_all();
  Status skip_pushed(const PushJournal& journal);
  Status send_batch(const PushJournal& journal);
  Result<Tiles> claim(const std::string& tiles);
  Status begin_tiles(const Tiles& tiles);
  Status run_lanes();
  Status commit(const Tiles& tiles);
  Status compare();
  std::string tile_sql(int tile) const {
    return quoted_identifier(target_.schema) + "." + quoted_identifier(places_.at(tile).table);
  }
  std::string named(const std::string& name) const { return extension_.schema + ".algebra3d_shard_" + name; }

  const TransferOptions& options_;
  const TransferHost& host_;
  TransferReport report_;

  const Libpq* pq_ = nullptr;
  std::unique_ptr<Store> store_;
  RelationPtr source_;
  TupleStreamPtr tuples_;
  TuplePtr next_tuple_;       // read ahead; null at the end
  std::size_t geometry_ = 0;  // position of the attribute that divides

  std::unique_ptr<ServerConnection> coordinator_;
  ExtensionTypes extension_;
  DividedRelation target_;
  ServerTable table_;  // the view
  MovedColumns columns_;
  std::map<std::string, std::unique_ptr<StatementLane>> lanes_;  // by the name of the foreign server
  std::map<int, TilePlace> places_;
  RowDigest at_start_;
  PushJournal::Entry committed_, begun_;
  std::uint64_t bytes_ = 0;
};

Status ShardedPush::transfer() {
  A3D_TRY(open_relation());
  A3D_ASSIGN(pq_, Libpq::load());
  const ServerHost host{*pq_, host_.cancel, [this](const std::string& text) { report_.note(text); }};
  A3D_ASSIGN(coordinator_, ServerConnection::open(host, options_.server));
  A3D_TRY(check_server(*coordinator_));
  A3D_TRY(find_relation());
  A3D_TRY(find_columns());
  A3D_TRY(connect_shards());
  PushJournal journal(table_, options_.relation);
  A3D_TRY(prepare(journal));
  A3D_ASSIGN(const auto count, source_->count());
  report_.begin("the relation " + target_.relation, journal.entry().digest.count, static_cast<std::uint64_t>(count));
  A3D_TRY(skip_pushed(journal));
  report_.set_resumable(true);
  while (next_tuple_ != nullptr) A3D_TRY(algebra3d::as_interrupted([&] { return send_batch(journal); }));
  report_.set_resumable(false);
  A3D_TRY(compare());
  report_.conclude("the relation " + options_.relation, committed_.digest);
  return {};
}

Status ShardedPush::open_relation() {
  A3D_ASSIGN(store_, Store::open(options_.database, OpenMode::read_only, host_.registry));
  store_->end_waiting_when(host_.cancel);
  A3D_TRY(store_->begin(false));
  A3D_ASSIGN(source_, relation_to_push(*store_, options_));
  return {};
}

Status ShardedPush::find_relation() {
  A3D_ASSIGN(extension_, find_extension_types(*coordinator_));
  A3D_ASSIGN(const ServerAnswer installed,
             coordinator_->query("SELECT FROM pg_extension WHERE extname = 'algebra3d_shards'"));
  if (installed.row_count() == 0)
    return Error{ErrorCode::file_missing,
                 "the database '{}' has no extension algebra3d_shards, so no relation is divided among servers there; "
                 "without --shards a table is filled",
                 coordinator_->database()};
  const std::string name = options_.table.empty() ? options_.relation : options_.table;
  A3D_ASSIGN(const ServerAnswer known,
             coordinator_->query(
                 fmt::format("SELECT relation, schema_name, name, geometry FROM {}($1)", named("relation")), {name}));
  target_ = {known.text(0, 0), known.text(0, 1), known.text(0, 2), known.text(0, 3)};
  A3D_ASSIGN(table_,
             find_table(*coordinator_, quoted_identifier(target_.schema) + "." + quoted_identifier(target_.name)));
  return {};
}

Status ShardedPush::find_columns() {
  A3D_ASSIGN(columns_,
             columns_for(source_->tuple_type(), table_, extension_, coordinator_->database(), host_.registry));
  const auto found = std::ranges::find(columns_.all(), target_.geometry, &MovedColumn::column);
  if (found == columns_.all().end())
    return Error{ErrorCode::type_error,
                 "the relation '{}' has no attribute for the column {}, by which {} is divided into tiles",
                 options_.relation, target_.geometry, target_.relation};
  geometry_ = static_cast<std::size_t>(found - columns_.all().begin());
  return {};
}

Status ShardedPush::connect_shards() {
  A3D_ASSIGN(const ServerAnswer tiles,
             coordinator_->query(
                 fmt::format("SELECT t.tile, t.server, {}(r, t.tile) FROM {} t JOIN {} r USING (relation) WHERE "
                             "t.relation = $1 ORDER BY t.tile",
                             named("tile_name"), named("tiles"), named("relations")),
                 {target_.relation}));
  const ServerHost host{*pq_, host_.cancel, [this](const std::string& text) { report_.note(text); }};
  for (int row = 0; row < tiles.row_count(); ++row) {
    const std::string server = tiles.text(row, 1);
    places_[std::stoi(tiles.text(row, 0))] = {server, tiles.text(row, 2)};
    if (lanes_.contains(server)) continue;
    A3D_ASSIGN(const ServerAnswer conninfo,
               coordinator_->query(fmt::format("SELECT {}($1)", named("conninfo")), {server}));
    auto connection = ServerConnection::open(host, conninfo.text(0, 0));
    if (!connection) return std::move(connection).error().about(fmt::format("server {}", server));
    A3D_TRY(check_server(**connection));
    lanes_[server] = std::make_unique<StatementLane>(*std::move(connection));
  }
  return {};
}

// Of the rows, not of their copies.
Result<RowDigest> ShardedPush::digest() {
  RowDigest all;
  for (const auto& [tile, place] : places_) {
    ServerTable table;
    table.schema = target_.schema;
    table.name = place.table;
    A3D_ASSIGN(const RowDigest one,
               columns_.digest_of(lanes_.at(place.server)->connection(), table, "home AND died IS NULL"));
    all = all + one;
  }
  return all;
}

Status ShardedPush::prepare(PushJournal& journal) {
  A3D_TRY(coordinator_->query(fmt::format("SELECT {}($1)", named("ready")), {target_.relation}));
  A3D_TRY(coordinator_->query("BEGIN"));
  A3D_TRY(journal.open(*coordinator_));
  if (options_.replaces) {
    A3D_TRY(journal.clear(*coordinator_));
    A3D_TRY(delete_all());
  } else {
    A3D_TRY(coordinator_->query("COMMIT"));
  }
  report_.work_at("reading the relation on its servers");
  A3D_ASSIGN(at_start_, digest());
  const RowDigest others = at_start_ - journal.all();
  if (at_start_.count < journal.all().count)
    return Error{
        ErrorCode::io_error,
        "{} has {}, but {} were pushed into it: rows were deleted since; --replace deletes all and begins anew",
        target_.relation, algebra3d::counted(at_start_.count, "row"), journal.all().count};
  if (others.count > 0)
    report_.note(fmt::format("{} has {} that no push has put there; they stay", target_.relation,
                             algebra3d::counted(others.count, "row")));
  else if (others.checksum != 0)
    report_.note(fmt::format("rows of {} were changed since they were pushed; they stay so", target_.relation));
  begun_ = committed_ = journal.entry();
  return {};
}

Status ShardedPush::delete_all() {
  std::string all;
  for (const auto& each : places_) all += fmt::format("{}{}", all.empty() ? "{" : ",", each.first);
  A3D_ASSIGN(const Tiles tiles, claim(all + "}"));
  A3D_TRY(begin_tiles(tiles));
  for (const auto& [tile, writing] : tiles)
    A3D_TRY(lanes_.at(writing.server)
                ->add({fmt::format("UPDATE {} SET died = {} WHERE died IS NULL", tile_sql(tile), writing.generation)}));
  return commit(tiles);
}

// The tuples that were sent before must be those that are here now: others would be missing on the servers.
Status ShardedPush::skip_pushed(const PushJournal& journal) {
  A3D_ASSIGN(tuples_, source_->scan());
  A3D_ASSIGN(const RowDigest digest,
             skip_pushed_tuples(*tuples_, next_tuple_, columns_, journal.entry().last_tuple,
                                [&] { report_.work_at("comparing the tuples that were pushed before"); }));
  if (digest == journal.entry().digest) return {};
  return Error{ErrorCode::io_error,
               "the first tuples of '{}' are not those that were pushed into {}: {}, but {} were pushed. The relation "
               "was changed since, or is that of another database; --replace deletes all rows and begins anew",
               options_.relation,
               target_.relation,
               digest.text(),
               journal.entry().digest.text()};
}

// The coordinator's half of algebra3d_shard_begin, in its transaction.
Result<ShardedPush::Tiles> ShardedPush::claim(const std::string& tiles) {
  A3D_ASSIGN(const ServerAnswer claimed,
             coordinator_->query(fmt::format("SELECT tile, server, generation FROM {}($1, $2::integer[]) ORDER BY tile",
                                             named("claim")),
                                 {target_.relation, tiles}));
  Tiles made;
  for (int row = 0; row < claimed.row_count(); ++row) {
    const int tile = std::stoi(claimed.text(row, 0));
    Tile& writing = made[tile];
    writing.server = claimed.text(row, 1);
    writing.generation = std::stoll(claimed.text(row, 2));
    writing.rows = copy_beginning();
    if (places_.at(tile).server != writing.server)
      return Error{ErrorCode::database_busy, "tile {} of {} was moved to server {} meanwhile", tile, target_.relation,
                   writing.server};
  }
  return made;
}

// The other half, on each server in a transaction of its own.
Status ShardedPush::begin_tiles(const Tiles& tiles) {
  for (const auto& [number, writing] : tiles) {
    StatementLane& lane = *lanes_.at(writing.server);
    if (lane.is_idle()) A3D_TRY(lane.add({"BEGIN"}));
    const auto differs = [this, number = number, writing_to = writing.server,
                          before = writing.generation - 1](const std::string&) {
      return Error{ErrorCode::io_error,
                   "tile {} of {} is not at generation {} on server {}: {}",
                   number,
                   target_.relation,
                   before,
                   writing_to,
                   kRepair};
    };
    A3D_TRY(lane.add({fmt::format("UPDATE {} SET generation = {} WHERE relation = {} AND tile = {} AND generation = {}",
                                  named("generations"), writing.generation, quoted_literal(target_.relation), number,
                                  writing.generation - 1),
                      {},
                      1,
                      differs}));
    A3D_TRY(lane.add({fmt::format("DELETE FROM {} WHERE died IS NOT NULL", tile_sql(number))}));
  }
  return {};
}

Status ShardedPush::run_lanes() {
  while (true) {
    std::vector<ServerConnection::Waiting> waiting;
    for (const auto& each : lanes_) {
      A3D_TRY(each.second->advance());
      if (!each.second->is_idle()) waiting.push_back({&each.second->connection(), each.second->is_writing()});
    }
    if (waiting.empty()) return {};
    Status waited = ServerConnection::wait(waiting, host_.cancel);
    if (waited) continue;
    for (const auto& each : waiting) each.connection->request_cancel();
    return waited;
  }
}

// The servers commit first, and the coordinator last: what it has committed holds. Who begins to read meanwhile waits.
Status ShardedPush::commit(const Tiles& tiles) {
  A3D_TRY(run_lanes());
  A3D_TRY(coordinator_->query(fmt::format("SELECT {}()", named("lock_commits"))));
  for (const auto& each : tiles) {
    StatementLane& lane = *lanes_.at(each.second.server);
    if (lane.is_idle()) A3D_TRY(lane.add({"COMMIT"}));
  }
  Status status = run_lanes();
  if (status) {
    auto committed = coordinator_->query("COMMIT");
    if (!committed) status = std::move(committed).error();
  }
  if (status || status.error().code == ErrorCode::interrupted) return status;
  return std::move(status).error().about(fmt::format("while servers committed ({})", kRepair));
}

Status ShardedPush::send_batch(const PushJournal& journal) {
  const auto limit = static_cast<std::size_t>(options_.batch_megabytes * 1e6);
  std::vector<MovedColumns::Row> rows;
  std::string boxes;
  PushJournal::Entry after = committed_;
  for (std::size_t bytes = 0; next_tuple_ != nullptr && (rows.empty() || bytes < limit);) {
    algebra3d::poll_interruption();
    A3D_ASSIGN(MovedColumns::Row row, columns_.row_of(*next_tuple_));
    for (const auto& field : row.fields) bytes += field ? field->size() : 0;
    boxes += (boxes.empty() ? "{" : ",") + box_text(next_tuple_->attributes[geometry_]);
    after = {next_tuple_->id, after.digest + row.digest};
    rows.push_back(std::move(row));
    A3D_ASSIGN(next_tuple_, tuples_->next());
  }
  A3D_TRY(coordinator_->query("BEGIN"));
  A3D_ASSIGN(const ServerAnswer places,
             coordinator_->query(fmt::format("SELECT row_id, tiles, home FROM {}($1, $2::{}[])", named("places"),
                                             extension_.by_name.at("rect3")),
                                 {target_.relation, boxes + "}"}));
  A3D_ASSIGN(const ServerAnswer number,
             coordinator_->query("SELECT nextval($1::regclass)", {quoted_identifier(target_.schema) + "." +
                                                                  quoted_identifier(target_.name + "_row_id")}));
  std::string met = "{";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string tiles = places.text(static_cast<int>(i), 1);
    met += (met.size() > 1 ? "," : "") + tiles.substr(1, tiles.size() - 2);
  }
  A3D_ASSIGN(Tiles tiles, claim(met + "}"));
  A3D_ASSIGN(const ServerAnswer recorded, coordinator_->query(journal.update_sql(committed_, after)));
  if (recorded.affected() != "1")
    return Error{ErrorCode::database_busy, "another push of the same relation into {} is at work", target_.relation};
  A3D_TRY(begin_tiles(tiles));

  const std::string stamp = sent_number(std::stoll(number.text(0, 0)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int place = static_cast<int>(i), home = std::stoi(places.text(place, 2));
    auto& fields = rows[i].fields;
    const std::size_t own = fields.size();
    for (const int number_of_tile : numbers_of(places.text(place, 1))) {
      Tile& tile = tiles.at(number_of_tile);
      fields.resize(own);
      fields.emplace_back(sent_number(std::stoll(places.text(place, 0))));
      fields.emplace_back(sent_number(number_of_tile, sizeof(std::int32_t)));
      fields.emplace_back(std::string(1, number_of_tile == home ? '\1' : '\0'));
      fields.emplace_back(sent_number(tile.generation));
      fields.emplace_back(stamp);
      const std::size_t before = tile.rows.size();
      append_copy_row(tile.rows, fields);
      bytes_ += tile.rows.size() - before;
      ++tile.row_count;
    }
    rows[i] = {};
  }
  for (auto& [tile_number, tile] : tiles) {
    tile.rows += copy_end();
    const auto taken = [expected = tile.row_count](const std::string& affected) {
      return Error{ErrorCode::io_error, "the server has stored {} of {} rows", affected, expected};
    };
    A3D_TRY(lanes_.at(tile.server)
                ->add({fmt::format("COPY {} ({}, row_id, tile, home, born, stamp) FROM STDIN (FORMAT binary)",
                                   tile_sql(tile_number), columns_.names_sql()),
                       std::move(tile.rows), tile.row_count, taken}));
  }
  A3D_TRY(commit(tiles));
  committed_ = after;
  report_.advance((committed_.digest - begun_.digest).count, 0, bytes_);
  return {};
}

Status ShardedPush::compare() {
  report_.work_at("comparing checksums");
  // Without statistics a server does not know that sending its count is cheaper than sending its rows.
  for (const auto& [tile, place] : places_) A3D_TRY(lanes_.at(place.server)->add({"ANALYZE " + tile_sql(tile)}));
  A3D_TRY(run_lanes());
  A3D_ASSIGN(const RowDigest at_end, digest());
  const RowDigest came = at_end - at_start_;
  const RowDigest sent = committed_.digest - begun_.digest;
  if (came == sent) return {};
  return Error{ErrorCode::io_error,
               "{} were sent, but {} differs from before by {}: another session has changed rows meanwhile",
               sent.text(), target_.relation, came.text()};
}

}  // namespace

int run_push_into_shards(const TransferOptions& options, const TransferHost& host) {
  return ShardedPush(options, host).run();
}

}  // namespace queries
