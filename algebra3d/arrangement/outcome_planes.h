#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algebra3d/arrangement/skeleton.h"
#include "algebra3d/halfedge/face_planes.h"

namespace algebra3d::arrangement {

/// Faces of an operand that stand one after the other and become faces of the result that do so too.
struct TakenRun {
  std::uint32_t operand;
  std::uint32_t first;      ///< of the operand
  std::uint32_t new_first;  ///< of the result
  std::uint32_t count;
  bool is_flipped;  ///< they are turned over
};

/// Collects the planes that a result keeps: those that faces of operands bring along, and those of regions that have
/// corners that are no doubles.
class OutcomePlanes {
 public:
  explicit OutcomePlanes(const Skeleton& skeleton);

  /// What the operand knows of the planes of its faces.
  void take(const TakenRun& run);
  /// Faces of the result from the first one on, up to the last one and without that, lie in the plane.
  void add(std::uint32_t first, std::uint32_t last, std::uint32_t plane, bool is_flipped);
  FacePlanes take_planes() { return std::move(planes_); }

 private:
  std::uint32_t new_number(std::uint32_t operand, std::uint32_t given, bool is_flipped);

  const Skeleton& skeleton_;
  FacePlanes planes_;
  /// Per operand: the new numbers of its planes, as they are and turned over; kUnknown before they are needed.
  std::vector<std::vector<std::array<std::uint32_t, 2>>> numbers_;
};

}  // namespace algebra3d::arrangement
