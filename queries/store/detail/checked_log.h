#pragma once

#include <array>
#include <optional>
#include <vector>

#include "queries/store/detail/checked_pages.h"

namespace queries {

/// SQLite's write-ahead log of a database whose pages have checksums: proves each page that is read, and writes the
/// checksum of each page that is written. The bytes that reach the file are a log as any SQLite reads it:
/// https://www.sqlite.org/fileformat.html, section 4.
///
/// SQLite computes the checksum of a frame before the page has its own, and each frame's goes on from the one before.
/// So the frame's is computed again here, from that of the frame before it in the file. What SQLite has computed is of
/// no use to it later: it reads the checksums of frames from the file, and only when it recovers a log.
class CheckedLog {
 public:
  CheckedLog(RawFile file, CheckedPages& pages) : file_(file), pages_(pages) {}

  int read(std::span<std::byte> to, sqlite3_int64 offset);
  int write(std::span<const std::byte> from, sqlite3_int64 offset);
  /// To be called when another connection may write next.
  void end_writing() { last_written_ = 0; }

 private:
  static constexpr std::size_t kFrameHeaderBytes = 24;

  std::size_t frame_bytes() const { return kFrameHeaderBytes + pages_.page_bytes(); }
  std::size_t place_in_frame(sqlite3_int64 offset) const;
  std::span<std::byte> header() { return std::span(frame_).first(kFrameHeaderBytes); }
  std::span<std::byte> page() { return std::span(frame_).subspan(kFrameHeaderBytes); }
  int write_page(std::span<const std::byte> from, sqlite3_int64 frame);
  int write_part(std::span<const std::byte> from, sqlite3_int64 offset);
  int write_frame(sqlite3_int64 frame);
  int prove_predecessor(sqlite3_int64 frame);
  int set_frame_sum(sqlite3_int64 frame);

  RawFile file_;
  CheckedPages& pages_;
  std::vector<std::byte> frame_;  // header and page
  std::array<std::byte, kFrameHeaderBytes> written_header_{};
  sqlite3_int64 header_place_ = 0;  // of the header that was written last, whose page follows; 0: none
  sqlite3_int64 last_written_ = 0;  // place of the frame that this connection wrote last; 0: not known
};

}  // namespace queries
