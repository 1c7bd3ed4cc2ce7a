#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "queries/store/detail/sqlite_connection.h"

namespace queries {

/// A page of a stored spatial index, a row of the table index_pages: docs/file_format.md.
struct IndexPage {
  std::int64_t owner = 0;  ///< the object number of the index
  std::uint32_t number = 0;

  std::int64_t place() const { return owner << 32 | std::int64_t{number}; }
};

/// Maximum bytes of an index page: with them a row fills a page of SQLite and has no overflow pages.
inline constexpr std::size_t kIndexPageBytes = 4032;

/// Reads a page; nothing if there is none. Errors: database_corrupt if the bytes are not what was written.
algebra3d::Result<std::optional<std::string>> read_index_page(SqliteConnection& connection, const IndexPage& page);
/// Reads consecutive pages, whose first `page_bytes` bytes each are joined; fewer of the last one. Errors: as above,
/// and database_corrupt for a page that is not there or too short.
algebra3d::Status read_index_pages(SqliteConnection& connection, const IndexPage& first, std::size_t page_bytes,
                                   std::span<std::byte> bytes);
algebra3d::Status write_index_page(SqliteConnection& connection, const IndexPage& page, std::string_view bytes);
/// Erases the pages from `first` on that come before `last`.
algebra3d::Status erase_index_pages(SqliteConnection& connection, const IndexPage& first, const IndexPage& last);
/// Erases all pages of an index.
algebra3d::Status erase_index_pages(SqliteConnection& connection, std::int64_t owner);

}  // namespace queries
