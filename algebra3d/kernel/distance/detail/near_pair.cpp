#include "algebra3d/kernel/distance/detail/near_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/kernel/distance/detail/separation.h"

namespace algebra3d::distances {
namespace {

/// A face of a set, and the way to it from a place; no valid face if none was found.
struct NearFace {
  FaceId face;
  double distance;
  Vec3 direction;
};

/// A search for the face of a set that is nearest to a place, in rounded numbers.
class NearFaceSearch {
 public:
  NearFaceSearch(const DistanceOperand& set, const Vec3& place, const RoundedDistances& rounded)
      : set_(set),
        slabs_(slabs_if_large(set)),
        place_(place),
        in_frame_(set.hierarchy->frame().place_of(place)),
        rounded_(rounded) {}

  /// Finds a face only if it is nearer than `before`.
  NearFace run(double before) {
    best_.distance = before;
    set_.hierarchy->for_each_near(
        Box3::of(place_), before, [this](BoxHierarchy::Node node) { return gap(node); },
        [this](std::uint32_t face) { return visit(FaceId(face)); });
    return best_;
  }

 private:
  /// Returns the smallest distance so far.
  double visit(FaceId face) {
    if (is_far(face)) return best_.distance;
    const DistanceBounds bounds =
        rounded_.bounds(Simplex::of_point(PointRef(place_)), Simplex::of_face(*set_.mesh, face));
    if (bounds.upper < best_.distance) best_ = {face, bounds.upper, bounds.direction};
    return best_.distance;
  }

  /// Along the direction to the nearest one so far.
  bool is_far(FaceId face) const {
    return std::ranges::all_of(set_.mesh->triangle(face), [this](std::uint32_t corner) {
      return dot(best_.direction, set_.mesh->points().approx()[corner] - place_) > best_.distance;
    });
  }

  /// How far the place is from a node, along the line to the middle of its box.
  double gap(BoxHierarchy::Node node) const {
    if (slabs_ == nullptr) return 0;
    const BoxHierarchy::Place box = set_.hierarchy->place(node);
    const Vec3 way = in_frame_ - box.middle;
    const double length = std::sqrt(dot(way, way));
    if (length == 0) return 0;
    return (length - slabs_->reach(node, box, (1 / length) * way)) * 2 / set_.hierarchy->frame().scale;
  }

  const DistanceOperand& set_;
  const NodeSlabs* slabs_;  // null for small sets
  Vec3 place_, in_frame_;
  const RoundedDistances& rounded_;
  NearFace best_{};
};

}  // namespace

std::optional<std::pair<FaceId, FaceId>> near_pair(const DistanceOperand& a, const DistanceOperand& b, Vec3 place,
                                                   const RoundedDistances& rounded) {
  constexpr int kRounds = 6;
  constexpr double kMuch = 0.999;
  std::pair<FaceId, FaceId> pair;
  double way = std::numeric_limits<double>::infinity();  // between the faces of the pair
  for (int round = 0; round < kRounds; ++round) {
    const bool is_first = round % 2 == 0;
    const NearFace found = NearFaceSearch(is_first ? a : b, place, rounded).run(kMuch * way);
    if (!found.face.is_valid()) break;
    (is_first ? pair.first : pair.second) = found.face;
    if (round > 0) way = found.distance;
    place = place + found.distance * found.direction;
  }
  if (!pair.second.is_valid()) return std::nullopt;
  return pair;
}

}  // namespace algebra3d::distances
