#pragma once

#include <optional>
#include <set>
#include <span>
#include <utility>

#include <sqlite3.h>

#include "queries/store/detail/page_sums.h"

namespace queries {

/// A page whose checksum is wrong.
struct PageFault {
  std::uint32_t page = 0;
  bool is_in_log = false;  ///< it was read from the write-ahead log

  friend auto operator<=>(const PageFault&, const PageFault&) = default;
};

/// The checksums of a database as one connection knows them, and the pages that failed them.
class CheckedPages {
 public:
  bool has_sums() const { return has_sums_; }
  std::size_t page_bytes() const { return page_bytes_; }
  /// Learns from the beginning of the file whether pages have checksums. Once they have, nothing takes that back.
  void inspect(std::span<const std::byte> header);
  /// SQLITE_OK, or SQLITE_CORRUPT for a page with a wrong checksum, which is noted; if these are tolerated, SQLITE_OK.
  int check(std::span<const std::byte> page, PageFault place);

  void tolerate() { is_tolerant_ = true; }
  bool is_tolerant() const { return is_tolerant_; }
  /// Of the last page that failed; forgets it.
  std::optional<PageFault> take_last() { return std::exchange(last_, std::nullopt); }
  /// All that failed since `forget`, in order.
  const std::set<PageFault>& all() const { return all_; }
  void forget() {
    last_.reset();
    all_.clear();
  }

  /// Between its beginning and its end a checkpoint copies pages from the log into the file as they are: a damaged one
  /// is reported where it is read.
  bool is_in_checkpoint = false;

 private:
  bool has_sums_ = false;
  bool is_tolerant_ = false;
  std::size_t page_bytes_ = 0;
  std::optional<PageFault> last_;
  std::set<PageFault> all_;
};

/// A file as SQLite reads and writes it; results are SQLite's codes.
class RawFile {
 public:
  explicit RawFile(sqlite3_file* file) : file_(file) {}
  int read(std::span<std::byte> to, sqlite3_int64 offset) const {
    return file_->pMethods->xRead(file_, to.data(), static_cast<int>(to.size()), offset);
  }
  int write(std::span<const std::byte> from, sqlite3_int64 offset) const {
    return file_->pMethods->xWrite(file_, from.data(), static_cast<int>(from.size()), offset);
  }

 private:
  sqlite3_file* file_;
};

}  // namespace queries
