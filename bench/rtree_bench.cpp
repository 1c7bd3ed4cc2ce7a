// The R-tree beside Boost.Geometry's with its packing constructor, and joins also beside a grid with a sweep, on the
// same data in the same run: random cubes in the unit cube, sized so that each meets about 1.5 of another such set.
// Compare the lines of the same name. The second argument of ours is the number of threads; peers use one.
#include <benchmark/benchmark.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <random>

#include "base/scheduler.h"
#include "grid_sweep.h"
#include "rtree/rtree.h"

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using algebra3d::Box3;
using algebra3d::Vec3;
using Entry = rtree::Entry<std::uint64_t>;
using Tree = rtree::RTree<std::uint64_t>;
using rtree::BoxTree;
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

std::vector<Box3> boxes_of(const std::vector<Entry>& entries) {
  std::vector<Box3> boxes;
  for (const Entry& entry : entries) boxes.push_back(entry.box);
  return boxes;
}

struct Data {
  std::vector<Entry> entries;
  std::vector<Box3> first, second, windows, places;
  std::vector<BoostValue> boost_first;
  BoxTree first_tree, second_tree;
  Tree owning_tree;
  BoostTree boost_tree;

  explicit Data(std::size_t count) {
    const double side = side_for(1.5, count);
    entries = random_entries(count, side, 1);
    first = boxes_of(entries);
    second = boxes_of(random_entries(count, side, 2));
    // A window of this side meets 5 entries.
    const double window_side = 2 * side_for(5, count) - side;
    windows = boxes_of(random_entries(kWindowCount, window_side, 3));
    places = boxes_of(random_entries(kNearestCount, 0, 4));
    first_tree = BoxTree(first);
    second_tree = BoxTree(second);
    owning_tree = Tree::bulk_load(entries);
    boost_first = boost_values(entries);
    boost_tree = BoostTree(boost_first);
  }
};

const Data& data(std::int64_t count) {
  static std::map<std::int64_t, Data> all;
  const auto known = all.find(count);
  return known != all.end() ? known->second : all.try_emplace(count, static_cast<std::size_t>(count)).first->second;
}

void with_threads(benchmark::State& state, const std::function<void(const Data&)>& work) {
  const Data& d = data(state.range(0));
  algebra3d::with_threads(static_cast<int>(state.range(1)), [&] { work(d); });
}

void build_ours(benchmark::State& state) {
  with_threads(state, [&](const Data& d) {
    double bytes = 0;
    for (auto _ : state) {
      const BoxTree tree(d.first);
      bytes = static_cast<double>(tree.heap_bytes());
    }
    state.counters["bytes_per_entry"] = bytes / static_cast<double>(d.first.size());
  });
}

// With copies of the boxes and payloads of 64 bits.
void build_owning(benchmark::State& state) {
  with_threads(state, [&](const Data& d) {
    double bytes = 0;
    for (auto _ : state) {
      const Tree tree = Tree::bulk_load(d.entries);
      bytes = static_cast<double>(tree.heap_bytes());
    }
    state.counters["bytes_per_entry"] = bytes / static_cast<double>(d.first.size());
  });
}

void build_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(BoostTree(d.boost_first));
}

void insert_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  for (auto _ : state) {
    Tree tree;
    for (const Entry& entry : d.entries) tree.insert(entry.box, entry.payload);
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

template <typename AnyTree>
void ask_windows(benchmark::State& state, const Data& d, const AnyTree& tree) {
  std::size_t hits = 0;
  std::uint64_t sum = 0;
  for (auto _ : state) {
    hits = 0;
    for (const Box3& window : d.windows) {
      for (const std::uint64_t id : tree.window(window)) {
        sum += id;
        ++hits;
      }
    }
  }
  benchmark::DoNotOptimize(sum);
  state.counters["hits"] = static_cast<double>(hits);
}

void window_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  ask_windows(state, d, d.first_tree);
}

void window_owning(benchmark::State& state) {
  const Data& d = data(state.range(0));
  ask_windows(state, d, d.owning_tree);
}

// After a tenth of the entries was erased one by one and others inserted.
void window_after_changes(benchmark::State& state) {
  const Data& d = data(state.range(0));
  Tree tree = Tree::bulk_load(d.entries, rtree::Filling::room_for_changes);
  for (std::size_t i = 0; i < d.entries.size(); i += 10) {
    tree.erase(d.entries[i].box, d.entries[i].payload);
    tree.insert(d.second[i], d.entries[i].payload);
  }
  ask_windows(state, d, tree);
}

