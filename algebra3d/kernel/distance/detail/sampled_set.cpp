#include "algebra3d/kernel/distance/detail/sampled_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace algebra3d::distances {

DistanceBounds SampledSet::bounds(const PointRef& point, FaceId face) const {
  return rounded_.bounds(Simplex::of_point(point), Simplex::of_face(*to_.mesh, face));
}

OrientedGaps SampledSet::gaps_from(const PointRef& point) const {
  return {*to_.hierarchy, to_.hierarchy->oriented_boxes(*to_.mesh), point.approx};
}

SampledSet::Sample SampledSet::measured(ExactPoint point, std::span<const FaceId> near, double enough) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Sample sample{std::move(point), near.front(), kInfinity, kInfinity, 0};
  const PointRef place = sample.point;
  const auto visit = [&](FaceId other) {
    ++sample.work;
    const DistanceBounds bounds = this->bounds(place, other);
    sample.lower = std::min(sample.lower, bounds.lower);
    if (bounds.upper < sample.upper) {
      sample.upper = bounds.upper;
      sample.nearest = other;
    }
    return sample.upper > enough ? sample.upper : -1;
  };
  for (const FaceId face : near)
    if (face.is_none() || visit(face) < 0) break;
  if (sample.upper > enough)
    to_.hierarchy->for_each_near(box_of(place), sample.upper, gaps_from(place),
                                 [&](std::uint32_t other) { return visit(FaceId(other)); });
  if (sample.upper <= enough) sample.lower = 0;
  return sample;
}

void SampledSet::make_exact(SampleId id) {
  const auto [squared_distance, nearest] = exact_distance(id);
  const double root = squared_distance.nearest_root();
  Sample& sample = samples_[id.index()];
  sample.nearest = nearest;
  sample.lower = std::nextafter(root, 0.0);
  sample.upper = std::nextafter(root, std::numeric_limits<double>::infinity());
}

std::pair<Rational, FaceId> SampledSet::exact_distance(SampleId id) const {
  const Sample& sample = samples_[id.index()];
  const PointRef place = sample.point;
  const auto measured = [&](FaceId face, const ClosestFeatures& likely) {
    const Simplex simplex = Simplex::of_face(*to_.mesh, face);
    return std::pair(exact_closest(Simplex::of_point(place), simplex, likely).squared_distance, face);
  };
  std::pair<Rational, FaceId> nearest = measured(sample.nearest, bounds(place, sample.nearest).features);
  to_.hierarchy->for_each_near(box_of(place), sample.upper, gaps_from(place), [&](std::uint32_t other) {
    const FaceId face(other);
    const DistanceBounds bounds = this->bounds(place, face);
    if (face != sample.nearest && bounds.lower <= sample.upper)
      nearest = std::min(std::move(nearest), measured(face, bounds.features));
    return sample.upper;
  });
  return nearest;
}

}  // namespace algebra3d::distances
