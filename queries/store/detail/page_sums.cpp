#include "queries/store/detail/page_sums.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include "queries/store/detail/cell.h"

namespace queries {
namespace {

/// A range of bytes.
struct Field {
  std::size_t begin, size;
};

// Of the header of the file, https://www.sqlite.org/fileformat.html, section 1.3. These are changed by whoever copies
// the file with SQLite's backup, changes its journal mode, or gives a draft its name, and no answer depends on them.
constexpr Field kUncheckedFields[] = {
    {18, 2},  // versions for writing and reading: with or without a log
    {24, 4},  // counter of changes
    {40, 4},  // counter of changes to the schema
    {68, 4},  // application_id: "A3DB" or "A3DR", and nothing else is opened
    {92, 8},  // the counter of changes when the number of pages was written; number of SQLite's version
};

constexpr std::string_view kFileMagic("SQLite format 3\0", 16);

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT(*-reinterpret-cast)
}

std::uint64_t sum_of(std::span<const std::byte> page, std::uint32_t number) {
  const auto content = page.first(page.size() - kPageSumBytes);
  if (number != 1) return checksum_of(text_of(content), number);
  std::vector<std::byte> masked(content.begin(), content.end());
  for (const Field& field : kUncheckedFields)
    std::fill_n(masked.begin() + static_cast<std::ptrdiff_t>(field.begin), field.size, std::byte{0});
  return checksum_of(text_of(masked), number);
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (const std::byte byte : bytes) value = value << 8 | std::to_integer<std::uint32_t>(byte);
  return value;
}

}  // namespace

bool has_page_sum(std::span<const std::byte> page, std::uint32_t number) {
  if (page.size() <= kFileHeaderBytes) return false;
  const std::uint64_t sum = sum_of(page, number);
  const auto stored = page.last(kPageSumBytes);
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (std::to_integer<std::uint64_t>(stored[i]) != (sum >> (8 * i) & 0xff)) return false;
  return true;
}

void set_page_sum(std::span<std::byte> page, std::uint32_t number) {
  const std::uint64_t sum = sum_of(page, number);
  const auto stored = page.last(kPageSumBytes);
  for (std::size_t i = 0; i < stored.size(); ++i) stored[i] = static_cast<std::byte>(sum >> (8 * i) & 0xff);
}

PageFormat page_format(std::span<const std::byte> header) {
  constexpr std::size_t kPageSizePlace = 16, kReservedPlace = 20, kVersionPlace = 60;
  if (text_of(header.first(kFileMagic.size())) != kFileMagic) return {};
  PageFormat format;
  const std::uint32_t page_bytes = big_endian(header.subspan(kPageSizePlace, 2));
  format.page_bytes = page_bytes == 1 ? 65536 : page_bytes;
  format.reserved_bytes = std::to_integer<int>(header[kReservedPlace]);
  format.version = big_endian(header.subspan(kVersionPlace, 4));
  return format;
}

}  // namespace queries
