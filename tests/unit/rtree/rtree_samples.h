#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "rtree/rtree.h"

// Boxes of many kinds and the answers that a plain scan gives.
namespace rtree::samples {

using Entries = std::vector<Entry<std::uint64_t>>;
using Tree = RTree<std::uint64_t>;
using Pairs = std::vector<Pair<std::uint64_t>>;

inline constexpr double kInfinity = Box3::kInfinity;
inline constexpr double kMax = std::numeric_limits<double>::max();
inline constexpr double kLeast = std::numeric_limits<double>::denorm_min();

inline Box3 box_at(const Vec3& corner, const Vec3& size) {
  return {corner, corner + size};
}

inline Vec3 random_vec(std::mt19937_64& random, double low, double high) {
  std::uniform_real_distribution<double> coordinate(low, high);
  const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return {x, y, z};
}

enum class Kind { uniform, clustered, points, identical, slivers, grid, huge, outlier };
inline constexpr Kind kKinds[] = {Kind::uniform, Kind::clustered, Kind::points, Kind::identical,
                                  Kind::slivers, Kind::grid,      Kind::huge,   Kind::outlier};

inline Box3 random_box(std::mt19937_64& random, Kind kind) {
  switch (kind) {
    case Kind::uniform:
      return box_at(random_vec(random, 0, 100), random_vec(random, 0, 5));
    case Kind::clustered: {
      const double center = static_cast<double>(random() % 5) * 1000;
      std::normal_distribution<double> offset(center, 3);
      const double x = offset(random), y = offset(random), z = offset(random);
      return box_at({x, y, z}, random_vec(random, 0, 1));
    }
    case Kind::points:
      return box_at(random_vec(random, -1, 1), {});
    case Kind::identical:
      return {{1, 2, 3}, {4, 5, 6}};
    case Kind::slivers: {
      Vec3 size = random_vec(random, 0, 1e-6);
      size[random() % 3] = 100;
      return box_at(random_vec(random, 0, 100), size);
    }
    case Kind::grid: {  // touching cells and many equal ones
      const auto cell = [&] { return static_cast<double>(random() % 8); };
      const double x = cell(), y = cell(), z = cell();
      return box_at({x, y, z}, {1, 1, 1});
    }
    case Kind::huge:
      return box_at(random_vec(random, -4e307, 4e307), random_vec(random, 0, 4e307));
    case Kind::outlier:
      if (random() % 100 == 0) return box_at(random_vec(random, -1e300, 1e300), {});
      return box_at(1e-3 * random_vec(random, 0, 1), 1e-4 * random_vec(random, 0, 1));
  }
  return {};
}

inline Entries random_entries(std::size_t count, Kind kind, unsigned seed) {
  std::mt19937_64 random(seed);
  Entries entries;
  for (std::size_t id = 0; id < count; ++id) entries.push_back({random_box(random, kind), id});
  return entries;
}

inline Tree inserted(const Entries& entries) {
  Tree tree;
  for (const auto& entry : entries) tree.insert(entry.box, entry.payload);
  return tree;
}

inline std::vector<std::uint64_t> scan(const Entries& entries, const Box3& window) {
  std::vector<std::uint64_t> ids;
  for (const auto& entry : entries)
    if (entry.box.intersects(window)) ids.push_back(entry.payload);
  std::ranges::sort(ids);
  return ids;
}

inline Pairs scan_pairs(const Entries& first, const Entries& second) {
  Pairs pairs;
  for (const auto& a : first)
    for (const auto& b : second)
      if (a.box.intersects(b.box)) pairs.push_back({a.payload, b.payload});
  std::ranges::sort(pairs);
  return pairs;
}

inline std::vector<std::uint64_t> window_ids(const Tree& tree, const Box3& window) {
  std::vector<std::uint64_t> ids;
  for (const std::uint64_t id : tree.window(window)) ids.push_back(id);
  std::ranges::sort(ids);
  return ids;
}

template <typename Payload>
std::vector<Pair<Payload>> sorted_pairs(JoinCursor<Payload> cursor) {
  std::vector<Pair<Payload>> pairs;
  while (const auto pair = cursor.next()) pairs.push_back(*pair);
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace rtree::samples
