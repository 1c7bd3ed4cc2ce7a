#include "algebra3d/kernel/validity/detail/near_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "algebra3d/kernel/search/boxes.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

Box3 box_of_face(const TriangleMesh& mesh, std::uint32_t face) {
  return box_of_triangle(mesh.corners(FaceId(face)));
}

Box3 box_of_mesh(const TriangleMesh& mesh) {
  Box3 box;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) box.extend(box_of(mesh.points()[v]));
  return box;
}

/// A coarse grid of cells over a box, some of which are marked.
class MarkedCells {
 public:
  explicit MarkedCells(const Box3& bounds) : bounds_(bounds) {
    const Vec3 size = bounds.max - bounds.min;
    for (std::size_t axis = 0; axis < 3; ++axis) scale_[axis] = size[axis] > 0 ? kCells / size[axis] : 0;
  }

  /// Marks the cells that the box meets.
  void mark(const Box3& box) {
    const Cells cells = cells_of(box);
    for (unsigned x = cells.low[0]; x <= cells.high[0]; ++x)
      for (unsigned y = cells.low[1]; y <= cells.high[1]; ++y) columns_[x * kCells + y] |= cells.part_of_column;
  }
  /// True if the box meets a marked cell.
  bool meets_marked(const Box3& box) const {
    if (!box.intersects(bounds_)) return false;
    const Cells cells = cells_of(box);
    std::uint64_t met = 0;
    for (unsigned x = cells.low[0]; x <= cells.high[0]; ++x)
      for (unsigned y = cells.low[1]; y <= cells.high[1]; ++y) met |= columns_[x * kCells + y] & cells.part_of_column;
    return met != 0;
  }

 private:
  static constexpr unsigned kCells = 64;

  struct Cells {
    std::array<unsigned, 2> low, high;
    std::uint64_t part_of_column;
  };

  /// The number of a cell along an axis: monotonic, and the first or the last one beyond the bounds.
  unsigned number(double coordinate, std::size_t axis) const {
    const double place = (coordinate - bounds_.min[axis]) * scale_[axis];
    return place > 0 ? static_cast<unsigned>(std::min(place, kCells - 1.0)) : 0;
  }
  Cells cells_of(const Box3& box) const {
    const unsigned bottom = number(box.min.z, 2), top = number(box.max.z, 2);
    return {{number(box.min.x, 0), number(box.min.y, 1)},
            {number(box.max.x, 0), number(box.max.y, 1)},
            (~std::uint64_t{0} >> (kCells - 1 - top)) & (~std::uint64_t{0} << bottom)};
  }

  Box3 bounds_;
  Vec3 scale_;
  std::vector<std::uint64_t> columns_ = std::vector<std::uint64_t>(std::size_t{kCells} * kCells);  // a bit per cell
};

}  // namespace

std::vector<FaceId> faces_near(const TriangleMesh& mesh, const std::vector<bool>& is_excepted,
                               const TriangleMesh& others, double reach) {
  if (others.is_empty()) return {};
  MarkedCells cells(padded(box_of_mesh(others), reach));
  for (std::uint32_t f = 0; f < others.face_count(); ++f) cells.mark(padded(box_of_face(others, f), reach));
  constexpr std::size_t kFacesPerScan = 4'000;
  return parallel_collect(mesh.face_count(), kFacesPerScan, [&](std::size_t begin, std::size_t end) {
    std::vector<FaceId> found;
    for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f)
      if (!is_excepted[f] && cells.meets_marked(box_of_face(mesh, f))) found.emplace_back(f);
    return found;
  });
}

}  // namespace algebra3d
