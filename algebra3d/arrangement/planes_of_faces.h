#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "algebra3d/arrangement/operands.h"
#include "algebra3d/exact/integer_plane.h"

namespace algebra3d::arrangement {

/// The planes of the operands' faces, each made when it is asked for, unless its mesh knows it.
class PlanesOfFaces {
 public:
  explicit PlanesOfFaces(const Operands& operands) : operands_(operands) {}

  const IntegerPlane& get(std::uint32_t face);
  /// Null if nobody has asked for it, and its mesh does not know it.
  const IntegerPlane* find(std::uint32_t face) const;

 private:
  const Operands& operands_;
  std::vector<std::uint32_t> numbers_;  // per face: in `made_`; empty before the first is made
  std::deque<IntegerPlane> made_;
};

}  // namespace algebra3d::arrangement
