#include "queries/streams/detail/adjacent_groups.h"

namespace queries {

Status AdjacentGroups::advance() {
  ALGEBRA3D_ASSIGN_OR_RETURN(pending_, tuples_->next());
  if (pending_ == nullptr) return {};
  ALGEBRA3D_ASSIGN_OR_RETURN(pending_keys_, loaded_keys(*pending_, keys_));
  return {};
}

Result<std::optional<AdjacentGroups::Group>> AdjacentGroups::next(const Context& context) {
  if (!has_begun_) ALGEBRA3D_RETURN_IF_ERROR(advance());
  has_begun_ = true;
  if (pending_ == nullptr) return std::optional<Group>();
  Group group(pending_keys_, context);
  while (pending_ != nullptr && compare_keys(pending_keys_, group.keys) == 0) {
    ALGEBRA3D_RETURN_IF_ERROR(group.tuples.add(std::move(pending_)));
    if (group.tuples.size() % 1024 == 0) ALGEBRA3D_RETURN_IF_ERROR(context.check_cancelled());
    ALGEBRA3D_RETURN_IF_ERROR(advance());
  }
  return std::optional(std::move(group));
}

}  // namespace queries
