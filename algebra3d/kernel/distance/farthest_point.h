#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// A search for the point of one set of triangles that is farthest from another one. Neither may be empty.
struct FarthestSearch {
  DistanceOperand from, to;
};

/// The farthest point that was found, and how far others can be at most.
struct FarthestPoint {
  ExactPoint point;           ///< of `from`, or within some roundings of its largest coordinate
  FaceId nearest;             ///< the face of `to` that is nearest to it
  Rational squared_distance;  ///< of this point; exact
  std::size_t search = 0;     ///< index of the search that found it
  double upper_bound = 0;     ///< no point is farther
  bool is_bounded = true;     ///< false if the search ended before the upper bound was as near as it should be
};

/// The farthest point of all searches; nothing if there are none. Its distance is that of a vertex wherever a vertex is
/// farthest, but for the bound. The upper bound exceeds the distance by no more than a billionth and 2^-44 of the
/// largest coordinate, or else by the gap that is left after 2^22 parts of triangles for each search; where no point
/// was found that is farther than 2^-16 of the largest coordinate, by the gap that is left after work in proportion to
/// the number of triangles. Deterministic; the distance does not depend on the order of the searches. Errors:
/// interrupted. Cost: a search in the hierarchy for each vertex that may be farthest, and some microseconds for each
/// triangle, or triangle of the other set near it, unless it is not farther than the farthest vertex from one triangle;
/// both in parallel. Then a search for those whose bounds are not tight: few where the sets are nearly parallel; where
/// they nearly coincide, at most some 100 microseconds for each triangle of both. Sources: [tang2009] for the bounds of
/// a triangle's distance by that of its corners from one triangle; [guthe2005] for the search, best bounds first.
Result<std::optional<FarthestPoint>> farthest_point(std::span<const FarthestSearch> searches,
                                                    const Monitor& monitor = {});

}  // namespace algebra3d
