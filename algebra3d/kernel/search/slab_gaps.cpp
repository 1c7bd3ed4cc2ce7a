#include "algebra3d/kernel/search/slab_gaps.h"

#include <algorithm>
#include <cmath>

#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d {

// Lengths are in units of the first frame. Corners are rounded to some 2^-51 of the largest coordinate, and products
// have a few more roundings of numbers up to it.
SlabGaps::SlabGaps(const TriangleMesh& first, const BoxHierarchy& of_first, const TriangleMesh& second,
                   const BoxHierarchy& of_second)
    : first_{first, of_first, 1, {}},
      second_{second, of_second, of_first.frame().scale / of_second.frame().scale,
              of_first.frame().place_of(of_second.frame().origin)},
      unit_(2 / of_first.frame().scale) {
  const Box3 box = unite(of_first.bounds(), of_second.bounds());
  const double size = std::max(detail::largest(box.min), detail::largest(box.max)) / 2 * of_first.frame().scale;
  error_ = 0x1p-45 * size + 0x1p-70;  // of subnormal coordinates
  constexpr double kFar = 0x1p100;
  is_usable_ = second_.factor > 1 / kFar && second_.factor < kFar && size < kFar;
}

/// Two nodes whose boxes are in one frame.
struct SlabGaps::Pair {
  const SlabGaps& gaps;
  BoxHierarchy::Node first, second;
  BoxHierarchy::Place first_place, second_place;  // in the frame of each
  Vec3 way;                                       // between the middles

  Pair(const SlabGaps& all, BoxHierarchy::Node m, BoxHierarchy::Node n)
      : gaps(all),
        first(m),
        second(n),
        first_place(all.first_.hierarchy.place(m)),
        second_place(all.second_.hierarchy.place(n)),
        way(all.second_.factor * second_place.middle + all.second_.origin - first_place.middle) {}

  /// From the first node's faces to those of the second, which lie in the direction, of length 1 but for rounding.
  double gap_along(const Vec3& direction) const {
    return dot(direction, way) - reach(gaps.first_, first, first_place, direction) -
           gaps.second_.factor * reach(gaps.second_, second, second_place, -1 * direction);
  }
  static double reach(const Side& side, BoxHierarchy::Node node, const BoxHierarchy::Place& place,
                      const Vec3& direction) {
    const double of_slab = side.slabs->reach(node, place, direction);
    return side.boxes == nullptr ? of_slab : std::min(of_slab, side.boxes->box(node).reach(direction));
  }
};

/// Asks now and then.
bool SlabGaps::has_slabs() {
  constexpr std::size_t kWhile = 256;
  if (second_.slabs != nullptr) return true;
  if (!is_usable_ || ++steps_ % kWhile != 0) return false;
  first_.slabs = first_.hierarchy.slabs_after(kWhile, first_.mesh);
  if (first_.slabs != nullptr) second_.slabs = second_.hierarchy.slabs_after(kWhile, second_.mesh);
  if (second_.slabs == nullptr) return false;
  for (Side* side : {&first_, &second_}) side->boxes = side->hierarchy.oriented_boxes(side->mesh);
  return true;
}

bool SlabGaps::exceed(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) {
  if (!has_slabs()) return false;
  Score& score = scores_[std::max(first.level, second.level)];
  if (!score.is_worth_asking()) return false;
  const bool does_exceed = compare(first, second, distance);
  score.note(does_exceed);
  return does_exceed;
}

bool SlabGaps::compare(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) const {
  const double least = (distance / unit_ + error_) * (1 + 0x1p-20);  // normals are rounded to float
  const Pair pair(*this, first, second);
  const double length = std::sqrt(dot(pair.way, pair.way));
  if (length == 0) return false;
  const Vec3 along = (1 / length) * pair.way;
  if (pair.gap_along(along) > least) return true;
  const auto tells_apart = [&](const Vec3& normal) {
    const Vec3 across = dot(normal, along) < 0 ? -1 * normal : normal;
    if (pair.gap_along(across) > least) return true;
    const Vec3 between = along + across;
    const double size = std::sqrt(dot(between, between));
    return size > 0 && pair.gap_along((1 / size) * between) > least;
  };
  if (tells_apart(first_.slabs->normal(first)) || tells_apart(second_.slabs->normal(second))) return true;
  return (first_.boxes != nullptr || second_.boxes != nullptr) && does_box_tell(pair, along, least);
}

/// Along the axes of the oriented boxes beside the normals, and across both of the edges: needles that pass each other
/// are apart there.
bool SlabGaps::does_box_tell(const Pair& pair, const Vec3& along, double least) const {
  const auto tells_apart = [&](const Vec3& direction) {
    return pair.gap_along(dot(direction, along) < 0 ? -1 * direction : direction) > least;
  };
  const OrientedBoxes::Box* first = first_.boxes == nullptr ? nullptr : &first_.boxes->box(pair.first);
  const OrientedBoxes::Box* second = second_.boxes == nullptr ? nullptr : &second_.boxes->box(pair.second);
  if (first != nullptr && second != nullptr) {
    const Vec3 across = cross(first->axis(OrientedBoxes::kAlong), second->axis(OrientedBoxes::kAlong));
    const double size = std::sqrt(dot(across, across));
    if (size > 0x1p-20 && tells_apart((1 / size) * across)) return true;
  }
  const auto do_axes_tell = [&](const OrientedBoxes::Box& box) {
    return tells_apart(box.axis(OrientedBoxes::kAlong)) || tells_apart(box.axis(OrientedBoxes::kAcross));
  };
  if ((first != nullptr && do_axes_tell(*first)) || (second != nullptr && do_axes_tell(*second))) return true;
  return first != nullptr && second != nullptr && do_fans_tell(pair, least);
}

/// Where the corners of a leaf's faces are along a direction.
SlabGaps::Span SlabGaps::span_of(const Side& side, BoxHierarchy::Node leaf, const Vec3& direction) {
  const std::vector<Vec3>& points = side.mesh.points().approx();
  const BoxHierarchy::Frame& frame = side.hierarchy.frame();
  Span span;
  for (const auto face : side.hierarchy.faces_of(leaf))
    for (const auto corner : side.mesh.triangle(FaceId(face))) {
      const double product = dot(direction, frame.place_of(points[corner]));
      span.low = std::min(span.low, product);
      span.high = std::max(span.high, product);
    }
  const double origin = dot(direction, side.origin);
  return {side.factor * span.low + origin, side.factor * span.high + origin};
}

/// For two leaves, by their corners across the sides of fans: a box around a fan is as wide at its tip as at its other
/// end, and where fans have one tip their boxes meet there.
bool SlabGaps::do_fans_tell(const Pair& pair, double least) const {
  if (pair.first.level > 0 || pair.second.level > 0) return false;
  const OrientedBoxes::Sides& first = first_.boxes->sides(pair.first);
  const OrientedBoxes::Sides& second = second_.boxes->sides(pair.second);
  for (const auto& side : {first.left, first.right})
    for (const auto& other : {second.left, second.right}) {
      const Vec3 across = cross(Vec3{side[0], side[1], side[2]}, Vec3{other[0], other[1], other[2]});
      const double size = std::sqrt(dot(across, across));
      if (!(size > 0x1p-20)) continue;
      const Vec3 direction = (1 / size) * across;
      const Span of_first = span_of(first_, pair.first, direction);
      const Span of_second = span_of(second_, pair.second, direction);
      if (of_second.low - of_first.high > least || of_first.low - of_second.high > least) return true;
    }
  return false;
}

}  // namespace algebra3d
