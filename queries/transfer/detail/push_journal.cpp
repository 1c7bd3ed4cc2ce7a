#include "queries/transfer/detail/push_journal.h"

#include <fmt/format.h>

#include "base/propagate.h"

namespace queries {
namespace {

// Checksums stand in SQL as two's complement.
std::int64_t signed_sum(std::uint64_t checksum) {
  return static_cast<std::int64_t>(checksum);
}

}  // namespace

PushJournal::PushJournal(const ServerTable& target, std::string relation)
    : target_(target.name), relation_(std::move(relation)) {
  journal_.schema = target.schema;
  journal_.name = "algebra3d_transfers";
}

std::string PushJournal::condition() const {
  return fmt::format("table_name = {} AND relation = {}", quoted_literal(target_), quoted_literal(relation_));
}

Status PushJournal::open(ServerConnection& connection) {
  A3D_ASSIGN(const ServerAnswer found, connection.query("SELECT to_regclass($1) IS NULL", {journal_.sql()}));
  if (found.is_true(0, 0))
    A3D_TRY(connection.query(fmt::format(
        "CREATE TABLE {} (table_name text, relation text, last_tuple bigint NOT NULL, row_count bigint NOT NULL, "
        "checksum bigint NOT NULL, changed timestamptz NOT NULL DEFAULT now(), PRIMARY KEY (table_name, relation))",
        journal_.sql())));
  A3D_TRY(connection.query(fmt::format("INSERT INTO {} VALUES ({}, {}, 0, 0, 0) ON CONFLICT DO NOTHING", journal_.sql(),
                                       quoted_literal(target_), quoted_literal(relation_))));
  A3D_ASSIGN(const ServerAnswer own,
             connection.query(fmt::format("SELECT last_tuple, row_count, checksum FROM {} WHERE {} FOR UPDATE",
                                          journal_.sql(), condition())));
  if (own.row_count() != 1) return Error{ErrorCode::io_error, "the row of the push in {} is hidden", journal_.text()};
  entry_.last_tuple = std::stoll(own.text(0, 0));
  entry_.digest = row_digest_of_texts(own.text(0, 1), own.text(0, 2));
  A3D_ASSIGN(
      const ServerAnswer sums,
      connection.query(fmt::format("SELECT coalesce(sum(row_count), 0), coalesce(sum(checksum), 0) FROM {} WHERE "
                                   "table_name = {}",
                                   journal_.sql(), quoted_literal(target_))));
  all_ = row_digest_of_texts(sums.text(0, 0), sums.text(0, 1));
  return {};
}

Status PushJournal::clear(ServerConnection& connection) {
  A3D_TRY(connection.query(
      fmt::format("UPDATE {} SET last_tuple = 0, row_count = 0, checksum = 0, changed = now() WHERE table_name = {}",
                  journal_.sql(), quoted_literal(target_))));
  entry_ = {};
  all_ = {};
  return {};
}

std::string PushJournal::update_sql(const Entry& before, const Entry& after) const {
  return fmt::format(
      "UPDATE {} SET last_tuple = {}, row_count = {}, checksum = {}, changed = now() WHERE {} AND last_tuple = {} AND "
      "row_count = {}",
      journal_.sql(), after.last_tuple, after.digest.count, signed_sum(after.digest.checksum), condition(),
      before.last_tuple, before.digest.count);
}

}  // namespace queries
