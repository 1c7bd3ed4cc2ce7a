#include "algebra3d/kernel/arrangement/detail/facet_slabs.h"

#include <algorithm>
#include <cmath>

#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d::arrangement {
namespace {

constexpr std::size_t kMaxFacesOfSmall = 32, kMinFacesOfLarge = 256, kMaxSlabs = 8;

/// Cosine of the angle up to which two directions are taken for one: a slab along either says as much.
constexpr double kParallel = 1 - 0x1p-20;

bool is_along_an_axis(const Vec3& normal) {
  return detail::largest(normal) > kParallel;
}

}  // namespace

// Lengths are in units of the frame, in which the large operand extends over 2^20. Corners are rounded to some 2^-52 of
// the largest coordinate, places and products by little more; another unit of 2^-8 covers underflows.
FacetSlabs::FacetSlabs(const TriangleMesh& small, const BoxHierarchy& of_small, const TriangleMesh& large,
                       const BoxHierarchy& of_large)
    : mesh_(large), hierarchy_(of_large) {
  constexpr double kFar = 0x1p100;
  if (small.face_count() > kMaxFacesOfSmall || large.face_count() < kMinFacesOfLarge) return;
  const Box3 box = unite(of_small.bounds(), of_large.bounds());
  const double size = std::max(detail::largest(box.min), detail::largest(box.max)) * of_large.frame().scale;
  if (!(size < kFar)) return;
  std::vector<Vec3> places;
  for (const Vec3& point : small.points().approx()) places.push_back(of_large.frame().place_of(point));
  for (std::uint32_t face = 0; face < small.face_count() && slabs_.size() < kMaxSlabs; ++face) {
    const auto [a, b, c] = small.triangle(FaceId(face));
    const Vec3 normal = cross(places[b] - places[a], places[c] - places[a]);
    const double length = std::sqrt(dot(normal, normal));
    if (length > 0x1p-400) add_slab((1 / length) * normal, places, 0x1p-46 * size + 0x1p-8);
  }
}

void FacetSlabs::add_slab(const Vec3& normal, const std::vector<Vec3>& places, double error) {
  const auto is_known = [&](const Slab& slab) { return std::abs(dot(slab.normal, normal)) > kParallel; };
  if (is_along_an_axis(normal) || std::ranges::any_of(slabs_, is_known)) return;
  double low = Box3::kInfinity, high = -Box3::kInfinity;
  for (const Vec3& place : places) {
    const double product = dot(normal, place);
    low = std::min(low, product);
    high = std::max(high, product);
  }
  slabs_.push_back({normal, low - error, high + error});
}

bool FacetSlabs::are_beyond(BoxHierarchy::Node node) const {
  const BoxHierarchy::Place place = hierarchy_.place(node);
  return std::ranges::any_of(slabs_, [&](const Slab& slab) {
    const double middle = dot(slab.normal, place.middle), reach = place.reach(slab.normal);
    return middle - reach > slab.high || middle + reach < slab.low;
  });
}

bool FacetSlabs::is_beyond(std::uint32_t face) const {
  const auto [a, b, c] = mesh_.triangle(FaceId(face));
  const std::vector<Vec3>& points = mesh_.points().approx();
  const BoxHierarchy::Frame& frame = hierarchy_.frame();
  const std::array corners{frame.place_of(points[a]), frame.place_of(points[b]), frame.place_of(points[c])};
  return std::ranges::any_of(slabs_, [&](const Slab& slab) {
    const double p = dot(slab.normal, corners[0]), q = dot(slab.normal, corners[1]), r = dot(slab.normal, corners[2]);
    return std::min(std::min(p, q), r) > slab.high || std::max(std::max(p, q), r) < slab.low;
  });
}

}  // namespace algebra3d::arrangement
