#include "algebra3d/arrangement/clean_edges.h"

#include <algorithm>
#include <utility>

namespace algebra3d::arrangement {

std::vector<CleanEdge> clean_edges(const Skeleton& skeleton, const Patches& patches) {
  std::vector<CleanEdge> result;
  std::vector<std::uint32_t> along;
  for (std::uint32_t s = 0; s < skeleton.segments().size(); ++s) {
    const Segment& segment = skeleton.segments()[s];
    if (segment.edge == kNone) continue;
    skeleton.operands().halfedges_along(segment.edge, along);
    if (std::ranges::any_of(along, [&](std::uint32_t h) { return patches.of_face[h / 3] != kNone; }))
      result.push_back({s, along});
  }
  return result;
}

}  // namespace algebra3d::arrangement
