#pragma once

#include <optional>
#include <utility>

#include "algebra3d/kernel/distance/detail/rounded_closest.h"
#include "algebra3d/kernel/distance/distance.h"

namespace algebra3d::distances {

/// Two faces of two sets that are near each other, if not nearest: found by going from a place, as the middle of the
/// second set, to the nearest point of the first one, from there to the second one, and so on, six times at most, or
/// until a way is hardly shorter than the one before. Nothing if distances leave the range of doubles. `rounded` is for
/// both sets. Cost: up to six searches for a nearest face.
std::optional<std::pair<FaceId, FaceId>> near_pair(const DistanceOperand& a, const DistanceOperand& b, Vec3 place,
                                                   const RoundedDistances& rounded);

}  // namespace algebra3d::distances
