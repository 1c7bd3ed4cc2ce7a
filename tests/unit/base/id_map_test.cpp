#include "base/id_map.h"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

#include "algebra3d/base/strong_id.h"

namespace algebra3d {
namespace {

using NumberOfKey = StrongId<struct NumberOfKeyTag>;

/// Enters 40,000 keys into a map that is empty, but may have room.
void expect_standard_map(std::uint64_t range, IdMap<NumberOfKey> map) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  std::unordered_map<std::uint64_t, NumberOfKey> expected;
  for (int i = 0; i < 40000; ++i) {
    // Also keys that differ in the upper half only, as two ids in one number do.
    const std::uint64_t key = i % 2 == 0 ? random() % range : (random() % range) << 32U;
    NumberOfKey& id = map[key];
    const auto [entry, is_new] = expected.try_emplace(key, NumberOfKey(expected.size()));
    ASSERT_EQ(id.is_none(), is_new);
    if (is_new) id = entry->second;
    ASSERT_EQ(id, entry->second);
  }
  for (const auto& [key, id] : expected) ASSERT_EQ(map[key], id);
}

TEST(IdMap, gives_what_a_standard_map_gives) {
  for (const std::uint64_t range : {std::uint64_t{10}, std::uint64_t{5000}, ~std::uint64_t{0}}) {
    expect_standard_map(range, {});
    // Room for fewer keys than come, for as many, and for more.
    for (const std::size_t room : {1U, 100U, 40000U, 100000U}) {
      IdMap<NumberOfKey> map;
      map.reserve(room);
      expect_standard_map(range, map);
    }
  }
}

}  // namespace
}  // namespace algebra3d
