#pragma once

#include <cstdint>
#include <memory>

#include "base/work_memory.h"
#include "queries/store/store.h"

namespace queries {

/// Limits of a store. Tests lower the defaults.
struct StoreOptions {
  /// Maximum bytes of encoded values in a row; further values are stored in chunks in another table. A quarter of a
  /// page: so a scan of numbers and boxes reads few pages, and writing a row again does not write its geometry again.
  std::uint64_t inline_bytes = 1024;
  /// Maximum bytes of a chunk, and of the value of an object that is not a relation in one row. SQLite's own limit is
  /// 10^9 bytes per row.
  std::uint64_t chunk_bytes = std::uint64_t{64} << 20;
  /// Maximum tuples of a row group; 0: none are made.
  std::size_t group_rows = 4096;
  /// The least tuples that become a row group; fewer stand in the table of their relation.
  std::size_t least_group_rows = 256;
  /// As many tuples of a relation may stand beside its row groups when a statement ends; of more, row groups are made.
  std::size_t loose_rows = 4096;
  /// Maximum bytes of a row group, unless a single tuple has more.
  std::size_t group_bytes = std::size_t{4} << 20;
  /// Size of the cache of loaded geometry, in estimated bytes: a twelfth of the default memory limit; less where little
  /// memory is left.
  std::uint64_t cache_bytes = algebra3d::WorkMemory::default_limit() / 12;
  /// Size of SQLite's page cache. Changes beyond it are written before their statement ends.
  int page_cache_kilobytes = 32768;
  /// How long a statement waits for another process that writes.
  int busy_milliseconds = 5000;
  /// Maximum number of pages of the file; 0: no limit.
  std::int64_t max_pages = 0;
};

/// Store::open with options.
Result<std::unique_ptr<Store>> open_store(const std::filesystem::path& file, OpenMode mode,
                                          const algebra3d::Registry& registry, const StoreOptions& options);

}  // namespace queries
