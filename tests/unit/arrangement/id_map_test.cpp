#include "algebra3d/arrangement/detail/id_map.h"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

#include "algebra3d/arrangement/detail/ids.h"

namespace algebra3d::arrangement_tests {
namespace {

using arrangement::IdMap;
using arrangement::NodeId;

TEST(IdMap, gives_what_a_standard_map_gives) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  for (const std::uint64_t range : {std::uint64_t{10}, std::uint64_t{5000}, ~std::uint64_t{0}}) {
    IdMap<NodeId> map;
    std::unordered_map<std::uint64_t, NodeId> expected;
    for (int i = 0; i < 20000; ++i) {
      // Also keys that differ in the upper half only, as two ids in one number do.
      const std::uint64_t key = i % 2 == 0 ? random() % range : (random() % range) << 32U;
      NodeId& id = map[key];
      const auto [entry, is_new] = expected.try_emplace(key, NodeId(expected.size()));
      ASSERT_EQ(id.is_none(), is_new);
      if (is_new) id = entry->second;
      ASSERT_EQ(id, entry->second);
    }
    for (const auto& [key, id] : expected) ASSERT_EQ(map[key], id);
  }
}

}  // namespace
}  // namespace algebra3d::arrangement_tests
