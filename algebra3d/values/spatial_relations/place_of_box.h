#pragma once

#include "algebra3d/values/spatial_relations/relation.h"

namespace algebra3d {

/// Where a box lies relative to a set, as far as the box hierarchy of the set shows it. So it holds for all sets in the
/// box, without a look at them.
struct PlaceOfBox {
  /// A lower bound of the distance between the box and the boundary of the set, in coordinate units; infinite if it is
  /// certainly more than the reach that was asked for.
  double gap = 0;
  /// The box is in the interior of the set: a solid. False if the box may meet the boundary.
  bool is_inside = false;
};

/// The place of a box, which is not empty, relative to a surface or a solid; unknown (gap 0) relative to boxes and
/// points. Its statements are exact. Cost: that of a window in the hierarchy as large as the box and `reach` around it,
/// and for a solid whose boundary is apart that of place_in_solid.
PlaceOfBox place_of_box(const Box3& box, const SpatialSet& set, double reach);

}  // namespace algebra3d
