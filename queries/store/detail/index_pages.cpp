#include "queries/store/detail/index_pages.h"

#include <algorithm>
#include <cstring>

#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

Error damaged_page(const SqliteConnection& connection, std::int64_t place) {
  return Error{ErrorCode::database_corrupt, "page {} of the spatial index {} is not what was written",
               place & 0xffffffff, place >> 32}
      .about(connection.file());
}

// Bytes that were written elsewhere have another checksum.
std::int64_t page_checksum(std::int64_t place, std::string_view bytes) {
  return as_signed(checksum_of(bytes, as_unsigned(place)));
}

bool is_sound(std::int64_t place, const Cell& checksum, const Cell& bytes) {
  return checksum.is(Cell::Kind::integer) && bytes.is(Cell::Kind::blob) &&
         checksum.integer == page_checksum(place, bytes.bytes);
}

}  // namespace

Result<std::optional<std::string>> read_index_page(SqliteConnection& connection, const IndexPage& page) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("SELECT checksum, bytes FROM index_pages WHERE place = ?"));
  statement.bind(1, page.place());
  A3D_ASSIGN(const bool has_row, statement.step());
  if (!has_row) return std::optional<std::string>();
  const Cell bytes = statement.column(1);
  if (!is_sound(page.place(), statement.column(0), bytes)) return damaged_page(connection, page.place());
  return std::optional(std::string(bytes.bytes));
}

Status read_index_pages(SqliteConnection& connection, const IndexPage& first, std::size_t page_bytes,
                        std::span<std::byte> bytes) {
  const auto count = static_cast<std::int64_t>((bytes.size() + page_bytes - 1) / page_bytes);
  A3D_ASSIGN(
      SqliteStatement statement,
      connection.use("SELECT place, checksum, bytes FROM index_pages WHERE place >= ? AND place < ? ORDER BY place"));
  const std::int64_t begin = first.place();
  statement.bind(1, begin).bind(2, begin + count);
  for (std::int64_t place = begin; place < begin + count; ++place) {
    const std::size_t wanted = std::min(page_bytes, bytes.size());
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row || statement.column(0).integer != place) return damaged_page(connection, place);
    const Cell page = statement.column(2);
    if (!is_sound(place, statement.column(1), page) || page.bytes.size() < wanted)
      return damaged_page(connection, place);
    std::memcpy(bytes.data(), page.bytes.data(), wanted);
    bytes = bytes.subspan(wanted);
  }
  return {};
}

Status write_index_page(SqliteConnection& connection, const IndexPage& page, std::string_view bytes) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("INSERT OR REPLACE INTO index_pages VALUES(?, ?, ?)"));
  statement.bind(1, page.place()).bind(2, page_checksum(page.place(), bytes));
  return statement.bind(3, Cell::blob(bytes)).run();
}

Status erase_index_pages(SqliteConnection& connection, std::int64_t owner) {
  return erase_index_pages(connection, {owner, 0}, {owner + 1, 0});
}

Status erase_index_pages(SqliteConnection& connection, const IndexPage& first, const IndexPage& last) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("DELETE FROM index_pages WHERE place >= ? AND place < ?"));
  return statement.bind(1, first.place()).bind(2, last.place()).run();
}

}  // namespace queries
