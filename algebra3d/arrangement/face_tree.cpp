#include "algebra3d/arrangement/face_tree.h"

#include <vector>

#include "algebra3d/halfedge/boxes.h"

namespace algebra3d::arrangement {

const rtree::RTree<std::uint32_t>& FaceTree::get() {
  if (!tree_) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    entries.reserve(operands_.face_count());
    for (std::uint32_t f = 0; f < operands_.face_count(); ++f)
      entries.push_back({box_of_triangle(operands_.corners(f)), f});
    tree_ = std::make_unique<rtree::RTree<std::uint32_t>>(rtree::RTree<std::uint32_t>::bulk_load(entries));
  }
  return *tree_;
}

}  // namespace algebra3d::arrangement
