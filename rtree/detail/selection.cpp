#include "rtree/detail/selection.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rtree {
namespace {

constexpr std::size_t kSampleSize = 128;
// Up to this number std::nth_element does the work: a sample would have three keys or fewer. Chosen, not measured.
constexpr std::size_t kSmallCount = 24;

struct Key {
  double center;
  std::uint32_t index;
};

Key key_of(const Seed& seed, std::size_t axis) {
  return {seed.center[axis], seed.index};
}

// Without short cuts, so that no branch depends on the data.
bool is_before(const Key& a, const Key& b) {
  return (a.center < b.center) | ((a.center == b.center) & (a.index < b.index));
}

// Moves the seeds before `pivot` to the front and returns their number. Lomuto's scheme without branches: the two
// halves of random data would mispredict every second one.
std::size_t partition(Seed* seeds, std::size_t count, std::size_t axis, const Key& pivot) {
  std::size_t front = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Seed seed = seeds[i];
    const bool before = is_before(key_of(seed, axis), pivot);
    seeds[i] = seeds[front];
    seeds[front] = seed;
    front += before;
  }
  return front;
}

// A key a little beyond the wanted rank, on the side of the larger part, so that the first pass already takes off
// nearly all of the larger part and the second nearly all of the smaller one.
Key choose_pivot(const Seed* seeds, std::size_t count, std::size_t first_count, std::size_t axis) {
  std::array<Key, kSampleSize> sample;
  const std::size_t size = std::min(kSampleSize, count / 8);
  const std::size_t stride = count / size;
  for (std::size_t i = 0; i < size; ++i) sample[i] = key_of(seeds[i * stride + stride / 2], axis);
  const double rank = static_cast<double>(first_count) / static_cast<double>(count) * static_cast<double>(size);
  const double margin = 0.75 * std::sqrt(static_cast<double>(size)) * (2 * first_count <= count ? 1 : -1);
  const auto chosen = static_cast<std::size_t>(std::clamp(rank + margin, 0.0, static_cast<double>(size - 1)));
  std::nth_element(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(chosen),
                   sample.begin() + static_cast<std::ptrdiff_t>(size), is_before);
  return sample[chosen];
}

}  // namespace

void select_first(Seed* seeds, std::size_t count, std::size_t first_count, std::size_t axis) {
  while (first_count > 0 && first_count < count && count > kSmallCount) {
    const std::size_t front = partition(seeds, count, axis, choose_pivot(seeds, count, first_count, axis));
    if (front >= first_count && front < count) {
      count = front;
    } else if (front <= first_count && front > 0) {
      seeds += front;
      count -= front;
      first_count -= front;
    } else {
      break;  // the pivot is the very first seed: no progress
    }
  }
  if (first_count == 0 || first_count >= count) return;
  std::nth_element(seeds, seeds + first_count, seeds + count,
                   [axis](const Seed& a, const Seed& b) { return is_before(key_of(a, axis), key_of(b, axis)); });
}

}  // namespace rtree
