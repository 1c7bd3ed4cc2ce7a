#include "algebra3d/kernel/distance/detail/separation.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "algebra3d/kernel/exact/predicates_filter.h"

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

double Reach::of_node(BoxHierarchy::Node node, double floor) {
  const Known& kept = known(node);
  if (is_known(kept, node) && (kept.is_exact || kept.reach <= floor)) return std::max(kept.reach, floor);
  const double reach = farthest(node, floor);
  known(node) = {node, turn_, reach > floor, reach};
  return reach;
}

double Reach::at_most(BoxHierarchy::Node node) {
  const Known& kept = known(node);
  return is_known(kept, node) ? kept.reach : bound(node);
}

double Reach::at_most_along(const Vec3& direction, BoxHierarchy::Node node) {
  ++work_;
  return bound(direction, dot(direction, set_.hierarchy->frame().origin), node);
}

Vec3 Reach::middle(BoxHierarchy::Node node) const {
  return unit_ * set_.hierarchy->place(node).middle + set_.hierarchy->frame().origin;
}

double Reach::bound(BoxHierarchy::Node node) {
  ++work_;
  return bound(direction_, origin_, node);
}

/// From boxes and slabs.
double Reach::bound(const Vec3& direction, double origin, BoxHierarchy::Node node) const {
  const BoxHierarchy::Place place = set_.hierarchy->place(node);
  const double from_middle = slabs_ != nullptr ? slabs_->reach(node, place, direction) : place.reach(direction);
  return unit_ * (dot(direction, place.middle) + from_middle) + origin;
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
  if (reach > floor) known(node) = {node, turn_, true, reach};
  return reach;
}

// The products have some roundings each, of numbers up to the largest coordinate, which the coordinates themselves are
// rounded to as well.
Separation::Separation(const DistanceOperand& a, const DistanceOperand& b)
    : first_(a), second_(b), first_mesh_(*a.mesh), second_mesh_(*b.mesh) {
  const Box3 box = unite(a.hierarchy->bounds(), b.hierarchy->bounds());
  const double size = std::max(detail::largest(box.min), detail::largest(box.max));
  is_usable_ = size < 0x1p1000;
  error_ = 0x1p-46 * size + 0x1p-1000;
}

void Separation::turn(const Vec3& direction) {
  has_direction_ = is_usable_ && direction != Vec3{};
  if (!has_direction_) return;
  direction_ = direction;
  first_.turn(direction);
  second_.turn(-1 * direction);
}

double Separation::between(double first, double second) const {
  constexpr double kRoundings = 1 - 0x1p-46;
  return kRoundings * (-second - first - error_);
}

/// The direction of the part of a way that is at right angles to the direction, of length 1 but for rounding; 0 where
/// that part is so small that rounding could turn it.
Vec3 Separation::across(const Vec3& way) const {
  const Vec3 rest = way - dot(way, direction_) * direction_;
  const double square = dot(rest, rest);
  return square > 0x1p-20 * dot(way, way) ? (1 / std::sqrt(square)) * rest : Vec3{};
}

/// By Pythagoras. The two directions are at right angles but for 2^-38. Not for squares that lose digits.
bool Separation::is_farther(double along, double across, double distance) {
  const double square = distance * distance;
  return across > 0 && square > 0x1p-960 && along * along + across * across > square * (1 + 0x1p-36);
}

bool Separation::are_beside(FaceId first, FaceId second, double along, double distance) const {
  const auto [a, b, c] = first_mesh_.triangle(first);
  const auto [d, e, f] = second_mesh_.triangle(second);
  const std::vector<Vec3>&points = first_mesh_.points().approx(), &others = second_mesh_.points().approx();
  const Vec3 middle = (1.0 / 3) * (points[a] + points[b] + points[c]);
  const Vec3 side = across((1.0 / 3) * (others[d] + others[e] + others[f]) - middle);
  const double end = std::max({dot(side, points[a]), dot(side, points[b]), dot(side, points[c])});
  const double begin = std::min({dot(side, others[d]), dot(side, others[e]), dot(side, others[f])});
  return is_farther(along, between(end, -begin), distance);
}

bool Separation::are_beside(BoxHierarchy::Node first, BoxHierarchy::Node second, double along, double distance) {
  const Vec3 side = across(second_.middle(second) - first_.middle(first));
  if (side == Vec3{}) return false;
  const double end = first_.at_most_along(side, first), begin = second_.at_most_along(-1 * side, second);
  return is_farther(along, between(end, begin), distance);
}

bool Separation::keeps_apart(FaceId first, FaceId second, double distance) const {
  if (!has_direction_) return false;
  const double along = between(first_.of_face(first.index()), second_.of_face(second.index()));
  return along > distance || (along > 0 && are_beside(first, second, along, distance));
}

bool Separation::keeps_apart(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) {
  if (!has_direction_ || credit_ < 0) return false;
  const std::int64_t before = first_.work() + second_.work();
  const bool is_told = are_apart(first, second, distance);
  credit_ += (is_told ? kWorkForAPair : 0) - (first_.work() + second_.work() - before);
  return is_told;
}

/// The reach of a node is bounded only as closely as that of the other one makes necessary.
bool Separation::are_apart(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) {
  const double apart = -(distance * (1 + 0x1p-40) + 2 * error_);  // the sum of two reaches
  const double of_second = second_.at_most(second);
  const double of_first = first_.of_node(first, apart - of_second);
  if (between(of_first, of_second) > distance) return true;
  const double along = between(of_first, second_.of_node(second, apart - of_first));
  return along > distance || (along > 0 && are_beside(first, second, along, distance));
}

}  // namespace algebra3d::distances
