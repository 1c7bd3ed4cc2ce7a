#include "algebra3d/kernel/arrangement/detail/propagating.h"

#include <algorithm>

namespace algebra3d::arrangement {

Classification propagate_windings(const Subdivision& subdivision, LinkedWindings& linked, const SetWindings& known) {
  // One more, of zeros, for sides that no facet covers.
  const FrontWindingId of_uncovered(linked.ids.count());
  IdVector<FrontWindingId, WindingVector> fronts(linked.ids.count() + 1);
  for (const FrontWindingId front : IdRange(FrontWindingId(0), of_uncovered)) {
    const auto [set, difference] = linked.sets.find(front);
    if (const auto found = known.find(set); found != known.end()) fronts[front] = found->second + difference;
  }
  Classification result;
  result.at_sides = CompactWindings<SubEdgeSide>(subdivision.sub_edges.sides().size());
  for (const SubEdgeSide side : subdivision.sub_edges.sides())
    result.at_sides.set(side, fronts[std::min(linked.ids.of(side), of_uncovered)]);
  result.at_patches.reserve(subdivision.patches.patches.size());
  for (const PatchId patch : subdivision.patches.ids()) result.at_patches.push_back(fronts[linked.ids.of(patch)]);
  return result;
}

}  // namespace algebra3d::arrangement
