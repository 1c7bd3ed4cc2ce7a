#pragma once

#include <span>

#include "algebra3d/kernel/arrangement/detail/facets.h"

namespace algebra3d::arrangement {

/// The exact coefficients of planes, per PlaneId, computed when they are asked for. From stage 4 on all stages take
/// them from here; stages 2 and 3, which have faces and no PlaneIds yet, use PlanesOfFaces, whose results come along as
/// Plane::coefficients.
class PlaneCoefficients {
 public:
  PlaneCoefficients() = default;
  explicit PlaneCoefficients(const Facets& facets);

  /// The coefficients of a plane. `facets` must be those given to the constructor. Cost: a few products of integers at
  /// the first call for a plane.
  const IntegerPlane& get(const Facets& facets, PlaneId plane);
  /// Computes the coefficients of many planes at once, each listed once, in parallel if they are very many; `get` then
  /// finds them.
  void compute(const Facets& facets, std::span<const PlaneId> planes);
  /// Like `get`, but computes unknown coefficients without caching them. For stage 9, where the complex is constant.
  IntegerPlane find_or_compute(const Facets& facets, PlaneId plane) const;

 private:
  IdVector<PlaneId, IntegerPlane> known_;  // null: not asked for yet
};

}  // namespace algebra3d::arrangement
