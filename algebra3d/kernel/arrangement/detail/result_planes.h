#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/taken_runs.h"
#include "algebra3d/kernel/halfedge/face_planes.h"

namespace algebra3d::arrangement {

/// Collects the planes that a result keeps: those that faces of operands bring along, and those of regions with corners
/// that are not doubles.
class ResultPlanes {
 public:
  explicit ResultPlanes(const Subdivision& subdivision)
      : subdivision_(subdivision), numbers_(subdivision.operands.count()) {}

  /// Adds the planes that the operand keeps of the faces of the run.
  void take(const TakenRun& run);
  /// The faces of the result in the range lie in the plane.
  void add(IdRange<FaceId> faces, PlaneId plane, bool is_flipped);
  FacePlanes take_planes() { return std::move(planes_); }

 private:
  /// The numbers that the planes of an operand have in the result, kUnknown for those not yet taken; empty before the
  /// first one is.
  using NewNumbers = std::vector<std::uint32_t>;

  const Subdivision& subdivision_;
  FacePlanes planes_;
  IdVector<OperandId, std::array<NewNumbers, 2>> numbers_;  // of planes as they are, and flipped
};

}  // namespace algebra3d::arrangement
