#include "algebra3d/kernel/soup/spatial_order.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <compare>
#include <functional>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/halfedge/relinked.h"
#include "base/large_allocator.h"
#include "base/morton.h"
#include "base/radix_sort.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The Morton code of a face's centre. All numbers are scaled down first, so that nothing overflows.
class CentreCode {
 public:
  explicit CentreCode(std::span<const Vec3> points) {
    const Box3 box = Box3::around(points);
    if (box.is_empty()) return;
    origin_ = 0.25 * box.min;
    const Vec3 extent = 0.25 * box.max - origin_;
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (largest > 0) scale_ = static_cast<double>((1U << kMortonBits) - 1) / largest;
  }

  /// The code of a face, from the sum of its corners, each scaled by 1/4.
  std::uint64_t operator()(const Vec3& sum, double corner_count) const {
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = sum[axis] / corner_count;
      // A subnormal extent can make the scale infinite, and the product NaN: then all faces are in one place.
      const double place = (centre - origin_[axis]) * scale_;
      const bool is_inside = place >= 0 && place < static_cast<double>(1U << kMortonBits);
      cell[axis] = is_inside ? static_cast<std::uint32_t>(place) : 0;
    }
    return morton_code(cell[0], cell[1], cell[2]);
  }

 private:
  Vec3 origin_;
  double scale_ = 0;
};

struct CodedFace {
  std::uint64_t code;
  std::uint32_t face;

  friend auto operator<=>(const CodedFace&, const CodedFace&) = default;
};

constexpr unsigned kSortedBits = 33;  // of the codes, by digits: the highest; the rest concerns few faces
constexpr unsigned kShift = 3 * kMortonBits - kSortedBits;

/// Sorts runs of equal highest bits.
void sort_runs(LargeVector<CodedFace>& coded) {
  for (std::size_t first = 0, last = 0; first < coded.size(); first = last) {
    while (last < coded.size() && coded[last].code >> kShift == coded[first].code >> kShift) ++last;
    if (last - first > 1) std::ranges::sort(std::span(coded).subspan(first, last - first));
  }
}

/// Sorts by code, then by face: by digits of the highest bits, then what these leave open.
void sort_coded(LargeVector<CodedFace>& coded) {
  LargeVector<CodedFace> buffer(coded.size());
  radix_sort<kSortedBits>(std::span(coded), std::span(buffer), [](const CodedFace& f) { return f.code >> kShift; });
  sort_runs(coded);
}

/// Sorts what is in order but for a few: each that comes after a larger one is set aside with that one, and these are
/// sorted and merged. False, with nothing done, if they are many.
bool merge_sort_few(LargeVector<CodedFace>& coded) {
  const std::size_t most = coded.size() / 16;
  std::vector<CodedFace> kept, few;
  kept.reserve(coded.size());
  for (const CodedFace& f : coded) {
    if (kept.empty() || kept.back().code <= f.code) {
      kept.push_back(f);
      continue;
    }
    few.push_back(kept.back());
    few.push_back(f);
    kept.pop_back();
    if (few.size() > most) return false;
  }
  std::ranges::sort(few);
  std::ranges::merge(kept, few, coded.begin());
  return true;
}

/// The order of faces whose codes are code_of(face).
template <typename CodeOf>
std::vector<std::uint32_t> order_by_code(std::size_t face_count, const CodeOf& code_of) {
  constexpr std::size_t kFacesPerTask = 20000;
  LargeVector<CodedFace> coded(face_count);
  parallel_for(face_count, kFacesPerTask, [&](std::size_t f) {
    coded[f] = {code_of(f), static_cast<std::uint32_t>(f)};
  });
  if (!merge_sort_few(coded)) sort_coded(coded);
  std::vector<std::uint32_t> order;
  resize_large(order, face_count);
  std::ranges::transform(coded, order.begin(), &CodedFace::face);
  return order;
}

/// Numbers points by first use.
class PointNumbers {
 public:
  explicit PointNumbers(std::size_t point_count) : numbers_(point_count, kNone) { used_.reserve(point_count); }

