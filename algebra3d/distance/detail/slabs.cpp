#include "algebra3d/distance/detail/slabs.h"

#include <algorithm>
#include <limits>

#include "algebra3d/exact/predicates_filter.h"

namespace algebra3d::distances {

void Slabs::Reach::turn(const Vec3& direction) {
  direction_ = direction;
  ++turn_;
}

double Slabs::Reach::of_face(std::uint32_t face) const {
  const PointArray& points = set_->mesh->points();
  double reach = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t corner : set_->mesh->triangle(FaceId(face)))
    reach = std::max(reach, dot(direction_, points.approx()[corner]));
  return reach;
}

double Slabs::Reach::of_node(BoxHierarchy::Node node) {
  std::vector<Known>& level = known_[node.level];
  if (level.empty()) level.resize((set_->hierarchy->leaf_count() >> node.level) + 1);
  if (level[node.index].turn != turn_) level[node.index] = {computed(node), turn_};
  return level[node.index].reach;
}

double Slabs::Reach::computed(BoxHierarchy::Node node) {
  double reach = -std::numeric_limits<double>::infinity();
  if (node.level == 0) {
    for (const std::uint32_t face : set_->hierarchy->leaf_faces(node.index)) reach = std::max(reach, of_face(face));
    return reach;
  }
  const std::size_t below = (set_->hierarchy->leaf_count() - 1) >> (node.level - 1);  // the last node there
  for (const std::uint32_t child : {2 * node.index, 2 * node.index + 1})
    if (child <= below) reach = std::max(reach, of_node({node.level - 1, child}));
  return reach;
}

// The products have three roundings each, of numbers up to the largest coordinate, which the coordinates themselves are
// rounded to as well.
Slabs::Slabs(const DistanceOperand& a, const DistanceOperand& b) : first_(a), second_(b) {
  const Box3 box = unite(a.hierarchy->bounds(), b.hierarchy->bounds());
  const double size = std::max(detail::largest(box.min), detail::largest(box.max));
  is_usable_ = size < 0x1p1000;
  error_ = 0x1p-46 * size + 0x1p-1000;
}

void Slabs::turn(const Vec3& direction) {
  has_direction_ = is_usable_ && direction != Vec3{};
  if (!has_direction_) return;
  first_.turn(direction);
  second_.turn(-1 * direction);
}

double Slabs::between(double first, double second) const {
  constexpr double kRoundings = 1 - 0x1p-46;
  return kRoundings * (-second - first - error_);
}

double Slabs::distance(FaceId first, FaceId second) const {
  return has_direction_ ? between(first_.of_face(first.index()), second_.of_face(second.index())) : -1;
}

double Slabs::distance(BoxHierarchy::Node first, BoxHierarchy::Node second) {
  return has_direction_ ? between(first_.of_node(first), second_.of_node(second)) : -1;
}

}  // namespace algebra3d::distances
