#include "queries/streams/detail/spatial_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "algebra3d/operators/descriptions/set_of_value.h"
#include "base/morton.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace queries {

using algebra3d::Box3;
using algebra3d::Monitor;
using algebra3d::Vec3;

namespace {

/// Memory of a loaded value with its hierarchy, estimated by its size.
std::size_t loaded_bytes(const Value& value) {
  constexpr std::size_t kOfElement = 128, kOfValue = 1024;
  return value.is_deferred() ? kOfElement * value.header().size + kOfValue : sizeof(LoadedSet);
}

Vec3 middle(const Box3& box) {
  return 0.5 * box.min + 0.5 * box.max;
}

/// Where two boxes meet, or the middle between them: small, unless both are large.
Box3 place_of(const ValuePair& pair) {
  const Box3 &a = pair.first->header().box, &b = pair.second->header().box;
  Box3 place;
  for (std::size_t axis = 0; axis < 3; ++axis)
    place.min[axis] = place.max[axis] = std::max(a.min[axis], b.min[axis]) / 2 + std::min(a.max[axis], b.max[axis]) / 2;
  return place;
}

/// True if it is worth a look at the box of `small` and the geometry of `large` before `small` is loaded.
bool is_much_smaller(const Value& small, const Value& large) {
  constexpr std::uint64_t kRatio = 8;
  return small.is_deferred() && small.header().size <= large.header().size / kRatio;
}

std::uint64_t code_in(const Box3& frame, const Vec3& point) {
  constexpr double kCells = 1U << algebra3d::kMortonBits;
  std::array<std::uint32_t, 3> cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = frame.max[axis] / 2 - frame.min[axis] / 2;
    const double position = size > 0 ? (point[axis] / 2 - frame.min[axis] / 2) / size : 0;
    cell[axis] = static_cast<std::uint32_t>(std::clamp(position * kCells, 0.0, kCells - 1));
  }
  return algebra3d::morton_code(cell[0], cell[1], cell[2]);
}

Result<LoadedSet> loaded_set(const Value& value, const Monitor& monitor) {
  A3D_ASSIGN(Value loaded, value.loaded());
  A3D_ASSIGN(algebra3d::SpatialSet set, algebra3d::set_of_value(loaded, monitor));
  return LoadedSet{std::move(loaded), std::move(set)};
}

}  // namespace

std::vector<std::uint32_t> morton_order(std::span<const Box3> boxes) {
  Box3 frame;
  for (const Box3& box : boxes) frame.extend(middle(box));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> codes(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) codes[i] = {code_in(frame, middle(boxes[i])), i};
  std::ranges::sort(codes);
  std::vector<std::uint32_t> order(boxes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = codes[i].second;
  return order;
}

/// The different values of all pairs.
struct SpatialPairs::Batches {
  explicit Batches(std::span<const ValuePair> pairs) {
    std::unordered_map<const Value*, std::uint32_t> known;
    const auto number = [&](const Value* value) {
      const auto [place, is_new] = known.try_emplace(value, static_cast<std::uint32_t>(values.size()));
      if (is_new) values.push_back(value);
      return place->second;
    };
    numbers.reserve(pairs.size());
    for (const ValuePair& pair : pairs) numbers.emplace_back(number(pair.first), number(pair.second));
    sets.resize(values.size());
    last_batch.resize(values.size());
  }

  /// Takes the memory that a pair needs beyond that of its batch; false if there is not enough.
  bool take(std::uint32_t pair, std::uint32_t batch, algebra3d::MemoryAccount& account) const {
    const auto [a, b] = numbers[pair];
    std::size_t bytes = last_batch[a] == batch ? 0 : loaded_bytes(*values[a]);
    if (a != b && last_batch[b] != batch) bytes += loaded_bytes(*values[b]);
    return account.take(bytes);
  }
  /// Forgets what is loaded and the batch does not need.
  void unload_all_but(std::uint32_t batch) {
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (last_batch[i] != batch) sets[i].reset();
  }

  std::vector<const Value*> values;
  std::vector<std::optional<LoadedSet>> sets;                    ///< of the values that are loaded
  std::vector<std::uint32_t> last_batch;                         ///< that needs the value; they count from 1
  std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers;  ///< of each pair, in `values`
};

// Also where all geometry fits: neighbours on the curve have values in common, which are then in the processor's cache.
Status SpatialPairs::ask(std::span<const ValuePair> pairs, const std::string& progress, const Question& question) {
  if (pairs.empty()) return {};
  std::vector<Box3> boxes;
  boxes.reserve(pairs.size());
  for (const ValuePair& pair : pairs) boxes.push_back(place_of(pair));
  const std::vector<std::uint32_t> order = morton_order(boxes);
  Batches all(pairs);
  std::uint32_t batch = 0;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    ++batch;
    account_.clear();
    while (end < order.size() && (all.take(order[end], batch, account_) || end == begin)) {
      const auto [a, b] = all.numbers[order[end++]];
      all.last_batch[a] = all.last_batch[b] = batch;
    }
    all.unload_all_but(batch);
    const auto part = std::span<const std::uint32_t>(order).subspan(begin, end - begin);
    A3D_TRY(load(all, part));
    A3D_TRY(ask_batch(all, part, progress, question));
  }
  account_.clear();
  return {};
}

