#include "algebra3d/kernel/search/oriented_boxes.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "algebra3d/kernel/search/detail/node_extents.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using node_extents::add_unsigned;
using node_extents::Children;
using node_extents::direction_along;
using node_extents::Extent;
using node_extents::kNodesPerTask;
using node_extents::node_at;

Vec3 across(const Vec3& normal, const Vec3& vector) {
  return vector - dot(normal, vector) * normal;
}

/// A direction at right angles to a normal.
Vec3 any_across(const Vec3& normal) {
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  if (size.x <= size.y && size.x <= size.z) return across(normal, {1, 0, 0});
  return across(normal, size.y <= size.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
}

Vec3 unit_along(const Vec3& vector, double least, const Vec3& otherwise) {
  const double length = std::sqrt(dot(vector, vector));
  return length > least ? (1 / length) * vector : otherwise;
}

/// The axes of a box from sums over its faces, at right angles but for roundings: so edges that are hardly across the
/// normal do not count.
std::array<Vec3, 3> axes_of(const Vec3& area, const Vec3& edges) {
  const Vec3 normal = unit_along(area, 0, {0, 0, 1});
  const Vec3 other = unit_along(any_across(normal), 0, {1, 0, 0});
  const Vec3 along = unit_along(across(normal, unit_along(edges, 0, other)), 0x1p-10, other);
  return {normal, along, cross(normal, along)};
}

/// The sides of a fan whose faces have these corners, three each.
OrientedBoxes::Sides sides_of(std::span<const Vec3> corners, const OrientedBoxes::Box& box) {
  constexpr double kLong = 0.25;
  const Vec3 along = box.axis(OrientedBoxes::kAlong), across = box.axis(OrientedBoxes::kAcross);
  const double least_length = kLong * (box.high[OrientedBoxes::kAlong] - box.low[OrientedBoxes::kAlong]);
  double least = 2, most = -2;
  OrientedBoxes::Sides sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 edge = corners[i % 3 == 2 ? i - 2 : i + 1] - corners[i];
    const double length = std::sqrt(dot(edge, edge));
    if (!(length > least_length)) continue;
    const Vec3 direction = (dot(along, edge) < 0 ? -1 / length : 1 / length) * edge;
    const double slope = dot(across, direction);
    if (slope < least) sides.left = direction_along(direction);
    if (slope > most) sides.right = direction_along(direction);
    least = std::min(least, slope);
    most = std::max(most, slope);
  }
  return sides;
}

/// Half the area of the surface of a box with these sides.
double half_area(double a, double b, double c) {
  return a * b + b * c + c * a;
}

double half_area(const OrientedBoxes::Box& box) {
  return half_area(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

/// A box around points or boxes, which are given by visits of their extents along a direction.
template <typename ForEachExtent>
OrientedBoxes::Box box_around(const std::array<Vec3, 3>& axes, const ForEachExtent& for_each_extent) {
  OrientedBoxes::Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.axes[i] = direction_along(axes[i]);
    Extent extent;
    for_each_extent(box.axis(i), extent);
    box.low[i] = extent.rounded_low();
    box.high[i] = extent.rounded_high();
  }
  return box;
}

/// The box and the sides of a leaf, and sums over its faces.
struct Leaf {
  Vec3 area, edges;
  OrientedBoxes::Box box;
  OrientedBoxes::Sides sides;

  Leaf(const TriangleMesh& mesh, const BoxHierarchy& hierarchy, BoxHierarchy::Node leaf) {
    const std::vector<Vec3>& points = mesh.points().approx();
    const Vec3 middle = hierarchy.place(leaf).middle;
    std::array<Vec3, 3 * BoxHierarchy::kLeafSize> places;
    std::size_t count = 0;
    for (const auto face : hierarchy.faces_of(leaf)) {
      for (const auto corner : mesh.triangle(FaceId(face)))
        places[count++] = hierarchy.frame().place_of(points[corner]) - middle;
      const Vec3 &a = places[count - 3], &b = places[count - 2], &c = places[count - 1];
      add_unsigned(area, cross(a - c, b - c));
      for (const Vec3& edge : {b - a, c - b, a - c}) add_unsigned(edges, std::sqrt(dot(edge, edge)) * edge);
    }
    const std::span<const Vec3> corners = std::span(places).first(count);
    box = box_around(axes_of(area, edges), [&](const Vec3& axis, Extent& extent) {
      for (const Vec3& corner : corners) extent.extend(dot(axis, corner), dot(axis, corner));
    });
    sides = sides_of(corners, box);
  }
};

/// True if oriented boxes are worth it: if the sum of the surfaces of those along the axes, which grows as the number
/// of boxes that a ray meets, is much larger. By some hundred leaves.
bool are_much_tighter(const TriangleMesh& mesh, const BoxHierarchy& hierarchy) {
  constexpr double kMuchLarger = 4;
  constexpr std::size_t kFewLeaves = 16, kSamples = 512;
  const std::size_t count = hierarchy.leaf_count(), step = count / kSamples + 1;
  if (count <= kFewLeaves) return false;
  double oriented = 0, along_axes = 0;
  for (std::size_t index = 0; index < count; index += step) {
    const BoxHierarchy::Node leaf = node_at(0, index);
    const Vec3 half = hierarchy.place(leaf).half;
    oriented += half_area(Leaf(mesh, hierarchy, leaf).box);
    along_axes += half_area(2 * half.x, 2 * half.y, 2 * half.z);
  }
  return along_axes > kMuchLarger * oriented;
}

}  // namespace

