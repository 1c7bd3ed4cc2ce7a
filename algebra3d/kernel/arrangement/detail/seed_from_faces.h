#pragma once

#include <vector>

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/point_location.h"

namespace algebra3d::arrangement {

/// Front windings at single places, for operands of which each is closed alone: an operand that has a face there is
/// known from that face (in front of it is outside), every other one from an upward ray. Exact.
class SeedFromFaces {
 public:
  SeedFromFaces(const Subdivision& subdivision, const WindingJumps& jumps, PointLocation& location)
      : subdivision_(subdivision), jumps_(jumps), location_(location) {}

  /// The front winding at the half-plane of the seed. Cost: an upward ray for each operand near to the edge that has no
  /// face there.
  WindingVector at_place(const SeedPlace& seed);
  /// The front winding of the patch. Cost: an upward ray for each other operand near to it.
  WindingVector at_patch(PatchId patch);

 private:
  std::vector<SubEdgeSide> half_planes_after(const SeedPlace& seed) const;
  std::vector<OperandId> add_operands_with_faces(std::span<const SubEdgeSide> around, WindingVector& windings) const;
  void add_others(const PointRef& point, const std::vector<OperandId>& known, WindingVector& windings);

  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  PointLocation& location_;
};

}  // namespace algebra3d::arrangement
