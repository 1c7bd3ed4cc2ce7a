#include "algebra3d/kernel/rounding/detail/moved_points.h"

#include <algorithm>

namespace algebra3d {

MovedPoints::MovedPoints(const MovedVertices& moved) {
  of_vertex.reserve(moved.points.size());
  for (std::size_t v = 0; v < moved.points.size(); ++v) {
    const PointId id(table.intern(moved.points[v]));
    of_vertex.push_back(id);
    if (id == points.next_id()) {
      points.push_back(moved.points[v].approx);
      movements.push_back(0);
    }
    movements[id] = std::max(movements[id], moved.movements[v]);
    largest_movement = std::max(largest_movement, moved.movements[v]);
  }
}

}  // namespace algebra3d
