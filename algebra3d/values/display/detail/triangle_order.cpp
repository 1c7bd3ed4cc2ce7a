#include "algebra3d/values/display/detail/triangle_order.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/values/display/detail/task_size.h"
#include "algebra3d/values/display/detail/vertex_order.h"
#include "base/scheduler.h"

namespace algebra3d::detail {
namespace {

constexpr std::size_t kTrianglesPerBlock = 1024;

/// The highest eight bits for each axis of the Morton codes of the centres of triangles, on the grid of
/// `spatial_order`: for comparisons of blocks, of which there are no more along an axis.
class CoarseCode {
 public:
  explicit CoarseCode(const DrawnShape& shape) : shape_(shape) {
    const Vec3 extent = shape.box.max - shape.box.min;
    const double largest = std::max({extent.x, extent.y, extent.z});
    half_ = 0.5 * extent;
    scale_ = largest > 0 ? kCells / largest : 0;
  }

  std::uint32_t operator()(const IndexTriangle& triangle) const {
    std::uint32_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (const std::uint32_t corner : triangle) sum += shape_.positions[corner][axis];
      const double place = std::clamp((sum / 3 + half_[axis]) * scale_, 0.0, kCells - 1);
      code |= spread(static_cast<std::uint32_t>(place)) << axis;
    }
    return code;
  }

 private:
  /// Eight bits, with two zeros between them.
  static std::uint32_t spread(std::uint32_t value) {
    value = (value | value << 8U) & 0x00F00FU;
    value = (value | value << 4U) & 0x0C30C3U;
    return (value | value << 2U) & 0x249249U;
  }

  static constexpr double kCells = 256;

  const DrawnShape& shape_;
  Vec3 half_;
  double scale_ = 0;
};

/// The codes of the triangles of a block but for the lowest and the highest sixteenth.
struct CodeRange {
  std::uint32_t low, high;
};

CodeRange code_range(const DrawnShape& shape, const CoarseCode& code_of, std::size_t block) {
  const std::size_t begin = block * kTrianglesPerBlock;
  const std::size_t end = std::min(begin + kTrianglesPerBlock, shape.triangles.size());
  std::vector<std::uint32_t> codes(end - begin);
  for (std::size_t i = begin; i < end; ++i) codes[i - begin] = code_of(shape.triangles[i]);
  const auto few = static_cast<std::ptrdiff_t>(codes.size() / 16);
  std::ranges::nth_element(codes, codes.begin() + few);
  const std::uint32_t low = codes[static_cast<std::size_t>(few)];
  std::ranges::nth_element(codes, codes.end() - 1 - few);
  return {low, *(codes.end() - 1 - few)};
}

}  // namespace

bool is_in_spatial_order(const DrawnShape& shape) {
  const CoarseCode code_of(shape);
  std::vector<CodeRange> ranges((shape.triangles.size() + kTrianglesPerBlock - 1) / kTrianglesPerBlock);
  parallel_for(ranges.size(), 16, [&](std::size_t block) { ranges[block] = code_range(shape, code_of, block); });
  std::size_t following = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i)
    following += static_cast<std::size_t>(ranges[i - 1].high <= ranges[i].low);
  return 4 * following >= 3 * (ranges.size() - 1);
}

void bring_into_spatial_order(DrawnShape& shape) {
  if (is_in_spatial_order(shape)) return;
  std::vector<Vec3> points(shape.positions.size());
  std::ranges::transform(shape.positions, points.begin(), [](const DrawnShape::Position& p) {
    return Vec3{p[0], p[1], p[2]};
  });
  const std::vector<std::uint32_t> order = spatial_order(points, shape.triangles);
  LargeVector<IndexTriangle> triangles(order.size());
  const bool is_level = shape.deviation.has_value();  // whose triangles have no numbers in the value
  LargeVector<std::uint32_t> face_ids(is_level ? 0 : order.size());
  parallel_for(order.size(), kElementsPerTask, [&](std::size_t i) {
    triangles[i] = shape.triangles[order[i]];
    if (!is_level) face_ids[i] = shape.face_ids.empty() ? order[i] : shape.face_ids[order[i]];
  });
  shape.triangles = std::move(triangles);
  shape.face_ids = std::move(face_ids);
  number_positions_by_use(shape);
}

}  // namespace algebra3d::detail
