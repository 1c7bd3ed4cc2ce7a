#include "algebra3d/distance/detail/near_pair.h"

#include <limits>

namespace algebra3d::distances {
namespace {

/// The face that seems nearest to a place, and its nearest point, rounded.
struct NearFace {
  FaceId face;
  Vec3 point;
};

std::optional<NearFace> face_near(const Vec3& place, const DistanceOperand& set, const RoundedDistances& rounded) {
  DistanceBounds best;
  best.upper = std::numeric_limits<double>::infinity();
  FaceId nearest;
  set.hierarchy->for_each_near(Box3::of(place), best.upper, [&](std::uint32_t face) {
    const DistanceBounds bounds =
        rounded.bounds(Simplex::of_point(PointRef(place)), Simplex::of_face(*set.mesh, FaceId(face)));
    if (bounds.upper < best.upper) {
      best = bounds;
      nearest = FaceId(face);
    }
    return best.upper;
  });
  if (!nearest.is_valid()) return std::nullopt;
  return NearFace{nearest, place + best.upper * best.direction};
}

}  // namespace

std::optional<std::pair<FaceId, FaceId>> near_pair(const DistanceOperand& a, const DistanceOperand& b,
                                                   const RoundedDistances& rounded) {
  constexpr int kRounds = 3;
  const Box3 box = b.hierarchy->bounds();
  Vec3 place = 0.5 * box.min + 0.5 * box.max;
  std::pair<FaceId, FaceId> pair;
  for (int round = 0; round < kRounds; ++round) {
    const auto first = face_near(place, a, rounded);
    const auto second = first ? face_near(first->point, b, rounded) : std::nullopt;
    if (!second) return std::nullopt;
    pair = {first->face, second->face};
    place = second->point;
  }
  return pair;
}

}  // namespace algebra3d::distances
