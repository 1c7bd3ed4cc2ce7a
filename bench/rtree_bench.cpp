// The R-tree beside Boost.Geometry's with its packing constructor, on the same data in the same run: random cubes in
// the unit cube, sized so that each meets about 1.5 of another such set. Compare the pairs of lines of the same name.
#include <benchmark/benchmark.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <random>

#include "rtree/rtree.h"

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using algebra3d::Box3;
using algebra3d::Vec3;
using Entry = rtree::Entry<std::uint64_t>;
using Tree = rtree::RTree<std::uint64_t>;
using BoostPoint = bg::model::point<double, 3, bg::cs::cartesian>;
using BoostBox = bg::model::box<BoostPoint>;
using BoostValue = std::pair<BoostBox, std::uint64_t>;
using BoostTree = bgi::rtree<BoostValue, bgi::rstar<16>>;

constexpr std::size_t kWindowCount = 100'000;
constexpr std::size_t kNearestCount = 10'000;

Box3 cube(const Vec3& corner, double side) {
  return {corner, corner + Vec3{side, side, side}};
}

// Two such cubes meet with probability (2 side)^3.
double side_for(double partners, std::size_t count) {
  return std::cbrt(partners / static_cast<double>(count)) / 2;
}

std::vector<Entry> random_entries(std::size_t count, double side, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    entries.push_back({cube({x, y, z}, side), i});
  }
  return entries;
}

BoostBox boost_box(const Box3& box) {
  return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

std::vector<BoostValue> boost_values(const std::vector<Entry>& entries) {
  std::vector<BoostValue> values;
  for (const Entry& entry : entries) values.emplace_back(boost_box(entry.box), entry.payload);
  return values;
}

struct Data {
  std::vector<Entry> first, second;
  std::vector<BoostValue> boost_first;
  std::vector<Box3> windows, places;
  Tree first_tree, second_tree;
  BoostTree boost_tree;

  explicit Data(std::size_t count) {
    const double side = side_for(1.5, count);
    first = random_entries(count, side, 1);
    second = random_entries(count, side, 2);
    boost_first = boost_values(first);
    // A window of this side meets 5 entries.
    const double window_side = 2 * side_for(5, count) - side;
    for (const Entry& entry : random_entries(kWindowCount, window_side, 3)) windows.push_back(entry.box);
    for (const Entry& entry : random_entries(kNearestCount, 0, 4)) places.push_back(entry.box);
    first_tree = Tree::bulk_load(first);
    second_tree = Tree::bulk_load(second);
    boost_tree = BoostTree(boost_first);
  }
};

const Data& data(std::int64_t count) {
  static const Data million(1'000'000);
  static const Data thousand(10'000);
  return count == 1'000'000 ? million : thousand;
}

void build_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  double bytes = 0;
  for (auto _ : state) {
    const Tree tree = Tree::bulk_load(d.first);
    bytes = static_cast<double>(tree.heap_bytes());
  }
  state.counters["bytes_per_entry"] = bytes / static_cast<double>(d.first.size());
}

void build_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(BoostTree(d.boost_first));
}

void insert_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  for (auto _ : state) {
    Tree tree;
    for (const Entry& entry : d.first) tree.insert(entry.box, entry.payload);
    benchmark::DoNotOptimize(tree.size());
  }
}

void insert_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  for (auto _ : state) {
    BoostTree tree;
    for (const BoostValue& value : d.boost_first) tree.insert(value);
    benchmark::DoNotOptimize(tree.size());
  }
}

void window_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::size_t hits = 0;
  std::uint64_t sum = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Box3& window : d.windows) {
      for (const std::uint64_t id : d.first_tree.window(window)) {
        sum += id;
        ++hits;
      }
    }
  }
  benchmark::DoNotOptimize(sum);
  state.counters["hits"] = static_cast<double>(hits);
}

void window_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::size_t hits = 0;
  std::uint64_t sum = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Box3& window : d.windows) {
      const auto query = bgi::intersects(boost_box(window));
      for (auto it = d.boost_tree.qbegin(query); it != d.boost_tree.qend(); ++it) {
        sum += it->second;
        ++hits;
      }
    }
  }
  benchmark::DoNotOptimize(sum);
  state.counters["hits"] = static_cast<double>(hits);
}

// The faster interface of Boost: an output iterator instead of a query iterator.
void window_boost_eager(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::vector<BoostValue> found;
  std::size_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Box3& window : d.windows) {
      found.clear();
      d.boost_tree.query(bgi::intersects(boost_box(window)), std::back_inserter(found));
      hits += found.size();
    }
  }
  state.counters["hits"] = static_cast<double>(hits);
}

void nearest_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  double sum = 0;
  for (auto _ : state) {
    for (const Box3& place : d.places) {
      auto cursor = d.first_tree.nearest(place, 10);
      for (int i = 0; i < 10; ++i) sum += cursor.next()->distance;
    }
  }
  benchmark::DoNotOptimize(sum);
}

void nearest_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::vector<BoostValue> found;
  for (auto _ : state) {
    for (const Box3& place : d.places) {
      found.clear();
      d.boost_tree.query(bgi::nearest(BoostPoint(place.min.x, place.min.y, place.min.z), 10),
                         std::back_inserter(found));
      benchmark::DoNotOptimize(found.data());
    }
  }
}

void join_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    auto cursor = d.first_tree.join(d.second_tree);
    while (cursor.next()) ++pairs;
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

void join_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::vector<BoostValue> found;
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    for (const Entry& entry : d.second) {
      found.clear();
      d.boost_tree.query(bgi::intersects(boost_box(entry.box)), std::back_inserter(found));
      pairs += found.size();
    }
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

void self_join_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    rtree::for_each_pair(d.first_tree, [&](std::uint64_t, std::uint64_t) { ++pairs; });
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

BENCHMARK(build_ours)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(build_boost)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(window_ours)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(window_boost)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(window_boost_eager)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_ours)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_boost)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(join_ours)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(join_boost)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(self_join_ours)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(insert_ours)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(insert_boost)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
