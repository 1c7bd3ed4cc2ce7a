#pragma once

#include "algebra3d/kernel/arrangement/detail/linking.h"
#include "algebra3d/kernel/arrangement/detail/point_location.h"

namespace algebra3d::arrangement {

/// Front windings at single places, for operands that are closed only together: no face says on which side of its
/// operand the inside is, so all windings come from the cell above a point (faces_above.h). The cell above an edge lies
/// beside one half-plane there; from this to the half-plane that is asked for the difference is known from `linked`, in
/// which linking has united both. Exact. Cost of each: an upward ray through all operands.
class SeedFromAbove {
 public:
  SeedFromAbove(const Subdivision& subdivision, const WindingJumps& jumps, PointLocation& location,
                LinkedWindings& linked)
      : subdivision_(subdivision), jumps_(jumps), location_(location), linked_(linked) {}

  /// The front winding at the half-plane of the seed.
  WindingVector at_place(const SeedPlace& seed);
  /// The front winding of the patch.
  WindingVector at_patch(PatchId patch);

 private:
  const Subdivision& subdivision_;
  const WindingJumps& jumps_;
  PointLocation& location_;
  LinkedWindings& linked_;
};

/// The exact centre of a face.
ExactPoint centroid(const Operands& operands, InputFaceId face);

}  // namespace algebra3d::arrangement
