#pragma once

#include <cstddef>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/ids.h"
#include "base/id_vector.h"

namespace algebra3d::arrangement {

/// A front winding: the winding number vector of the cell in front of a sub-facet, by the front of its plane, or in
/// front of a patch, by the front of its faces.
using FrontWindingId = StrongId<struct FrontWindingTag>;

/// The numbering of all front windings: those of sub-facets come first, one for each closed chain of sides round a
/// sub-facet (sub_facets.h; a sub-facet with holes has several), then those of patches.
class FrontWindingIds {
 public:
  FrontWindingIds() = default;
  /// `of_sides`: the chain of each side, numbered from 0; none if no facet covers the side.
  FrontWindingIds(IdVector<SubEdgeSide, FrontWindingId> of_sides, std::size_t chain_count, std::size_t patch_count)
      : of_sides_(std::move(of_sides)), chain_count_(chain_count), patch_count_(patch_count) {}

  std::size_t count() const { return chain_count_ + patch_count_; }
  /// None if no facet covers the side.
  FrontWindingId of(SubEdgeSide side) const { return of_sides_[side]; }
  FrontWindingId of(PatchId patch) const { return FrontWindingId(chain_count_ + patch.index()); }

 private:
  IdVector<SubEdgeSide, FrontWindingId> of_sides_;
  std::size_t chain_count_ = 0, patch_count_ = 0;
};

}  // namespace algebra3d::arrangement
