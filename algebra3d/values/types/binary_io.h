#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Appends numbers to bytes of the caller, little-endian on every machine. docs/file_format.md describes the encodings.
class ByteWriter {
 public:
  explicit ByteWriter(std::string& bytes) : bytes_(bytes) {}

  void u8(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void u16(std::uint16_t value) { fixed(value, 2); }
  void u32(std::uint32_t value) { fixed(value, 4); }
  void u64(std::uint64_t value) { fixed(value, 8); }
  void f64(double value);
  /// Appends a varint: seven bits per byte, lowest first, the top bit set on all bytes but the last.
  void varint(std::uint64_t value);
  void raw(std::string_view content) { bytes_.append(content); }
  /// Appends the length as a varint, then the bytes.
  void text(std::string_view content);
  /// Appends byte planes: one byte for the width of the largest value in bytes (at least `min_width`), then as many
  /// planes, from the most significant bytes of all values to the least significant ones. The reader must know the
  /// number of values.
  void planes(std::span<const std::uint64_t> values, int min_width = 0);

 private:
  void fixed(std::uint64_t value, int width);
  std::string& bytes_;
};

/// Reads the numbers of byte planes (see ByteWriter::planes) one after the other, without an array of all of them. The
/// bytes are kept as a view.
class PlaneReader {
 public:
  /// No numbers.
  PlaneReader() = default;
  /// `planes` has a whole number of bytes for each of `count` numbers, at most eight.
  PlaneReader(std::string_view planes, std::size_t count) : planes_(planes), count_(count) {}

  /// The next number; there must be one (asserted).
  std::uint64_t next() {
    if (place_ == kBlock) fill();
    return block_[place_++];
  }

 private:
  static constexpr std::size_t kBlock = 256;

  void fill();

  std::string_view planes_;
  std::size_t count_ = 0;
  std::size_t filled_ = 0;
  std::array<std::uint64_t, kBlock> block_{};
  std::size_t place_ = kBlock;
};

/// Reads the encodings of ByteWriter from arbitrary bytes. After the first failure, which is recorded with its
/// position, every member returns zero or nothing. Check `status` before using values for more than counting.
class ByteReader {
 public:
  /// `what` begins messages, as in "volume3d"; both are kept as views.
  ByteReader(std::string_view bytes, std::string_view what) : bytes_(bytes), what_(what) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(fixed(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(fixed(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(fixed(4)); }
  std::uint64_t u64() { return fixed(8); }
  double f64();
  std::uint64_t varint();
  std::string_view raw(std::uint64_t length);
  std::string_view text() { return raw(varint()); }
  /// A varint that counts following items of at least `bytes_each` bytes. Fails if the remaining bytes are too few, so
  /// that a wrong count cannot exhaust memory.
  std::size_t count(std::size_t bytes_each);
  /// `count` values of ByteWriter::planes, each below 256^max_width.
  std::vector<std::uint64_t> planes(std::size_t count, int min_width, int max_width);
  /// Reads such values one after the other; no numbers after a failure.
  PlaneReader plane_reader(std::size_t count, int min_width, int max_width);

  std::size_t position() const { return position_; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  bool ok() const { return expectation_.empty(); }
  /// Records the failure "expected EXPECTATION" before the current position, unless there was a failure already.
  void fail(std::string expectation) { fail_at(position_, std::move(expectation)); }
  /// Records such a failure before another position.
  void fail_at(std::size_t position, std::string expectation);
  void require(bool condition, const char* expectation) {
    if (!condition) fail(expectation);
  }
  /// Errors: database_corrupt, "WHAT: byte N of the body: expected ...".
  Status status() const;
  /// `status`, and an error if bytes are left over.
  Status finish();

 private:
  std::uint64_t fixed(std::size_t width);
  std::string_view bytes_;
  std::string_view what_;
  std::size_t position_ = 0;
  std::size_t failed_at_ = 0;
  std::string expectation_;
};

/// Encodes signed numbers as unsigned ones: 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
inline std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63U);
}
inline std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1U) ^ (0 - (value & 1U)));
}

}  // namespace algebra3d
