#pragma once

#include <functional>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/distance/detail/rounded_closest.h"
#include "algebra3d/distance/distance.h"

namespace algebra3d::distances {

/// A point whose distance from a set is known.
using SampleId = StrongId<struct SampleTag>;

/// Points with bounds of their distances from a set of triangles. Points are kept; ids are handed out in order.
class SampledSet {
 public:
  using Counts = std::function<bool(const PointRef& point)>;

  /// `box` holds all points and the set.
  SampledSet(const DistanceOperand& to, const Box3& box, Counts counts)
      : to_(to), bounds_of_set_(to.hierarchy->bounds()), rounded_(box), counts_(std::move(counts)) {}

  /// A point with its distance. It counts if it is on the side that is asked for (FarthestSearch).
  struct Sample {
    ExactPoint point;
    FaceId face;     // in which it lies
    FaceId nearest;  // of the set
    double lower = 0, upper = 0;  // bounds of the distance
    bool counts = true;
  };

  /// Measures a point of a face; `near` is a face of the set that is probably near it. Of a point that does not count,
  /// and is outside the box of the set, only a lower bound is found. Callable by several threads.
  Sample measured(ExactPoint point, FaceId face, FaceId near) const;
  SampleId add(Sample sample) {
    samples_.push_back(std::move(sample));
    return SampleId(samples_.size() - 1);
  }
  const Sample& operator[](SampleId id) const { return samples_[id.index()]; }
  /// Bounds of the distance of a sample from one face.
  DistanceBounds bounds(SampleId id, FaceId face) const { return bounds(samples_[id.index()].point, face); }
  DistanceBounds bounds(const PointRef& point, FaceId face) const;
  bool has_sides() const { return counts_ != nullptr; }
  /// The squared distance of a sample, and the face that is nearest to it: exact.
  std::pair<Rational, FaceId> exact_distance(SampleId id) const;

 private:
  DistanceOperand to_;
  Box3 bounds_of_set_;
  RoundedDistances rounded_;
  Counts counts_;
  std::vector<Sample> samples_;
};

}  // namespace algebra3d::distances
