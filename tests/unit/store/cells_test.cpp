// The bytes over which the checksum of a row goes: docs/file_format.md.
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <xxhash.h>

#include "queries/store/detail/cell.h"

namespace queries {
namespace {

using namespace std::string_view_literals;

// As the page says: kind, then 8 bytes little-endian for numbers, length and bytes for texts and blobs.
constexpr auto kWritten =
    "\0"
    "\1\xfe\xff\xff\xff\xff\xff\xff\xff"
    "\2\0\0\0\0\0\0\xf8\x3f"
    "\3\3\0\0\0\0\0\0\0abc"
    "\4\0\0\0\0\0\0\0\0"sv;

std::array<Cell, 5> one_of_each() {
  return {Cell(), Cell::of(std::int64_t{-2}), Cell::of(1.5), Cell::text("abc"), Cell::blob({})};
}

TEST(Cells, are_written_as_the_page_of_the_format_says) {
  std::string bytes = "before";
  append_cells(one_of_each(), bytes);
  EXPECT_EQ(bytes, "before" + std::string(kWritten));
}

TEST(Cells, have_the_checksum_of_these_bytes) {
  EXPECT_EQ(checksum_of(one_of_each()), XXH3_64bits(kWritten.data(), kWritten.size()));
}

TEST(Cells, are_read_as_they_were_written) {
  std::array<Cell, 5> read;
  take_cells(kWritten, read);
  const auto written = one_of_each();
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].kind, written[i].kind);
    EXPECT_EQ(read[i].integer, written[i].integer);
    EXPECT_EQ(read[i].real, written[i].real);
    EXPECT_EQ(read[i].bytes, written[i].bytes);
  }
}

}  // namespace
}  // namespace queries
