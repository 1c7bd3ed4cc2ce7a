#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algebra3d/arrangement/skeleton.h"
#include "algebra3d/halfedge/face_planes.h"

namespace algebra3d::arrangement {

/// Collects the planes that a result keeps: those that faces of operands bring along, and those of regions that have
/// corners that are no doubles.
class OutcomePlanes {
 public:
  explicit OutcomePlanes(const Skeleton& skeleton);

  /// A face of the result is this one of an operand, or this one turned over.
  void take(std::uint32_t face, std::uint32_t operand, FaceId taken, bool is_flipped) {
    const FacePlanes& known = skeleton_.operands().mesh(operand).planes();
    const std::uint32_t number = known.number(taken.index());
    if (number != FacePlanes::kUnknown) planes_.set(face, new_number(operand, number, is_flipped));
  }
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
