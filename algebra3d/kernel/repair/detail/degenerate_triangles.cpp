#include "algebra3d/kernel/repair/detail/degenerate_triangles.h"

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

void drop_degenerate_triangles(IndexedSoup& soup, RepairReport& report) {
  IdVector<FaceId, bool> is_dropped(soup.triangles.size());
  for (const FaceId triangle : soup.triangles.ids()) {
    const auto& [a, b, c] = soup.triangles[triangle];
    const bool repeats = a == b || b == c || c == a;
    is_dropped[triangle] = repeats || collinear(soup.points[a], soup.points[b], soup.points[c]);
    if (is_dropped[triangle])
      report.add(repeats ? RepairStep::repeated_corners : RepairStep::collinear_corners, soup.middle(triangle));
  }
  soup.drop(is_dropped);
}

}  // namespace algebra3d
