#include "queries/streams/detail/adjacent_groups.h"

#include "base/propagate.h"

namespace queries {

Status AdjacentGroups::advance() {
  A3D_ASSIGN(pending_, tuples_->next());
  if (pending_ == nullptr) return {};
  A3D_ASSIGN(pending_keys_, loaded_keys(*pending_, keys_));
  return {};
}

Result<std::optional<AdjacentGroups::Group>> AdjacentGroups::next(const Context& context) {
  if (!has_begun_) A3D_TRY(advance());
  has_begun_ = true;
  if (pending_ == nullptr) return std::optional<Group>();
  Group group(pending_keys_, context);
  while (pending_ != nullptr && compare_keys(pending_keys_, group.keys) == 0) {
    A3D_TRY(group.tuples.add(std::move(pending_)));
    if (group.tuples.size() % 1024 == 0) A3D_TRY(context.check_cancelled());
    A3D_TRY(advance());
  }
  return std::optional(std::move(group));
}

}  // namespace queries
