#include "algebra3d/arrangement/detail/propagating.h"

namespace algebra3d::arrangement {

Classification propagate_windings(const Subdivision& subdivision, LinkedWindings& linked, const SetWindings& known) {
  const auto windings_of = [&](FrontWindingId front) {
    const auto [set, difference] = linked.sets.find(front);
    const auto found = known.find(set);
    return found == known.end() ? WindingVector() : found->second + difference;
  };
  Classification result;
  result.at_sides.reserve(subdivision.sub_edges.sides().size());
  for (const SubEdgeSide side : subdivision.sub_edges.sides())
    result.at_sides.push_back(windings_of(FrontWindingIds::of(side)));
  result.at_patches.reserve(subdivision.patches.patches.size());
  for (const PatchId patch : subdivision.patches.ids()) result.at_patches.push_back(windings_of(linked.ids.of(patch)));
  return result;
}

}  // namespace algebra3d::arrangement
