#include "algebra3d/kernel/exact/point_table.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "base/shrink.h"

namespace algebra3d {
namespace {

constexpr std::size_t kFewestSlots = 64;

}  // namespace

bool PointTable::are_equal(const ExactCoordinates* a, const ExactCoordinates* b) {
  return a != nullptr && b != nullptr && *a == *b;
}

void PointTable::finish() {
  std::vector<Slot>().swap(slots_);
  shrink(approx_);
  shrink(exact_);
}

// Points are inserted anew in their order: the table depends on the points alone, not on its history.
void PointTable::grow() {
  slots_.assign(std::max({2 * slots_.size(), kFewestSlots, std::bit_ceil(2 * approx_.size())}), Slot());
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t number = 0; number < approx_.size(); ++number) {
    const std::uint64_t hash = hash_of(approx_[number]);
    std::size_t i = hash & mask;
    while (slots_[i].number != kNone) i = (i + 1) & mask;
    slots_[i] = {tag_of(hash), number};
  }
}

}  // namespace algebra3d
