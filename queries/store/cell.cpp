#include "queries/store/cell.h"

#include <bit>
#include <string>

#include <xxhash.h>

namespace queries {
namespace {

void append_u64(std::string& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<char>((value >> shift) & 0xff));
}

}  // namespace

std::uint64_t checksum_of(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t checksum_of(std::span<const Cell> cells) {
  std::string bytes;
  bytes.reserve(cells.size() * 9);
  for (const Cell& cell : cells) {
    bytes.push_back(static_cast<char>(cell.kind));
    switch (cell.kind) {
      case Cell::Kind::null:
        break;
      case Cell::Kind::integer:
        append_u64(bytes, as_unsigned(cell.integer));
        break;
      case Cell::Kind::real:
        append_u64(bytes, std::bit_cast<std::uint64_t>(cell.real));
        break;
      case Cell::Kind::text:
      case Cell::Kind::blob:
        append_u64(bytes, cell.bytes.size());
        bytes.append(cell.bytes);
        break;
    }
  }
  return checksum_of(bytes);
}

}  // namespace queries
