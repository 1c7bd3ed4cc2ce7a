#include "algebra3d/soup/spatial_order.h"

#include <algorithm>
#include <array>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/mesh_triangles.h"
#include "algebra3d/halfedge/relinked.h"

namespace algebra3d {
namespace {

constexpr unsigned kBitsPerAxis = 21;

/// `value`, of kBitsPerAxis bits, with two zeros before each bit.
std::uint64_t spread(std::uint64_t value) {
  value = (value | value << 32U) & 0x001F00000000FFFFU;
  value = (value | value << 16U) & 0x001F0000FF0000FFU;
  value = (value | value << 8U) & 0x100F00F00F00F00FU;
  value = (value | value << 4U) & 0x10C30C30C30C30C3U;
  value = (value | value << 2U) & 0x1249249249249249U;
  return value;
}

/// The Morton code of a triangle's centre. All numbers are scaled down first, so that nothing overflows.
class CentreCode {
 public:
  explicit CentreCode(std::span<const Vec3> points) {
    const Box3 box = Box3::around(points);
    if (box.is_empty()) return;
    origin_ = 0.25 * box.min;
    const Vec3 extent = 0.25 * box.max - origin_;
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (largest > 0) scale_ = static_cast<double>((1U << kBitsPerAxis) - 1) / largest;
  }

  std::uint64_t operator()(const Vec3& a, const Vec3& b, const Vec3& c) const {
    std::uint64_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = (0.25 * a[axis] + 0.25 * b[axis] + 0.25 * c[axis]) / 3;
      // A subnormal extent can make the scale infinite, and the product NaN: then all triangles are in one place.
      const double place = (centre - origin_[axis]) * scale_;
      const bool is_inside = place >= 0 && place < static_cast<double>(1U << kBitsPerAxis);
      code |= spread(is_inside ? static_cast<std::uint64_t>(place) : 0) << axis;
    }
    return code;
  }

 private:
  Vec3 origin_;
  double scale_ = 0;
};

struct CodedTriangle {
  std::uint64_t code;
  std::uint32_t triangle;
};

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// Stable sort by code, one digit after the other from the lowest.
void radix_sort(std::vector<CodedTriangle>& coded) {
  std::vector<CodedTriangle> sorted(coded.size());
  for (unsigned shift = 0; shift < 3 * kBitsPerAxis; shift += kDigitBits) {
    const auto digit = [shift](const CodedTriangle& t) { return (t.code >> shift) & (kDigits - 1); };
    std::vector<std::size_t> places(kDigits + 1);
    for (const CodedTriangle& t : coded) ++places[digit(t) + 1];
    for (std::size_t d = 0; d < kDigits; ++d) places[d + 1] += places[d];
    for (const CodedTriangle& t : coded) sorted[places[digit(t)]++] = t;
    std::swap(coded, sorted);
  }
}

/// Sorts what is in order but for a few: each that comes after a larger one is set aside with that one, and these are
/// sorted and merged. False, with nothing done, if they are many.
bool merge_sort_few(std::vector<CodedTriangle>& coded) {
  const std::size_t most = coded.size() / 16;
  std::vector<CodedTriangle> kept, few;
  kept.reserve(coded.size());
  for (const CodedTriangle& t : coded) {
    if (kept.empty() || kept.back().code <= t.code) {
      kept.push_back(t);
      continue;
    }
    few.push_back(kept.back());
    few.push_back(t);
    kept.pop_back();
    if (few.size() > most) return false;
  }
  const auto place = [](const CodedTriangle& t) { return std::pair(t.code, t.triangle); };
  std::ranges::sort(few, {}, place);
  std::ranges::merge(kept, few, coded.begin(), {}, place, place);
  return true;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points,
                                         std::span<const TriangleMesh::Triangle> triangles) {
  const CentreCode code_of(points);
  std::vector<CodedTriangle> coded(triangles.size());
  for (std::uint32_t i = 0; i < coded.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    coded[i] = {code_of(points[a], points[b], points[c]), i};
  }
  if (!merge_sort_few(coded)) radix_sort(coded);
  std::vector<std::uint32_t> order(coded.size());
  std::ranges::transform(coded, order.begin(), &CodedTriangle::triangle);
  return order;
}

WeldedTriangles reordered(const WeldedTriangles& welded, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> numbers(welded.points.size(), kNone);
  WeldedTriangles result;
  result.points.reserve(welded.points.size());
  result.triangles.reserve(order.size());
  for (const std::uint32_t triangle : order) {
    TriangleMesh::Triangle& corners = result.triangles.emplace_back(welded.triangles[triangle]);
    for (std::uint32_t& corner : corners) {
      std::uint32_t& number = numbers[corner];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(welded.points.point(corner));
      }
      corner = number;
    }
  }
  return result;
}

TriangleMesh in_spatial_order(const TriangleMesh& mesh) {
  WeldedTriangles result{mesh.points(), triangles_of(mesh)};
  std::vector<std::uint32_t> order = spatial_order(result.points.approx(), result.triangles);
  result = reordered(result, order);
  return relinked(mesh, std::move(order), std::move(result.points), result.triangles);
}

}  // namespace algebra3d
