#include "algebra3d/arrangement/detail/propagating.h"

namespace algebra3d::arrangement {

Classification propagate_windings(const Subdivision& subdivision, LinkedWindings& linked, const SetWindings& known) {
  IdVector<FrontWindingId, WindingVector> fronts(linked.ids.count());
  for (const FrontWindingId front : fronts.ids()) {
    const auto [set, difference] = linked.sets.find(front);
    if (const auto found = known.find(set); found != known.end()) fronts[front] = found->second + difference;
  }
  Classification result;
  result.at_sides = CompactWindings<SubEdgeSide>(subdivision.sub_edges.sides().size());
  for (const SubEdgeSide side : subdivision.sub_edges.sides()) {
    const FrontWindingId front = linked.ids.of(side);
    if (!front.is_none()) result.at_sides.set(side, fronts[front]);
  }
  result.at_patches.reserve(subdivision.patches.patches.size());
  for (const PatchId patch : subdivision.patches.ids()) result.at_patches.push_back(fronts[linked.ids.of(patch)]);
  return result;
}

}  // namespace algebra3d::arrangement
