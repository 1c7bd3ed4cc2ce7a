#include "algebra3d/distance/detail/separation.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "algebra3d/exact/predicates_filter.h"

namespace algebra3d::distances {
namespace {

/// From so many faces on, slabs find the farthest face sooner than boxes alone.
constexpr std::size_t kWorthSlabs = 2048;
constexpr std::size_t kMaxKnown = 1024;

}  // namespace

const NodeSlabs* slabs_if_large(const DistanceOperand& set) {
  return set.hierarchy->face_count() < kWorthSlabs ? nullptr : &set.hierarchy->slabs(*set.mesh);
}

Reach::Reach(const DistanceOperand& set)
    : set_(set),
      slabs_(slabs_if_large(set)),
      unit_(2 / set.hierarchy->frame().scale),
      known_(std::min(kMaxKnown, std::bit_ceil(2 * set.hierarchy->leaf_count()))) {}

void Reach::turn(const Vec3& direction) {
  direction_ = direction;
  origin_ = dot(direction, set_.hierarchy->frame().origin);
  floor_ = -std::numeric_limits<double>::infinity();
  ++turn_;
}

double Reach::of_face(std::uint32_t face) const {
  const PointArray& points = set_.mesh->points();
  double reach = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t corner : set_.mesh->triangle(FaceId(face)))
    reach = std::max(reach, dot(direction_, points.approx()[corner]));
  return reach;
}

Reach::Known& Reach::known(BoxHierarchy::Node node) {
  const std::uint32_t mixed = node.index * 0x9E3779B1U + node.level * 0x85EBCA6BU;
  return known_[(mixed ^ mixed >> 16) % known_.size()];
}

double Reach::of_node(BoxHierarchy::Node node) {
  const Known& kept = known(node);
  if (kept.turn == turn_ && kept.node == node) return kept.reach;
  const double reach = farthest(node, floor_);
  known(node) = {node, turn_, reach};
  return reach;
}

/// From boxes and slabs.
double Reach::bound(BoxHierarchy::Node node) {
  ++work_;
  const BoxHierarchy::Place place = set_.hierarchy->place(node);
  const double from_middle = slabs_ != nullptr ? slabs_->reach(node, place, direction_) : place.reach(direction_);
  return unit_ * (dot(direction_, place.middle) + from_middle) + origin_;
}

double Reach::farthest_of_leaf(BoxHierarchy::Node leaf, double floor) const {
  for (const std::uint32_t face : set_.hierarchy->leaf_faces(leaf.index)) floor = std::max(floor, of_face(face));
  return floor;
}

/// The reach of a node if it is above `floor`, else `floor`. Goes to the child that may reach farther first.
double Reach::farthest(BoxHierarchy::Node node, double floor) {
  if (node.level == 0) return farthest_of_leaf(node, floor);
  const std::uint32_t level = node.level - 1, first = 2 * node.index;
  const bool has_two = first + 1 < set_.hierarchy->node_count(level);
  struct Child {
    BoxHierarchy::Node node;
    double bound;
  };
  Child near{{level, first}, bound({level, first})};
  Child far{{level, first + 1}, has_two ? bound({level, first + 1}) : -std::numeric_limits<double>::infinity()};
  if (near.bound < far.bound) std::swap(near, far);
  double reach = floor;
  for (const Child& child : {near, far})
    if (child.bound > reach) reach = farthest(child.node, reach);
  if (reach > floor) known(node) = {node, turn_, reach};
  return reach;
}

// The products have some roundings each, of numbers up to the largest coordinate, which the coordinates themselves are
// rounded to as well.
Separation::Separation(const DistanceOperand& a, const DistanceOperand& b) : first_(a), second_(b) {
  const Box3 box = unite(a.hierarchy->bounds(), b.hierarchy->bounds());
  const double size = std::max(detail::largest(box.min), detail::largest(box.max));
  is_usable_ = size < 0x1p1000;
  error_ = 0x1p-46 * size + 0x1p-1000;
}

void Separation::turn(const Vec3& direction, double limit) {
  has_direction_ = is_usable_ && direction != Vec3{};
  if (!has_direction_) return;
  first_.turn(direction);
  second_.turn(-1 * direction);
  if (credit_ < 0) return;
  // A part that is so far from the whole other set is so far from all of its parts.
  const double of_first = first_.of_all(), of_second = second_.of_all();
  const double farther = limit * (1 + 0x1p-40) + 2 * error_;
  first_.ignore_below(-farther - of_second);
  second_.ignore_below(-farther - of_first);
}

double Separation::between(double first, double second) const {
  constexpr double kRoundings = 1 - 0x1p-46;
  return kRoundings * (-second - first - error_);
}

bool Separation::keeps_apart(FaceId first, FaceId second, double distance) const {
  return has_direction_ && between(first_.of_face(first.index()), second_.of_face(second.index())) > distance;
}

bool Separation::keeps_apart(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) {
  if (!has_direction_ || credit_ < 0) return false;
  const std::int64_t before = first_.work() + second_.work();
  const bool is_told = between(first_.of_node(first), second_.of_node(second)) > distance;
  credit_ += (is_told ? kWorkForAPair : 0) - (first_.work() + second_.work() - before);
  return is_told;
}

}  // namespace algebra3d::distances
