#include "algebra3d/kernel/arrangement/detail/face_tree.h"

#include "algebra3d/kernel/search/boxes.h"

namespace algebra3d::arrangement {

const IdTree<InputFaceId>& FaceTree::get() {
  if (!tree_) {
    IdTree<InputFaceId>::Boxes boxes;
    boxes.reserve(operands_.face_count());
    for (const InputFaceId face : operands_.faces()) boxes.add(box_of_triangle(operands_.corners(face)), face);
    tree_.emplace(boxes.tree());
  }
  return *tree_;
}

}  // namespace algebra3d::arrangement
