#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/distance/detail/rounded_closest.h"
#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/search/oriented_boxes.h"

namespace algebra3d::distances {

/// A point whose distance from a set is known.
using SampleId = StrongId<struct SampleTag>;

/// Points with bounds of their distances from a set of triangles. Points are kept; ids are handed out in order.
class SampledSet {
 public:
  /// `box` holds all points and the set.
  SampledSet(const DistanceOperand& to, const Box3& box) : to_(to), rounded_(box) {}

  /// A point with its distance.
  struct Sample {
    ExactPoint point;
    FaceId nearest;               // of the set
    double lower = 0, upper = 0;  // bounds of the distance
    std::uint32_t work = 0;       // number of faces that it was compared with
  };

  /// Measures a point; `near` are faces of the set that are probably near it, at least one; those from an invalid id on
  /// do not count. Once a face shows that the distance is at most `enough`, the sample has that upper bound, no lower
  /// one, and that face as nearest. Callable by several threads.
  Sample measured(ExactPoint point, std::span<const FaceId> near, double enough = -1) const;
  SampleId add(Sample sample) {
    samples_.push_back(std::move(sample));
    return SampleId(samples_.size() - 1);
  }
  /// The number of samples; those that are new are to be set.
  void resize(std::size_t count) { samples_.resize(count); }
  void set(SampleId id, Sample sample) { samples_[id.index()] = std::move(sample); }
  const Sample& operator[](SampleId id) const { return samples_[id.index()]; }
  /// Bounds of the distance of a sample from one face.
  DistanceBounds bounds(SampleId id, FaceId face) const { return bounds(samples_[id.index()].point, face); }
  DistanceBounds bounds(const PointRef& point, FaceId face) const;
  /// Makes the bounds of a sample those of its exact distance.
  void make_exact(SampleId id);
  /// The squared distance of a sample, and the face that is nearest to it: exact.
  std::pair<Rational, FaceId> exact_distance(SampleId id) const;

 private:
  OrientedGaps gaps_from(const PointRef& point) const;

  DistanceOperand to_;
  RoundedDistances rounded_;
  std::vector<Sample> samples_;
};

}  // namespace algebra3d::distances
