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
  error_ = 0x1p-45 * size;
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
    return dot(direction, way) - gaps.first_.slabs->reach(first, first_place, direction) -
           gaps.second_.factor * gaps.second_.slabs->reach(second, second_place, -1 * direction);
  }
};

/// Asks now and then.
bool SlabGaps::has_slabs() {
  constexpr std::size_t kWhile = 256;
  if (second_.slabs != nullptr) return true;
  if (!is_usable_ || ++steps_ % kWhile != 0) return false;
  first_.slabs = first_.hierarchy.slabs_after(kWhile, first_.mesh);
  if (first_.slabs != nullptr) second_.slabs = second_.hierarchy.slabs_after(kWhile, second_.mesh);
  return second_.slabs != nullptr;
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
  return tells_apart(first_.slabs->normal(first)) || tells_apart(second_.slabs->normal(second));
}

}  // namespace algebra3d
