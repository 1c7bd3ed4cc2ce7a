#pragma once

#include <cstddef>

#include "algebra3d/arrangement/detail/ids.h"

namespace algebra3d::arrangement {

/// A front winding: the winding number vector of the cell in front of a sub-facet, by the front of its plane, or in
/// front of a patch, by the front of its faces.
using FrontWindingId = StrongId<struct FrontWindingTag>;

/// The numbering of all front windings: those at the sides of sub-edges come first (each is that of the sub-facet
/// there, so a sub-facet has several), then those of patches.
class FrontWindingIds {
 public:
  FrontWindingIds(std::size_t side_count, std::size_t patch_count)
      : side_count_(side_count), patch_count_(patch_count) {}

  std::size_t count() const { return side_count_ + patch_count_; }
  static FrontWindingId of(SubEdgeSide side) { return FrontWindingId(side.index()); }
  FrontWindingId of(PatchId patch) const { return FrontWindingId(side_count_ + patch.index()); }

 private:
  std::size_t side_count_, patch_count_;
};

}  // namespace algebra3d::arrangement
