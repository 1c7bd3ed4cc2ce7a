#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// Oriented boxes around the faces of the nodes of a hierarchy. Long thin triangles beside each other, as of the caps
/// of a slanted prism or of a cone, are in one leaf of the hierarchy, but a box along the axes around them holds all
/// others of their fan too: of n needles each box holds a share of all n. Their oriented boxes overlap only their
/// neighbours, except near the tip that they have in common.
///
/// Long edges count more for the axes of a box than short ones. Immutable, refers to nothing. Memory: 18 bytes per
/// face. Source: [gottschalk1996], with axes that need no eigenvectors.
class OrientedBoxes {
 public:
  /// The boxes of a hierarchy over faces of `mesh`; null if those along the axes around the leaves are not much larger.
  /// Cost: some hundred leaves, which are samples; linear if they are made, some 40 nanoseconds per face.
  static std::unique_ptr<const OrientedBoxes> where_much_tighter(const TriangleMesh& mesh,
                                                                 const BoxHierarchy& hierarchy);

  /// The axes: the mean normal, the mean direction of the edges at right angles to it, and that across both.
  static constexpr std::size_t kNormal = 0, kAlong = 1, kAcross = 2;

  /// The points x with low[i] <= dot(axis i, x - middle) <= high[i], in the frame of the hierarchy, where the middle is
  /// that of the node's box: all points of its faces, but for roundings below 2^-48 of the largest coordinate. The axes
  /// are at right angles and of length 1 but for roundings to float.
  struct Box {
    std::array<std::array<float, 3>, 3> axes{};
    std::array<float, 3> low{}, high{};

    Vec3 axis(std::size_t i) const { return {axes[i][0], axes[i][1], axes[i][2]}; }
    /// A lower bound of the squared distance of a point from the faces, from the middle, but for such roundings.
    double squared_gap(const Vec3& from_middle) const;
    /// The largest product with a direction, from the middle, of points of the box, but for such roundings.
    double reach(const Vec3& direction) const;
  };
  const Box& box(BoxHierarchy::Node node) const { return levels_[node.level][node.index]; }
  /// The directions of the outermost two of the long edges of a leaf's faces: the sides of a fan. Zero if no edge is
  /// long.
  struct Sides {
    std::array<float, 3> left{}, right{};
  };
  const Sides& sides(BoxHierarchy::Node leaf) const { return sides_[leaf.index]; }

 private:
  /// Sums over the faces below a node, without regard to signs: normals times twice the areas, and edges times their
  /// lengths.
  struct Sums {
    Vec3 area, edges;
  };

  OrientedBoxes() = default;
  std::vector<Sums> make_leaves(const TriangleMesh& mesh, const BoxHierarchy& hierarchy);
  std::vector<Sums> make_level(const BoxHierarchy& hierarchy, std::size_t level, const std::vector<Sums>& below);

  std::vector<std::vector<Box>> levels_;  // parallel to the nodes
  std::vector<Sides> sides_;              // of the leaves
};

/// Lower bounds of the distances of nodes from a place, in coordinate units, by oriented boxes where there are any.
/// Refers to them and the hierarchy.
class OrientedGaps {
 public:
  /// `boxes` may be null: then all bounds are 0.
  OrientedGaps(const BoxHierarchy& hierarchy, const OrientedBoxes* boxes, const Vec3& place);

  double operator()(BoxHierarchy::Node node) const { return boxes_ == nullptr ? 0 : gap(node); }

 private:
  double gap(BoxHierarchy::Node node) const {
    const double of_box = boxes_->box(node).squared_gap(place_ - hierarchy_.place(node).middle);
    return std::sqrt(of_box) * unit_ - error_;
  }

  const BoxHierarchy& hierarchy_;
  const OrientedBoxes* boxes_;
  Vec3 place_;  // in the frame
  double unit_;
  double error_ = 0;
};

inline double OrientedBoxes::Box::squared_gap(const Vec3& from_middle) const {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double along = dot(axis(i), from_middle);
    const double gap = std::max({0.0, along - high[i], low[i] - along});
    sum += gap * gap;
  }
  return sum * (1 - 0x1p-20);
}

}  // namespace algebra3d
