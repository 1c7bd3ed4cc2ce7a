#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/distance/detail/face_part.h"
#include "algebra3d/kernel/distance/detail/large_facets.h"
#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/search/oriented_boxes.h"
#include "base/wide_vec3.h"

namespace algebra3d::distances {

/// The factor from halved coordinates in a box to units, in which the largest one is from 1 to 2: a power of two.
double half_scale_for(const Box3& box);

/// An upper bound of the distance of all points of a face, and the point where it was found.
struct FaceBound {
  double upper = 0;  ///< 0 if nothing is farther than the sufficient distance
  Vec3 where;        ///< of the face, within roundings
  FaceId near;       ///< a face of the set that is near that point, if not nearest
};

/// Upper bounds of the distances of faces from a set of triangles, in rounded arithmetic with guaranteed bounds. A face
/// is divided by the local Voronoi cells of the set: the space over a triangle between the planes that halve the angles
/// at its edges. The distance from one triangle is convex, so the part in a cell has its largest distance from that
/// triangle in a corner. Where the cells hold what is nearest to their triangles, as they do near a manifold set whose
/// angles are flat, the bound is tight. It holds in any case, since any division does. What lies over a large facet of
/// the set is bounded by its plane at once. Has its own storage: one for each thread. Vector: Vec3, or WideVec3 for
/// bounds that are near a small part of the spacing of doubles.
template <typename Vector>
class FaceBounds {
 public:
  /// `facets` are those of the set, by half_scale_for(box); `box` holds both sets. Bounds up to `enough` are not of
  /// interest. Once the work is cancelled, bounds are not found.
  FaceBounds(const TriangleMesh& from, const DistanceOperand& to, const LargeFacets& facets, const Box3& box,
             double enough, const Monitor& monitor = {});

  /// The bound for a face of `from`; `nearest` are faces of the set that are near its corners. After about `max_work`
  /// comparisons of a part with a triangle, the rest of the face is bounded by one triangle. Cost: some points against
  /// some triangles if one of these faces shows that it is enough; else a microsecond for each cell that the face
  /// meets.
  FaceBound of(FaceId face, const std::array<FaceId, 3>& nearest, std::size_t max_work = kNoLimit);
  /// True if a part of a face lies over the large facet of a face of the set, and so near it that its bound is enough.
  /// The corners are those of the part, within 2^-46 of the largest coordinate.
  bool is_over_facet(const std::array<Vec3, 3>& corners, FaceId face) const;
  /// How often a part was compared with a triangle, for all faces so far: a measure of work.
  std::size_t comparison_count() const { return comparison_count_; }

 private:
  static constexpr std::size_t kNoLimit = static_cast<std::size_t>(-1);
  using Number = decltype(Vector::x);
  using Part = FacePart<Vector>;

  /// A triangle by a corner and two edges.
  struct Target {
    FaceId face;
    Vector corner, first_edge, second_edge;
  };
  struct Near {
    FaceId face;
    Number distance;
  };
  /// The corner of a part that is farthest from a triangle, and a bound for the part.
  struct Farthest {
    Number upper, distance;  ///< the distance is that of the corner, rounded
    Vector where;
  };

  Vector scaled(const Vec3& point) const { return Vector(half_scale_ * (0.5 * point)); }
  Vec3 unscaled(const Vector& point) const;
  double unscaled(Number length) const;
  Target target(FaceId face) const;
  Vector unit_normal(FaceId face) const;
  std::array<CellSide<Vector>, 3> cell_of(FaceId face) const;
  static Vector way_from(const Target& target, const Vector& point);
  static Number distance(const Vector& point, const Target& target);
  static Farthest farthest(const Part& part, const Target& target);
  Near walk(const Vector& point, FaceId from) const;
  template <typename IsEnough>
  Near nearest(const Vector& point, FaceId near, IsEnough is_enough);
  FaceId near_of_recent(const Vector& point) const;
  Number irrelevant() const { return best_.upper > enough_ ? best_.upper : enough_; }
  void take(const Farthest& farthest, FaceId near);
  bool gather(const Part& part, Number reach);
  void visit(const Part& part);
  void cover(const Part& part);
  template <typename Nearer>
  void divide(const Part& part, const Target& target, std::vector<Part>& left, Nearer nearer);
  bool is_clearly_nearer(Number distance, const Farthest& bound) const;
  std::optional<Target> clearly_nearer(const Farthest& bound) const;
  std::optional<Target> clearly_nearer_of_all(const Farthest& bound);
  bool divide_between(const Part& part, const Vector& point, const Target& first, const Target& second,
                      std::vector<Part>& left);
  bool lies_over_facet(const Part& part, FaceId face) const;
  void take_least(const Part& part);

  const TriangleMesh& from_;
  DistanceOperand to_;
  const OrientedBoxes* boxes_;  // of `to`; null where those along the axes do
  const LargeFacets& facets_;
  Box3 box_;
  double half_scale_;  // from halved coordinates to units, in which the largest one is from 1 to 2
  Number enough_;      // in units
  Monitor monitor_;
  Vector normal_;  // of the face; of any length, rounded
  Farthest best_{};
  FaceId best_near_, hint_;
  std::array<FaceId, 8> recent_;  // near parts before, of this face and others
  std::size_t recent_count_ = 0;
  std::size_t work_ = 0;  // comparisons for the face
  std::size_t comparison_count_ = 0, renewed_count_ = 0;
  std::vector<Part> waiting_, uncovered_;
  std::vector<Target> candidates_;
};

extern template class FaceBounds<Vec3>;
extern template class FaceBounds<WideVec3>;

}  // namespace algebra3d::distances
