#include "queries/streams/detail/nearest_entries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/propagate.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {

void NearestEntries::search(std::shared_ptr<SpatialIndex::Tree> tree) {
  cursor_.emplace(tree->nearest(box_));
  tree_ = std::move(tree);
}

Result<std::optional<NearestEntries::Neighbor>> NearestEntries::next() {
  const auto step = [&] {
    if (!cursor_) search(tree_);
    return cursor_->next();
  };
  if (tree_ == nullptr) {
    A3D_ASSIGN(tree_, index_->tree());
  }
  auto found = reading_tree(step);
  if (!found) {
    A3D_ASSIGN(auto tree, index_->tree_after(found.error()));
    cursor_.reset();
    found = reading_tree([&] {
      search(std::move(tree));
      for (std::uint64_t passed = 0; passed < count_; ++passed) cursor_->next();
      return cursor_->next();
    });
  }
  if (found && *found) ++count_;
  return found;
}

bool has_box_at(const Value& value, const algebra3d::Box3& from, double distance) {
  constexpr double kRounding = 0x1p-40;
  const algebra3d::Box3 box = window_of(value);
  if (box.is_empty()) return false;
  constexpr double kLargest = std::numeric_limits<double>::max(), kSmallest = std::numeric_limits<double>::min();
  const double told = std::min(distance, kLargest);
  const double found = std::min(algebra3d::distance(box, from), kLargest);
  return std::abs(found - told) <= kRounding * told + kSmallest;
}

}  // namespace queries
