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