std::unique_ptr<const OrientedBoxes> OrientedBoxes::where_much_tighter(const TriangleMesh& mesh,
                                                                       const BoxHierarchy& hierarchy) {
  if (!are_much_tighter(mesh, hierarchy)) return nullptr;
  std::unique_ptr<OrientedBoxes> boxes(new OrientedBoxes);
  boxes->levels_.resize(hierarchy.level_count());
  std::vector<Sums> sums = boxes->make_leaves(mesh, hierarchy);
  for (std::size_t level = 1; level < hierarchy.level_count(); ++level)
    sums = boxes->make_level(hierarchy, level, sums);
  return boxes;
}

std::vector<OrientedBoxes::Sums> OrientedBoxes::make_leaves(const TriangleMesh& mesh, const BoxHierarchy& hierarchy) {
  std::vector<Sums> sums(hierarchy.leaf_count());
  levels_[0].resize(sums.size());
  sides_.resize(sums.size());
  parallel_for(sums.size(), kNodesPerTask, [&](std::size_t index) {
    const Leaf leaf(mesh, hierarchy, node_at(0, index));
    sums[index] = {leaf.area, leaf.edges};
    levels_[0][index] = leaf.box;
    sides_[index] = leaf.sides;
  });
  return sums;
}

std::vector<OrientedBoxes::Sums> OrientedBoxes::make_level(const BoxHierarchy& hierarchy, std::size_t level,
                                                           const std::vector<Sums>& below) {
  std::vector<Sums> sums(hierarchy.node_count(node_at(level, 0).level));
  levels_[level].resize(sums.size());
  parallel_for(sums.size(), kNodesPerTask, [&](std::size_t index) {
    const BoxHierarchy::Node node = node_at(level, index);
    const Children children(hierarchy, node);
    children.for_each([&](BoxHierarchy::Node child) {
      add_unsigned(sums[index].area, below[child.index].area);
      add_unsigned(sums[index].edges, below[child.index].edges);
    });
    const Vec3 middle = hierarchy.place(node).middle;
    const auto extend = [&](const Vec3& axis, Extent& extent) {
      children.for_each([&](BoxHierarchy::Node child) {
        const BoxHierarchy::Place place = hierarchy.place(child);
        const double offset = dot(axis, place.middle - middle);
        const double low = std::min(box(child).reach(-1 * axis), place.reach(axis));
        const double high = std::min(box(child).reach(axis), place.reach(axis));
        extent.extend(offset - low, offset + high);
      });
    };
    levels_[level][index] = box_around(axes_of(sums[index].area, sums[index].edges), extend);
  });
  return sums;
}

/// The direction is a sum of multiples of the axes, and a rest that is left by their roundings.
double OrientedBoxes::Box::reach(const Vec3& direction) const {
  double sum = 0, size = 0;
  Vec3 rest = direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = dot(axis(i), direction);
    sum += share * (share > 0 ? high[i] : low[i]);
    rest = rest - share * axis(i);
    size += std::max(std::abs(low[i]), std::abs(high[i]));
  }
  return sum + std::sqrt(dot(rest, rest)) * size * (1 + 0x1p-20);
}

OrientedGaps::OrientedGaps(const BoxHierarchy& hierarchy, const OrientedBoxes* boxes, const Vec3& place)
    : hierarchy_(hierarchy), boxes_(boxes), unit_(2 / hierarchy.frame().scale) {
  if (boxes == nullptr) return;
  constexpr double kFar = 0x1p100;
  place_ = hierarchy.frame().place_of(place);
  const Box3 box = hierarchy.bounds();
  double largest = 0;
  for (const Vec3& point : {box.min, box.max, place})
    largest = std::max({largest, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  error_ = 0x1p-46 * largest + 0x1p-70 * unit_;  // of subnormal coordinates
  if (!(largest / unit_ < kFar)) boxes_ = nullptr;
}

}  // namespace algebra3d
