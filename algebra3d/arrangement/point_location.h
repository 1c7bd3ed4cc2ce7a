#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algebra3d/arrangement/operands.h"
#include "algebra3d/base/box3.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {

/// Tells of single points in which operands they lie. What it needs of an operand is made when it is first asked for.
class PointLocation {
 public:
  explicit PointLocation(const Operands& operands) : operands_(operands), trees_(operands.count()) {}

  /// Winding number of the operand about a point that lies on none of its faces. Exact. Cost: linear in its faces for
  /// the first few points, then that of a vertical line through a tree of their boxes.
  int winding(std::uint32_t operand, const PointRef& point);
  /// Operands whose boxes hold the point; others do not hold it. Ascending.
  std::vector<std::uint32_t> near(const PointRef& point);

 private:
  /// So many points are located without a tree.
  static constexpr std::uint32_t kFewPoints = 4;

  struct Tree {
    std::uint32_t asked = 0;
    std::unique_ptr<rtree::RTree<std::uint32_t>> faces;
  };

  const Operands& operands_;
  std::vector<Tree> trees_;
  std::unique_ptr<rtree::RTree<std::uint32_t>> boxes_;
};

}  // namespace algebra3d::arrangement
