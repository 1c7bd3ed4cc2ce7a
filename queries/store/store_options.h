#pragma once

#include <cstdint>
#include <memory>

#include "queries/store/store.h"

namespace queries {

/// Limits of a store. The defaults are what people get; tests lower them.
struct StoreOptions {
  /// Bytes of encoded values that one row may hold; a value that goes beyond is cut into chunks in a side table. SQLite
  /// itself ends at 10^9 bytes a row.
  std::uint64_t inline_bytes = std::uint64_t{256} << 20;
  std::uint64_t chunk_bytes = std::uint64_t{64} << 20;
  /// Estimated bytes of loaded geometry that are kept from statement to statement.
  std::uint64_t cache_bytes = std::uint64_t{256} << 20;
  /// Kilobytes of the file's pages that SQLite keeps. Changes beyond it are written before their statement ends.
  int page_cache_kilobytes = 32768;
  /// How long a statement waits for another process that writes.
  int busy_milliseconds = 5000;
  /// Pages that the file may have; 0: no limit.
  std::int64_t max_pages = 0;
};

/// As Store::open.
Result<std::unique_ptr<Store>> open_store(const std::filesystem::path& file, OpenMode mode,
                                          const algebra3d::Registry& registry, const StoreOptions& options);

}  // namespace queries
