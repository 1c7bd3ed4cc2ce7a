#include "rtree/detail/split.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "rtree/detail/box_size.h"

namespace rtree {
namespace {

double common_volume(const Box3& a, const Box3& b) {
  const Box3 common = intersect(a, b);
  return common.is_empty() ? 0 : volume(common);
}

// How an order of the items divides them.
struct Division {
  std::size_t axis = 0;
  bool by_max = false;
  std::size_t first_count = 0;
  double overlap = 0;
  double volume = 0;

  bool is_better_than(const Division& other) const {
    return overlap < other.overlap || (overlap == other.overlap && volume < other.volume);
  }
};

void sort_along(std::span<SplitItem> items, std::size_t axis, bool by_max) {
  std::ranges::sort(items, [=](const SplitItem& a, const SplitItem& b) {
    const double a_keys[2] = {a.box.min[axis], a.box.max[axis]};
    const double b_keys[2] = {b.box.min[axis], b.box.max[axis]};
    if (a_keys[by_max] != b_keys[by_max]) return a_keys[by_max] < b_keys[by_max];
    if (a_keys[!by_max] != b_keys[!by_max]) return a_keys[!by_max] < b_keys[!by_max];
    return a.reference < b.reference;
  });
}

// The sum of the margins of all divisions of sorted items; `best` becomes the best of them.
double judge(std::span<const SplitItem> items, Division& best) {
  const std::size_t count = items.size();
  std::array<Box3, kMaxSplit> tails;
  Box3 tail;
  for (std::size_t i = count; i-- > 0;) {
    tail.extend(items[i].box);
    tails[i] = tail;
  }
  const std::size_t least = std::max(kMinFill, count - std::min(count, kFanOut));
  double margins = 0;
  Box3 head;
  for (std::size_t i = 0; i < count - least; ++i) {
    head.extend(items[i].box);
    Division division = best;
    division.first_count = i + 1;
    if (division.first_count < least) continue;
    const Box3& rest = tails[division.first_count];
    margins += margin(head) + margin(rest);
    division.overlap = common_volume(head, rest);
    division.volume = volume(head) + volume(rest);
    if (best.first_count == 0 || division.is_better_than(best)) best = division;
  }
  return margins;
}

}  // namespace

std::size_t split(std::span<SplitItem> items) {
  assert(items.size() > kFanOut && items.size() <= kMaxSplit);
  Division best;
  double least_margins = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Division divisions[2];
    double margins = 0;
    for (const bool by_max : {false, true}) {
      Division& division = divisions[by_max];
      division.axis = axis;
      division.by_max = by_max;
      sort_along(items, axis, by_max);
      margins += judge(items, division);
    }
    if (axis > 0 && !(margins < least_margins)) continue;
    least_margins = margins;
    best = divisions[1].is_better_than(divisions[0]) ? divisions[1] : divisions[0];
  }
  sort_along(items, best.axis, best.by_max);
  return best.first_count;
}

}  // namespace rtree
