#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace queries {

// The checksum that each page of a database has in its last eight bytes, from version 4 on: docs/file_format.md,
// "Database files".

/// SQLite's reserved bytes at the end of each page, in which the checksum stands.
inline constexpr int kPageSumBytes = 8;
/// The first version whose pages have checksums.
inline constexpr std::uint32_t kFirstVersionWithPageSums = 4;
/// Bytes at the beginning of page 1 that describe the whole file.
inline constexpr std::size_t kFileHeaderBytes = 100;

/// Whether the last eight bytes of a page are the checksum of the others and of its number.
bool has_page_sum(std::span<const std::byte> page, std::uint32_t number);
/// Writes the checksum into the last eight bytes.
void set_page_sum(std::span<std::byte> page, std::uint32_t number);

/// What the header of a database file, at the beginning of page 1, says about its pages.
struct PageFormat {
  std::size_t page_bytes = 0;  ///< 0: no SQLite database
  std::uint32_t version = 0;   ///< of the tables: SQLite's user_version
  int reserved_bytes = 0;      ///< at the end of each page

  /// True if pages have checksums. Either sign of them is enough: if the two differ, page 1 fails its checksum.
  bool has_sums() const {
    return page_bytes > 0 && (reserved_bytes == kPageSumBytes || version >= kFirstVersionWithPageSums);
  }
  /// False if the header contradicts itself.
  bool is_consistent() const { return (reserved_bytes == kPageSumBytes) == (version >= kFirstVersionWithPageSums); }
};
/// `header`: at least kFileHeaderBytes.
PageFormat page_format(std::span<const std::byte> header);

}  // namespace queries