void window_before_changes(benchmark::State& state) {
  const Data& d = data(state.range(0));
  ask_windows(state, d, Tree::bulk_load(d.entries, rtree::Filling::room_for_changes));
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

template <typename AnyTree>
void ask_nearest(benchmark::State& state, const Data& d, const AnyTree& tree) {
  double sum = 0;
  for (auto _ : state) {
    for (const Box3& place : d.places) {
      auto cursor = tree.nearest(place, 10);
      for (int i = 0; i < 10; ++i) sum += cursor.next()->distance;
    }
  }
  benchmark::DoNotOptimize(sum);
}

void nearest_ours(benchmark::State& state) {
  const Data& d = data(state.range(0));
  ask_nearest(state, d, d.first_tree);
}

void nearest_owning(benchmark::State& state) {
  const Data& d = data(state.range(0));
  ask_nearest(state, d, d.owning_tree);
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

std::size_t count_pairs(BoxTree::JoinCursor cursor) {
  std::size_t pairs = 0;
  for (auto batch = cursor.next_batch(); !batch.empty(); batch = cursor.next_batch()) pairs += batch.size();
  return pairs;
}

void join_ours(benchmark::State& state) {
  with_threads(state, [&](const Data& d) {
    std::size_t pairs = 0;
    for (auto _ : state) pairs = count_pairs(d.first_tree.join(d.second_tree));
    state.counters["pairs"] = static_cast<double>(pairs);
  });
}

void join_with_builds_ours(benchmark::State& state) {
  with_threads(state, [&](const Data& d) {
    std::size_t pairs = 0;
    for (auto _ : state) pairs = count_pairs(BoxTree(d.first).join(BoxTree(d.second)));
    state.counters["pairs"] = static_cast<double>(pairs);
  });
}

void join_with_builds_grid(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    bench::grid_sweep_join(d.first, d.second, [&](std::uint32_t, std::uint32_t) { ++pairs; });
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

void join_boost(benchmark::State& state) {
  const Data& d = data(state.range(0));
  std::vector<BoostValue> found;
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    for (const Box3& box : d.second) {
      found.clear();
      d.boost_tree.query(bgi::intersects(boost_box(box)), std::back_inserter(found));
      pairs += found.size();
    }
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

void self_join_ours(benchmark::State& state) {
  with_threads(state, [&](const Data& d) {
    std::size_t pairs = 0;
    for (auto _ : state) pairs = count_pairs(d.first_tree.self_join());
    state.counters["pairs"] = static_cast<double>(pairs);
  });
}

// The numbers of a million are those that count; Boost's insertions and joins take too long for more.
void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(1000)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond);
}
void small_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
}
void sizes_and_threads(benchmark::internal::Benchmark* benchmark) {
  for (std::int64_t count = 1000; count <= 10'000'000; count *= 10)
    for (const int threads : {1, 2}) benchmark->Args({count, threads});
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(build_ours)->Apply(sizes_and_threads);
BENCHMARK(build_owning)->Apply(sizes_and_threads);
BENCHMARK(build_boost)->Apply(sizes);
BENCHMARK(window_ours)->Apply(sizes);
BENCHMARK(window_owning)->Apply(sizes);
BENCHMARK(window_before_changes)->Apply(small_sizes);
BENCHMARK(window_after_changes)->Apply(small_sizes);
BENCHMARK(window_boost)->Apply(sizes);
BENCHMARK(window_boost_eager)->Apply(sizes);
BENCHMARK(nearest_ours)->Apply(sizes);
BENCHMARK(nearest_owning)->Apply(sizes);
BENCHMARK(nearest_boost)->Apply(sizes);
BENCHMARK(join_ours)->Apply(sizes_and_threads);
BENCHMARK(join_with_builds_ours)->Apply(sizes_and_threads);
BENCHMARK(join_with_builds_grid)->Apply(sizes);
BENCHMARK(join_boost)->Apply(small_sizes);
BENCHMARK(self_join_ours)->Apply(sizes_and_threads);
BENCHMARK(insert_ours)->Apply(small_sizes);
BENCHMARK(insert_boost)->Apply(small_sizes);

}  // namespace
