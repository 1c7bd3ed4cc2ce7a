#include "algebra3d/distance/detail/near_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/distance/detail/separation.h"

namespace algebra3d::distances {
namespace {

/// A search for the face of a set that is nearest to a place, in rounded numbers.
class NearFace {
 public:
  NearFace(const DistanceOperand& set, const Vec3& place, const RoundedDistances& rounded)
      : set_(set),
        slabs_(slabs_if_large(set)),
        place_(place),
        in_frame_(set.hierarchy->frame().place_of(place)),
        rounded_(rounded) {}

  /// Takes a face into account. Returns the smallest distance so far.
  double visit(FaceId face) {
    if (is_far(face)) return distance;
    const DistanceBounds bounds =
        rounded_.bounds(Simplex::of_point(PointRef(place_)), Simplex::of_face(*set_.mesh, face));
    if (bounds.upper < distance) {
      distance = bounds.upper;
      direction = bounds.direction;
      nearest = face;
    }
    return distance;
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

  /// Goes on with a search that found a face at some distance before, if it is finite.
  void run(double before) {
    distance = before;
    set_.hierarchy->for_each_near(
        Box3::of(place_), distance, [this](BoxHierarchy::Node node) { return gap(node); },
        [this](std::uint32_t face) { return visit(FaceId(face)); });
  }

  FaceId nearest;  ///< invalid if none is nearer than before
  double distance = std::numeric_limits<double>::infinity();
  Vec3 direction;  ///< from the place to the face

 private:
  /// Along the direction to the nearest one so far.
  bool is_far(FaceId face) const {
    return std::ranges::all_of(set_.mesh->triangle(face), [this](std::uint32_t corner) {
      return dot(direction, set_.mesh->points().approx()[corner] - place_) > distance;
    });
  }

  const DistanceOperand& set_;
  const NodeSlabs* slabs_;  // null for small sets
  Vec3 place_, in_frame_;
  const RoundedDistances& rounded_;
};

}  // namespace

std::optional<std::pair<FaceId, FaceId>> near_pair(const DistanceOperand& a, const DistanceOperand& b,
                                                   const RoundedDistances& rounded) {
  constexpr int kRounds = 6;
  constexpr double kMuch = 0.999;
  const Box3 box = b.hierarchy->bounds();
  Vec3 place = 0.5 * box.min + 0.5 * box.max;
  std::pair<FaceId, FaceId> pair;
  double distance = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const bool is_first = round % 2 == 0;
    NearFace search(is_first ? a : b, place, rounded);
    search.run(round == 0 ? distance : distance * kMuch);
    if (!search.nearest.is_valid()) break;
    (is_first ? pair.first : pair.second) = search.nearest;
    if (round > 0) distance = search.distance;
    place = place + search.distance * search.direction;
  }
  if (!pair.second.is_valid()) return std::nullopt;
  return pair;
}

}  // namespace algebra3d::distances
