#include "algebra3d/kernel/distance/covering_bound.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/triangle_frame.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using Polygon = TriangleFrame::Polygon;

/// How far a piece reaches beyond a triangle, as a multiple of the distance of its middle.
constexpr long double kMargin = 1.25L;
/// Corners of pieces are rounded, and so are the distances.
constexpr double kRounding = 0x1p-58;
constexpr std::size_t kFacesPerTask = 64;

WideVec3 middle_of(const Polygon& polygon) {
  WideVec3 sum;
  for (const WideVec3& corner : polygon) sum = sum + corner;
  return (1.0L / static_cast<long double>(polygon.size())) * sum;
}

/// The set from which distances are bounded.
class Target {
 public:
  Target(const DistanceOperand& set, long double near) : hierarchy_(*set.hierarchy), near_(near) {
    triangles_.reserve(set.mesh->face_count());
    for (const FaceId face : faces(*set.mesh)) triangles_.emplace_back(set.mesh->corners(face));
  }
  /// A triangle near the point, and its distance.
  struct Neighbour {
    const TriangleFrame* triangle;
    long double distance;
  };
  Neighbour neighbour(const WideVec3& point) const;

 private:
  const BoxHierarchy& hierarchy_;
  long double near_;
  std::vector<TriangleFrame> triangles_;  // per face
};

/// The largest of the triangles that are near enough, so that pieces are large, or the nearest one if none is.
Target::Neighbour Target::neighbour(const WideVec3& point) const {
  const TriangleFrame* best = nullptr;
  long double least = 0;
  double reach = std::numeric_limits<double>::infinity();
  hierarchy_.for_each_near(Box3::of(point.rounded()), reach, [&](std::uint32_t face) {
    const TriangleFrame& triangle = triangles_[face];
    const long double distance = std::max(std::sqrt(triangle.squared_distance_of(point)), near_);
    if (best == nullptr || distance < least || (distance == least && triangle.area() > best->area())) {
      best = &triangle;
      least = distance;
      reach = static_cast<double>(least);
    }
    return reach;
  });
  return {best, least};
}

/// Cuts triangles into pieces, on one thread.
class Covering {
 public:
  explicit Covering(const Target& target) : target_(target) {}

  void add(const TriangleRef& corners) {
    open_.push_back({WideVec3(corners[0].approx), WideVec3(corners[1].approx), WideVec3(corners[2].approx)});
  }
  bool is_done() const { return open_.empty(); }
  /// Takes the next piece into account, or a part of it.
  void step() {
    Polygon piece = std::move(open_.back());
    open_.pop_back();
    const auto [triangle, distance] = target_.neighbour(middle_of(piece));
    const Polygon part = triangle->clip(std::move(piece), kMargin * distance, open_);
    farthest_ = std::max(farthest_, std::sqrt(triangle->squared_distance_of(part)));
  }
  long double farthest() const { return farthest_; }

 private:
  const Target& target_;
  std::vector<Polygon> open_;
  long double farthest_ = 0;
};

}  // namespace

Result<std::optional<double>> covering_bound(const TriangleMesh& from, const DistanceOperand& to, double enough,
                                             std::size_t max_pieces, const Monitor& monitor) {
  if (from.face_count() == 0) return std::optional(0.0);
  if (to.mesh->face_count() == 0) return std::optional<double>();
  const Target target(to, enough / (2 * kMargin));
  std::atomic<std::size_t> pieces = 0;
  const auto farthest = parallel_collect(from.face_count(), kFacesPerTask, [&](std::size_t begin, std::size_t end) {
    Covering covering(target);
    for (std::size_t i = begin; i < end; ++i) {
      covering.add(from.corners(FaceId(i)));
      while (!covering.is_done() && pieces++ < max_pieces && !monitor.is_cancelled()) covering.step();
    }
    return std::vector{covering.farthest()};
  });
  A3D_TRY(monitor.check());
  if (pieces > max_pieces) return std::optional<double>();
  const Box3 box = unite(Box3::around(from.points().approx()), to.hierarchy->bounds());
  const double largest = std::max({-box.min.x, -box.min.y, -box.min.z, box.max.x, box.max.y, box.max.z});
  const auto bound = static_cast<double>(std::ranges::max(farthest) + kRounding * largest);
  return std::optional(std::nextafter(bound, Box3::kInfinity));
}

}  // namespace algebra3d
