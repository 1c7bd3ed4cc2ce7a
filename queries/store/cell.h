#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace queries {

/// What one column of one row holds. Refers to bytes that lie elsewhere.
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

/// Appends the bytes of cells in their order, kinds included, over which their checksum goes: docs/file_format.md.
void append_cells(std::span<const Cell> cells, std::string& bytes);
/// The cells that `append_cells` has written at the beginning of these bytes, to which they refer.
void take_cells(std::string_view bytes, std::span<Cell> cells);

/// Checksum of the bytes of cells. Cost: linear in the bytes.
std::uint64_t checksum_of(std::span<const Cell> cells);
/// Checksum of the bytes of a stored value.
std::uint64_t checksum_of(std::string_view bytes);

/// Checksums use all 64 bits, SQLite's integers are signed.
inline std::int64_t as_signed(std::uint64_t bits) {
  return static_cast<std::int64_t>(bits);
}
inline std::uint64_t as_unsigned(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

}  // namespace queries