Status SpatialPairs::ask_boxes(std::span<const ValuePair> pairs, const std::string& progress,
                               const BoxQuestion& question) {
  struct BoxedPair {
    std::size_t pair;
    bool is_box_of_first;
  };
  std::vector<ValuePair> larger;  // the larger value twice
  std::vector<BoxedPair> boxed;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [a, b] = pairs[i];
    const bool is_box_of_first = is_much_smaller(*a, *b);
    if (!is_box_of_first && !is_much_smaller(*b, *a)) continue;
    const Value* const large = is_box_of_first ? b : a;
    larger.push_back({large, large});
    boxed.push_back({i, is_box_of_first});
  }
  return ask(larger, progress, [&](std::size_t i, const LoadedSet& large, const LoadedSet&, const Monitor&) -> Status {
    const auto [pair, is_box_of_first] = boxed[i];
    const Value& small = is_box_of_first ? *pairs[pair].first : *pairs[pair].second;
    question(pair, small.header().box, is_box_of_first, large);
    return {};
  });
}

/// Loads what these pairs need and is not loaded.
Status SpatialPairs::load(Batches& all, std::span<const std::uint32_t> pairs) {
  std::vector<std::uint32_t> missing;
  std::vector<bool> is_listed(all.values.size());
  for (const std::uint32_t pair : pairs)
    for (const std::uint32_t number : {all.numbers[pair].first, all.numbers[pair].second}) {
      if (!all.sets[number] && !is_listed[number]) missing.push_back(number);
      is_listed[number] = true;
    }
  const Monitor monitor = context_.monitor().silent();
  std::vector<Status> statuses(missing.size());
  algebra3d::parallel_for(missing.size(), 4, [&](std::size_t i) {
    if (monitor.is_cancelled()) return;
    Result<LoadedSet> set = loaded_set(*all.values[missing[i]], monitor);
    if (set)
      all.sets[missing[i]] = std::move(set).value();
    else
      statuses[i] = std::move(set).error();
  });
  load_count_ += missing.size();
  A3D_TRY(context_.check_cancelled());
  for (Status& status : statuses) A3D_TRY(std::move(status));
  return {};
}

Status SpatialPairs::ask_batch(const Batches& all, std::span<const std::uint32_t> pairs, const std::string& progress,
                               const Question& question) const {
  // Many pairs are mostly small ones; of few each may be worth a thread.
  const std::size_t chunk = pairs.size() >= 1024 ? 16 : 1;
  const std::size_t chunk_count = (pairs.size() + chunk - 1) / chunk;
  const Monitor silent = context_.monitor().silent();
  std::vector<Status> statuses(chunk_count);  // of the first pair of each that failed
  const algebra3d::Stage stage(context_.monitor(), progress, chunk_count);
  algebra3d::parallel_for(chunk_count, 1, [&](std::size_t i) {
    algebra3d::Stage own = stage;
    if (!own.begin_step() || silent.is_cancelled()) return;
    for (std::size_t k = i * chunk; k < std::min((i + 1) * chunk, pairs.size()) && statuses[i].ok(); ++k) {
      const auto [a, b] = all.numbers[pairs[k]];
      statuses[i] = question(pairs[k], *all.sets[a], *all.sets[b], silent);
    }
  });
  A3D_TRY(context_.check_cancelled());
  for (Status& status : statuses) A3D_TRY(std::move(status));
  return {};
}

}  // namespace queries
