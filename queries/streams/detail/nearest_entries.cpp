#include "queries/streams/detail/nearest_entries.h"

#include <utility>

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
    ALGEBRA3D_ASSIGN_OR_RETURN(tree_, index_->tree());
  }
  auto found = reading_tree(step);
  if (!found) {
    ALGEBRA3D_ASSIGN_OR_RETURN(auto tree, index_->tree_after(found.error()));
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

}  // namespace queries
