#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "algebra3d/kernel/search/node_slabs.h"
#include "algebra3d/kernel/search/oriented_boxes.h"

namespace algebra3d {

/// Decides whether nodes of two hierarchies are apart, by their boxes and slabs: along the line between the middles of
/// their boxes, along both normals, and half-way between these. For surfaces whose curvature is bounded, this fails by
/// the square of the nodes' sizes, where boxes along the axes fail by the sizes. Where a set has needles, also along
/// the axes of its oriented boxes. For one search by one thread; refers to its operands.
///
/// Uses slabs that exist; builds them only after searches have taken as long as building them would. Skips node sizes
/// at which the test rarely succeeds.
class SlabGaps {
 public:
  /// The hierarchies are those over the meshes, or over some of their faces.
  SlabGaps(const TriangleMesh& first, const BoxHierarchy& of_first, const TriangleMesh& second,
           const BoxHierarchy& of_second);

  /// True if the faces of two nodes are certainly farther apart than `distance`, in coordinate units. To be called for
  /// each pair of nodes that a search reaches. Cost: some ten nanoseconds.
  bool exceed(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance);

 private:
  /// A mesh and its hierarchy, and the map from the frame of that to the frame of the first one.
  struct Side {
    const TriangleMesh& mesh;
    const BoxHierarchy& hierarchy;
    double factor;
    Vec3 origin;
    const NodeSlabs* slabs = nullptr;
    const OrientedBoxes* boxes = nullptr;  ///< also null where those along the axes do
  };
  struct Pair;
  /// An interval of products.
  struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  };
  /// Whether comparisons of nodes of one level succeed often enough to be worth their time. One in eight is made in any
  /// case.
  class Score {
   public:
    bool is_worth_asking() { return balance_ >= 0 || ++skipped_ % 8 == 0; }
    void note(bool is_told) { balance_ = std::clamp(balance_ + (is_told ? kWorth : -1), -kWorth, kMost); }

   private:
    static constexpr int kWorth = 16, kMost = 256;
    int balance_ = kMost;
    std::uint32_t skipped_ = 0;
  };

  bool has_slabs();
  bool compare(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) const;
  bool does_box_tell(const Pair& pair, const Vec3& along, double least) const;
  bool do_fans_tell(const Pair& pair, double least) const;
  static Span span_of(const Side& side, BoxHierarchy::Node leaf, const Vec3& direction);

  Side first_, second_;
  std::array<Score, 32> scores_;  // of levels
  std::size_t steps_ = 0;
  bool is_usable_;       // false if the frames are too different for doubles
  double unit_, error_;  // of the frame, in coordinates; and of a gap, in units
};

}  // namespace algebra3d
