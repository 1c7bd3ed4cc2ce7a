#include "queries/store/detail/cell.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#define XXH_INLINE_ALL  // rows are short: the call would cost as much as the sum
#include <xxhash.h>

namespace queries {
namespace {

/// The kind, and a number or the length of a text.
constexpr std::size_t kHeadBytes = 1 + sizeof(std::uint64_t);

std::uint64_t little_endian(std::uint64_t value) {
  if constexpr (std::endian::native == std::endian::big) return __builtin_bswap64(value);
  return value;
}

std::uint64_t word_of(const Cell& cell) {
  if (cell.kind == Cell::Kind::integer) return as_unsigned(cell.integer);
  if (cell.kind == Cell::Kind::real) return std::bit_cast<std::uint64_t>(cell.real);
  return cell.bytes.size();
}

bool has_bytes(Cell::Kind kind) {
  return kind == Cell::Kind::text || kind == Cell::Kind::blob;
}

std::size_t written_size(std::span<const Cell> cells) {
  std::size_t size = 0;
  for (const Cell& cell : cells)
    size += cell.is_null() ? 1 : kHeadBytes + (has_bytes(cell.kind) ? cell.bytes.size() : 0);
  return size;
}

}  // namespace

std::uint64_t checksum_of(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t checksum_of(std::string_view bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

bool are_same(const Cell& a, const Cell& b) {
  if (a.kind != b.kind) return false;
  if (a.is(Cell::Kind::integer)) return a.integer == b.integer;
  if (a.is(Cell::Kind::real)) return std::bit_cast<std::uint64_t>(a.real) == std::bit_cast<std::uint64_t>(b.real);
  return a.bytes == b.bytes;
}

void append_cells(std::span<const Cell> cells, std::string& bytes) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + written_size(cells));
  char* to = bytes.data() + begin;
  for (const Cell& cell : cells) {
    *to++ = static_cast<char>(cell.kind);
    if (cell.is_null()) continue;
    const std::uint64_t word = little_endian(word_of(cell));
    std::memcpy(to, &word, sizeof(word));
    to += sizeof(word);
    if (has_bytes(cell.kind)) to = std::ranges::copy(cell.bytes, to).out;
  }
}

void take_cells(std::string_view bytes, std::span<Cell> cells) {
  const char* from = bytes.data();
  for (Cell& cell : cells) {
    const auto kind = static_cast<Cell::Kind>(*from++);
    cell = {};
    if (kind == Cell::Kind::null) continue;
    std::uint64_t word = 0;
    std::memcpy(&word, from, sizeof(word));
    word = little_endian(word);
    from += sizeof(word);
    cell.kind = kind;
    if (kind == Cell::Kind::integer) {
      cell.integer = as_signed(word);
    } else if (kind == Cell::Kind::real) {
      cell.real = std::bit_cast<double>(word);
    } else {
      cell.bytes = {from, word};
      from += word;
    }
  }
  assert(from <= bytes.data() + bytes.size());
}

std::uint64_t checksum_of(std::span<const Cell> cells) {
  std::string bytes;
  append_cells(cells, bytes);
  return checksum_of(std::string_view(bytes));
}

}  // namespace queries
