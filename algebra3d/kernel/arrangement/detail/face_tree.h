#pragma once

#include <optional>

#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"

namespace algebra3d::arrangement {

/// A tree of the boxes of all faces of all operands, made when it is first asked for.
class FaceTree {
 public:
  explicit FaceTree(const Operands& operands) : operands_(operands) {}

  /// The tree. Cost of the first call: n log n in all faces.
  const IdTree<InputFaceId>& get();

 private:
  const Operands& operands_;
  std::optional<IdTree<InputFaceId>> tree_;
};

}  // namespace algebra3d::arrangement
