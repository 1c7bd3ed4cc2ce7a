#include "algebra3d/kernel/rounding/detail/bodies_apart.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/boxes.h"

namespace algebra3d {
namespace {

struct Shell {
  Box3 box;
  std::uint32_t number;
};

double longest_side(const Box3& box) {
  const Vec3 sides = box.max - box.min;
  return std::max({sides.x, sides.y, sides.z});
}

/// The runs of shells without a gap between their boxes along an axis, along which this sorts them.
std::vector<std::span<Shell>> runs_along(std::size_t axis, std::span<Shell> shells) {
  std::ranges::sort(shells, {}, [&](const Shell& shell) { return std::pair(shell.box.min[axis], shell.number); });
  std::vector<std::span<Shell>> runs;
  std::size_t begin = 0;
  double end_of_run = shells[0].box.max[axis];
  for (std::size_t i = 1; i < shells.size(); ++i) {
    if (shells[i].box.min[axis] > end_of_run) {
      runs.push_back(shells.subspan(begin, i - begin));
      begin = i;
    }
    end_of_run = std::max(end_of_run, shells[i].box.max[axis]);
  }
  runs.push_back(shells.subspan(begin));
  return runs;
}

/// Divides the shells at gaps until there are none.
std::vector<std::span<Shell>> groups_apart(std::span<Shell> all) {
  std::vector<std::span<Shell>> waiting{all}, groups;
  while (!waiting.empty()) {
    const std::span<Shell> shells = waiting.back();
    waiting.pop_back();
    bool is_divided = false;
    for (std::size_t axis = 0; axis < 3 && !is_divided; ++axis) {
      const std::vector<std::span<Shell>> runs = runs_along(axis, shells);
      is_divided = runs.size() > 1;
      if (is_divided) waiting.insert(waiting.end(), runs.begin(), runs.end());
    }
    if (!is_divided) groups.push_back(shells);
  }
  return groups;
}

}  // namespace

std::vector<std::vector<FaceId>> bodies_apart(const TriangleMesh& mesh) {
  const FaceComponents components = connected_components(mesh);
  if (components.count == 0) return {};
  std::vector<Shell> shells(components.count);
  for (std::uint32_t i = 0; i < shells.size(); ++i) shells[i].number = i;
  for (const FaceId face : faces(mesh))
    shells[components.of_face[face.index()]].box.extend(box_of_triangle(mesh.corners(face)));
  std::vector<std::pair<double, std::span<Shell>>> groups;
  for (const std::span<Shell> group : groups_apart(shells)) {
    Box3 box;
    for (const Shell& shell : group) box.extend(shell.box);
    groups.emplace_back(longest_side(box), group);
  }
  std::ranges::stable_sort(groups, std::ranges::greater(), &std::pair<double, std::span<Shell>>::first);
  const std::vector<std::vector<FaceId>> faces_of = components.faces();
  std::vector<std::vector<FaceId>> bodies;
  for (const auto& [side, group] : groups) {
    std::vector<FaceId>& body = bodies.emplace_back();
    for (const Shell& shell : group)
      body.insert(body.end(), faces_of[shell.number].begin(), faces_of[shell.number].end());
  }
  return bodies;
}

}  // namespace algebra3d
