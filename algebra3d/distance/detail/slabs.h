#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algebra3d/distance/distance.h"

namespace algebra3d::distances {

/// Slabs across a direction that keep parts of two sets apart: between the farthest points of the first one's part and
/// the nearest points of the second one's. Boxes along the axes say little of surfaces that lie aslant; the direction
/// from one set to the other says nearly all. What was computed for a part of a hierarchy is kept for the direction.
class Slabs {
 public:
  Slabs(const DistanceOperand& a, const DistanceOperand& b);

  /// The direction to use from now on, of length 1 but for rounding; 0 for none.
  void turn(const Vec3& direction);
  /// A lower bound of the distance of two faces, or of all faces of two nodes up to BoxHierarchy::kAskedLevel, rounded
  /// down by more than all roundings; negative if there is none.
  double distance(FaceId first, FaceId second) const;
  double distance(BoxHierarchy::Node first, BoxHierarchy::Node second);

 private:
  /// How far a part of a set reaches along a direction.
  class Reach {
   public:
    explicit Reach(const DistanceOperand& set) : set_(&set) {}
    void turn(const Vec3& direction);
    double of_face(std::uint32_t face) const;
    double of_node(BoxHierarchy::Node node);

   private:
    struct Known {
      double reach = 0;
      std::uint32_t turn = 0;  // of which it is; they count from 1
    };

    double computed(BoxHierarchy::Node node);

    const DistanceOperand* set_;
    Vec3 direction_;
    std::uint32_t turn_ = 0;
    std::array<std::vector<Known>, BoxHierarchy::kAskedLevel + 1> known_;  // by level and node
  };

  double between(double first, double second) const;

  Reach first_, second_;  // the second one in the opposite direction
  bool is_usable_, has_direction_ = false;
  double error_;
};

}  // namespace algebra3d::distances