  std::uint32_t operator()(std::uint32_t point) {
    std::uint32_t& number = numbers_[point];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(used_.size());
      used_.push_back(point);
    }
    return number;
  }
  /// The points in the order of their numbers.
  std::span<const std::uint32_t> used() const { return used_; }

 private:
  LargeVector<std::uint32_t> numbers_, used_;
};

// The corners of so many faces ahead are prefetched, since those of faces in random order lie anywhere in memory.
constexpr std::size_t kFacesAhead = 12;

void prefetch(const void* address) {
  __builtin_prefetch(address);
}

std::vector<Vec3> chosen(std::span<const Vec3> points, std::span<const std::uint32_t> indices) {
  constexpr std::size_t kPointsPerTask = 20000;
  std::vector<Vec3> result;
  resize_large(result, indices.size());
  parallel_for(indices.size(), kPointsPerTask, [&](std::size_t i) { result[i] = points[indices[i]]; });
  return result;
}

PointArray chosen(const PointArray& points, std::span<const std::uint32_t> indices) {
  if (points.exact_count() == 0) return PointArray(chosen(std::span(points.approx()), indices));
  PointArray result;
  result.reserve(indices.size());
  for (const std::uint32_t index : indices) result.push_back(points[index]);
  return result;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points,
                                         std::span<const TriangleMesh::Triangle> triangles) {
  const CentreCode code_of(points);
  return order_by_code(triangles.size(), [&](std::size_t i) {
    if (i + kFacesAhead < triangles.size())
      for (const std::uint32_t corner : triangles[i + kFacesAhead]) prefetch(&points[corner]);
    const auto& [a, b, c] = triangles[i];
    return code_of(0.25 * points[a] + 0.25 * points[b] + 0.25 * points[c], 3);
  });
}

WeldedTriangles reordered(const WeldedTriangles& welded, std::span<const std::uint32_t> order) {
  PointNumbers number(welded.points.size());
  WeldedTriangles result;
  result.triangles.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + kFacesAhead < order.size()) prefetch(&welded.triangles[order[i + kFacesAhead]]);
    const auto& [a, b, c] = welded.triangles[order[i]];
    const std::uint32_t first = number(a), second = number(b);
    result.triangles.push_back({first, second, number(c)});
  }
  result.points = chosen(welded.points, number.used());
  return result;
}

PolygonSoup in_spatial_order(const PolygonSoup& soup) {
  assert(soup.attributes == nullptr);
  const CentreCode code_of(soup.points);
  const std::vector<std::uint32_t> order = order_by_code(soup.face_count(), [&](std::size_t face) {
    if (face + kFacesAhead < soup.face_count())
      for (const std::uint32_t corner : soup.face(face + kFacesAhead)) prefetch(&soup.points[corner]);
    Vec3 sum;
    for (const std::uint32_t corner : soup.face(face)) sum = sum + 0.25 * soup.points[corner];
    return code_of(sum, static_cast<double>(soup.face(face).size()));
  });
  PointNumbers number(soup.points.size());
  PolygonSoup result;
  result.name = soup.name;
  resize_large(result.corners, soup.corners.size());
  result.face_starts.reserve(soup.face_starts.size());
  prefer_huge_pages(result.face_starts.data(), soup.face_starts.size() * sizeof(std::uint32_t));
  auto end = result.corners.begin();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + 2 * kFacesAhead < order.size()) prefetch(&soup.face_starts[order[i + 2 * kFacesAhead]]);
    if (i + kFacesAhead < order.size()) prefetch(soup.face(order[i + kFacesAhead]).data());
    end = std::ranges::transform(soup.face(order[i]), end, std::ref(number)).out;
    result.face_starts.push_back(static_cast<std::uint32_t>(end - result.corners.begin()));
  }
  result.points = chosen(soup.points, number.used());
  return result;
}

TriangleMesh in_spatial_order(const TriangleMesh& mesh) {
  WeldedTriangles result{mesh.points(), triangles_of(mesh)};
  std::vector<std::uint32_t> order = spatial_order(result.points.approx(), result.triangles);
  result = reordered(result, order);
  return relinked(mesh, std::move(order), std::move(result.points), result.triangles);
}

}  // namespace algebra3d
