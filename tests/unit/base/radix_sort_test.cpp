#include "base/radix_sort.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "base/morton.h"

namespace algebra3d {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;

  friend bool operator==(const Keyed&, const Keyed&) = default;
};

template <unsigned kBits>
void expect_sorted_as_by_stable_sort(std::size_t count, const std::function<std::uint64_t(std::uint64_t)>& key_of) {
  std::mt19937_64 random(count);
  std::vector<Keyed> values(count), buffer(count);
  for (std::uint32_t i = 0; i < count; ++i) values[i] = {key_of(random() & ((std::uint64_t{1} << kBits) - 1)), i};
  std::vector<Keyed> expected = values;
  std::ranges::stable_sort(expected, {}, &Keyed::key);
  radix_sort<kBits>(std::span(values), std::span(buffer), [](const Keyed& value) { return value.key; });
  EXPECT_EQ(values, expected) << count << " values of " << kBits << " bits";
}

TEST(radix_sort, keeps_the_order_of_equal_keys) {
  for (const std::size_t count : {0, 1, 2, 255, 256, 1000, 65535, 65536, 200000}) {
    const auto any = [](std::uint64_t bits) { return bits; };
    expect_sorted_as_by_stable_sort<30>(count, any);
    expect_sorted_as_by_stable_sort<32>(count, any);
    expect_sorted_as_by_stable_sort<33>(count, any);
    // One digit is the same everywhere, or two, or all.
    expect_sorted_as_by_stable_sort<33>(count, [](std::uint64_t bits) { return bits & 0x3FFFFF; });
    expect_sorted_as_by_stable_sort<33>(count, [](std::uint64_t bits) { return bits & 7; });
    expect_sorted_as_by_stable_sort<33>(count, [](std::uint64_t bits) { return bits << 30 & 0x1FFFFFFFF; });
    expect_sorted_as_by_stable_sort<33>(count, [](std::uint64_t) { return 5; });
  }
}

TEST(morton_code, has_the_bits_of_the_coordinates_in_turn) {
  std::mt19937_64 random(1);
  const auto coordinate = [&] { return static_cast<std::uint32_t>(random() >> 43); };
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t x = coordinate(), y = coordinate(), z = coordinate();
    std::uint64_t expected = 0;
    for (unsigned bit = 0; bit < kMortonBits; ++bit)
      expected |= std::uint64_t{x >> bit & 1} << 3 * bit | std::uint64_t{y >> bit & 1} << (3 * bit + 1) |
                  std::uint64_t{z >> bit & 1} << (3 * bit + 2);
    ASSERT_EQ(morton_code(x, y, z), expected);
  }
}

}  // namespace
}  // namespace algebra3d
