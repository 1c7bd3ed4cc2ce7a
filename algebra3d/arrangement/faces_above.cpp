#include "algebra3d/arrangement/faces_above.h"

#include <algorithm>
#include <vector>

#include "algebra3d/exact/intersection_point.h"
#include "algebra3d/exact/vertical_line.h"

namespace algebra3d::arrangement {
namespace {

/// Where the vertical line through the point meets the plane of the triangle.
ExactPoint meeting_of(const PointRef& point, const TriangleRef& triangle) {
  const RationalVec3 from = point.rational();
  const ExactPoint up(RationalVec3(from.x, from.y, from.z + 1));
  return intersect_line_plane(point, up, IntegerPlane::through(triangle));
}

}  // namespace

struct FacesAbove::Meeting {
  ExactPoint place;
  std::uint32_t face;
  int sign;
};

bool FacesAbove::for_each(const PointRef& point, const Visit& visit) {
  const auto& tree = faces_.get();
  const double top = tree.bounds().max.z;
  // Slabs of the column, each higher than the one before. A face is met in one of them.
  Box3 slab = box_of(point);
  double height = (top - tree.bounds().min.z) / operands_.face_count();
  for (bool is_first = true; slab.min.z <= top; is_first = false, slab.min.z = slab.max.z, height *= 2) {
    slab.max.z = slab.min.z + height > slab.min.z ? slab.min.z + height : top;
    std::vector<Meeting> meetings;
    for (const std::uint32_t face : tree.window(slab)) {
      const LineCrossing crossing = cross_vertical_line(point, operands_.corners(face));
      if (crossing.side != -1) continue;
      Meeting meeting{meeting_of(point, operands_.corners(face)), face, crossing.sign};
      const auto is_up_to = [&](double z) { return compare(2, meeting.place, Vec3{0, 0, z}) <= 0; };
      if (is_up_to(slab.max.z) && (is_first || !is_up_to(slab.min.z))) meetings.push_back(std::move(meeting));
    }
    const auto is_lower = [](const Meeting& a, const Meeting& b) { return compare(2, a.place, b.place) < 0; };
    std::ranges::sort(meetings, is_lower);
    for (std::size_t i = 0; i < meetings.size(); ++i) {
      if (i + 1 < meetings.size() && !is_lower(meetings[i], meetings[i + 1])) return false;
      if (!visit(meetings[i].face, meetings[i].sign)) return true;
    }
    if (slab.max.z >= top) break;
  }
  return true;
}

}  // namespace algebra3d::arrangement
