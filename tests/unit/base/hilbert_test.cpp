// The curve by its definition: it visits each cell once, and goes on to a neighbour each time.
#include "base/hilbert.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

namespace algebra3d {
namespace {

using Cell = std::array<std::uint32_t, 3>;

TEST(Hilbert, CellsThatFollowOneAnotherHaveASideInCommon) {
  constexpr std::uint32_t kSide = 16;
  std::vector<Cell> cells(kSide * kSide * kSide, Cell{kSide, kSide, kSide});
  for (std::uint32_t x = 0; x < kSide; ++x)
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t z = 0; z < kSide; ++z) {
        Cell& cell = cells.at(hilbert_code<4>(x, y, z));
        EXPECT_EQ(cell[0], kSide) << "two cells at one place";
        cell = {x, y, z};
      }
  for (std::size_t i = 1; i < cells.size(); ++i) {
    int steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      steps += std::abs(static_cast<int>(cells[i][axis]) - static_cast<int>(cells[i - 1][axis]));
    EXPECT_EQ(steps, 1) << i;
  }
}

TEST(Hilbert, ACodeBeginsWithThatOfTheLargerCell) {
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const std::uint32_t x = i * 2003 % 0x1FFFFF, y = i * 70001 % 0x1FFFFF, z = i * 900001 % 0x1FFFFF;
    EXPECT_EQ(hilbert_code<22>(x, y, z) >> 30, hilbert_code<12>(x >> 10, y >> 10, z >> 10)) << i;
  }
}

}  // namespace
}  // namespace algebra3d
