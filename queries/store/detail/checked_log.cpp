#include "queries/store/detail/checked_log.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "queries/store/detail/reading_step.h"

namespace queries {
namespace {

constexpr sqlite3_int64 kLogHeaderBytes = 32;
constexpr sqlite3_int64 kSumsInLogHeader = 24;
/// In the header of a frame: salts and checksums behind the page's number and the size of the database.
constexpr std::size_t kSaltsInFrame = 8;
constexpr std::size_t kSumsInFrame = 16;

std::uint32_t word_of(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (const std::byte byte : bytes.first(4)) value = value << 8 | std::to_integer<std::uint32_t>(byte);
  return value;
}

void set_word(std::span<std::byte> bytes, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::byte>(value >> (24 - 8 * i) & 0xff);
}

/// The two checksums of a frame, which go on from those of the frame before: the file format of SQLite, section 4.2.
struct FrameSums {
  std::uint32_t first, second;

  template <bool kSwaps>
  void add(std::span<const std::byte> bytes) {
    for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
      std::array<std::uint32_t, 2> words;
      std::memcpy(words.data(), bytes.data() + i, sizeof words);
      if constexpr (kSwaps)
        for (std::uint32_t& word : words) word = __builtin_bswap32(word);
      first += words[0] + second;
      second += words[1] + first;
    }
  }
};

}  // namespace

std::size_t CheckedLog::place_in_frame(sqlite3_int64 offset) const {
  return static_cast<std::size_t>(offset - kLogHeaderBytes) % frame_bytes();
}

int CheckedLog::read(std::span<std::byte> to, sqlite3_int64 offset) {
  const bool is_page = pages_.has_sums() && !pages_.is_in_checkpoint && to.size() == pages_.page_bytes() &&
                       offset > kLogHeaderBytes && place_in_frame(offset) == kFrameHeaderBytes;
  if (!is_page) return file_.read(to, offset);
  if (ReadingStep::is_interrupted()) return SQLITE_INTERRUPT;
  frame_.resize(frame_bytes());
  const int code = file_.read(frame_, offset - static_cast<sqlite3_int64>(kFrameHeaderBytes));
  if (code != SQLITE_OK) return file_.read(to, offset);
  std::ranges::copy(page(), to.begin());
  return pages_.check(page(), {word_of(header()), true});
}

// SQLite writes the header of a frame, then its page. A page without a header before it overwrites one of the same
// transaction.
int CheckedLog::write(std::span<const std::byte> from, sqlite3_int64 offset) {
  if (!pages_.has_sums() || offset < kLogHeaderBytes) {
    end_writing();
    return file_.write(from, offset);
  }
  const std::size_t place = place_in_frame(offset);
  if (place == 0 && from.size() == kFrameHeaderBytes) {
    std::ranges::copy(from, written_header_.begin());
    header_place_ = offset;
    return file_.write(from, offset);
  }
  if (place == kFrameHeaderBytes && from.size() == pages_.page_bytes())
    return write_page(from, offset - static_cast<sqlite3_int64>(kFrameHeaderBytes));
  return write_part(from, offset);
}

int CheckedLog::write_page(std::span<const std::byte> from, sqlite3_int64 frame) {
  frame_.resize(frame_bytes());
  const bool follows_header = std::exchange(header_place_, 0) == frame;
  if (follows_header)
    std::ranges::copy(written_header_, frame_.begin());
  else if (const int code = file_.read(header(), frame); code != SQLITE_OK)
    return code;
  std::ranges::copy(from, page().begin());
  if (follows_header) return write_frame(frame);
  set_page_sum(page(), word_of(header()));
  return file_.write(page(), frame + static_cast<sqlite3_int64>(kFrameHeaderBytes));
}

// Where sectors may be torn, SQLite divides a page at the end of a sector.
int CheckedLog::write_part(std::span<const std::byte> from, sqlite3_int64 offset) {
  const int code = file_.write(from, offset);
  const std::size_t end = place_in_frame(offset) + from.size();
  if (code != SQLITE_OK || end < frame_bytes()) return code;
  if (end > frame_bytes()) return SQLITE_IOERR_WRITE;  // no SQLite writes several frames at once
  frame_.resize(frame_bytes());
  const sqlite3_int64 frame = offset - static_cast<sqlite3_int64>(place_in_frame(offset));
  const int found = file_.read(frame_, frame);
  return found == SQLITE_OK ? write_frame(frame) : found;
}

// SQLite leaves salts and checksums 0 where it will compute them from the file, at the end of the transaction.
int CheckedLog::write_frame(sqlite3_int64 frame) {
  set_page_sum(page(), word_of(header()));
  const auto open = header().subspan(kSaltsInFrame);
  const bool is_open = std::ranges::all_of(open, [](std::byte byte) { return byte == std::byte{0}; });
  if (!is_open) {
    int code = prove_predecessor(frame);
    if (code == SQLITE_OK) code = set_frame_sum(frame);
    if (code != SQLITE_OK) return code;
  }
  last_written_ = frame;
  return file_.write(frame_, frame);
}

// Another program's frames do not go on from ours in the file: after a crash SQLite would stop reading at the first of
// them, and lose what was written behind them.
int CheckedLog::prove_predecessor(sqlite3_int64 frame) {
  const sqlite3_int64 before = frame - static_cast<sqlite3_int64>(frame_bytes());
  if (before < kLogHeaderBytes || before == last_written_) return SQLITE_OK;
  std::vector<std::byte> other(frame_bytes());
  if (const int code = file_.read(other, before); code != SQLITE_OK) return code;
  return pages_.check(std::span(other).subspan(kFrameHeaderBytes), {word_of(other), true});
}

int CheckedLog::set_frame_sum(sqlite3_int64 frame) {
  constexpr std::uint32_t kMagic = 0x377f0682;  // its last bit: words are big-endian
  const auto before =
      frame == kLogHeaderBytes ? kSumsInLogHeader : frame - static_cast<sqlite3_int64>(frame_bytes() - kSumsInFrame);
  std::array<std::byte, 4> magic{};
  std::array<std::byte, 8> last{};
  if (const int code = file_.read(magic, 0); code != SQLITE_OK) return code;
  if (const int code = file_.read(last, before); code != SQLITE_OK) return code;
  const bool is_big = word_of(magic) != kMagic;
  FrameSums sums{word_of(last), word_of(std::span(last).subspan(4))};
  for (const auto part : {header().first(kSaltsInFrame), page()}) {
    if (is_big == (std::endian::native == std::endian::big))
      sums.add<false>(part);
    else
      sums.add<true>(part);
  }
  set_word(header().subspan(kSumsInFrame), sums.first);
  set_word(header().subspan(kSumsInFrame + 4), sums.second);
  return SQLITE_OK;
}

}  // namespace queries
