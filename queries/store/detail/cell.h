#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace queries {

/// The value of one column of one row. Texts and blobs refer to bytes of the caller.
struct Cell {
  enum class Kind : std::uint8_t { null, integer, real, text, blob };

  Kind kind = Kind::null;
  std::int64_t integer = 0;
  double real = 0;
  std::string_view bytes;

  static Cell of(std::int64_t value) { return {Kind::integer, value, 0, {}}; }
  static Cell of(double value) { return {Kind::real, 0, value, {}}; }
  static Cell text(std::string_view bytes) { return {Kind::text, 0, 0, bytes}; }
  static Cell blob(std::string_view bytes) { return {Kind::blob, 0, 0, bytes}; }

  bool is_null() const { return kind == Kind::null; }
  bool is(Kind wanted) const { return kind == wanted; }
};

/// Whether two cells are the same to the last bit.
bool are_same(const Cell& a, const Cell& b);

/// Appends the bytes of the cells, with their kinds; the checksum of a row is computed from them: docs/file_format.md.
void append_cells(std::span<const Cell> cells, std::string& bytes);
/// Reads back the cells that `append_cells` wrote at the beginning of `bytes`. They refer to `bytes`.
void take_cells(std::string_view bytes, std::span<Cell> cells);

/// Checksum of the bytes of the cells. Cost: linear in the bytes.
std::uint64_t checksum_of(std::span<const Cell> cells);
/// Checksum of the bytes of a stored value.
std::uint64_t checksum_of(std::string_view bytes);
/// Checksum with a seed of the bytes of a stored value.
std::uint64_t checksum_of(std::string_view bytes, std::uint64_t seed);

/// Converts a checksum to SQLite's signed integers; all 64 bits are kept.
inline std::int64_t as_signed(std::uint64_t bits) {
  return static_cast<std::int64_t>(bits);
}
inline std::uint64_t as_unsigned(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

}  // namespace queries
