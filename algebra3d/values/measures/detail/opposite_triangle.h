#pragma once

#include <optional>
#include <vector>

#include "algebra3d/kernel/exact/inward_ray.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// Finds the triangle opposite to another one, that which a ray from its centroid meets first, straight inwards.
/// Rounded arithmetic with bounds finds the few that may be it; pairs of doubles decide. Refers to the solid. A search
/// belongs to one thread.
class OppositeSearch {
 public:
  /// `margin`: that of the solid.
  OppositeSearch(const Geometry& solid, double margin) : solid_(solid), margin_(margin) {}
  /// Above the errors of rounded places: centroids, corners and places are off by some roundings of the largest
  /// coordinate.
  static double margin_of(const Geometry& solid);

  struct Opposite {
    FaceId face;           ///< the lowest of the triangles that the ray meets there
    double thickness = 0;  ///< rounded to nearest
  };
  /// Nothing if pairs of doubles do not decide. Exact. Cost: that of the boxes that the ray meets up to there, some
  /// nanoseconds each, and some microseconds.
  std::optional<Opposite> behind(FaceId face);

 private:
  struct Candidate {
    FaceId face;
    double from = 0, to = 0;  ///< bounds of its place on the ray
  };

  void find_candidates(FaceId face, const InwardRay& ray);
  std::optional<Opposite> first_of_candidates(const InwardRay& ray) const;
  bool meet_in_one_point(FaceId a, const InwardRay::Meeting& of_a, FaceId b, const InwardRay::Meeting& of_b) const;

  const Geometry& solid_;
  double margin_;
  std::vector<Candidate> candidates_;
};

}  // namespace algebra3d
