#pragma once

#include <cstdint>
#include <memory>

#include "algebra3d/arrangement/operands.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {

/// A tree of the boxes of all faces of all operands, made when it is first asked for.
class FaceTree {
 public:
  explicit FaceTree(const Operands& operands) : operands_(operands) {}

  const rtree::RTree<std::uint32_t>& get();

 private:
  const Operands& operands_;
  std::unique_ptr<rtree::RTree<std::uint32_t>> tree_;
};

}  // namespace algebra3d::arrangement
