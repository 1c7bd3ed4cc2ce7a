#include "algebra3d/rounding/detail/feature_snapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "algebra3d/base/id_vector.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/rounding/detail/crossing_faces.h"
#include "algebra3d/rounding/detail/near_features.h"

namespace algebra3d {
namespace {

constexpr int kMaxSnappingRounds = 40;
constexpr int kMaxRoundsWithoutGain = 10;
/// After so many rounds in which faces at a point cross, the reach is doubled there; and how often at most.
constexpr int kPatience = 4;
constexpr int kMaxDoublings = 5;

class FeatureSnapping {
 public:
  FeatureSnapping(const TriangleMesh& mesh, double reach, const CoordinateGrid& grid, const std::atomic<bool>* cancel)
      : faces_(mesh), reach_(reach), grid_(grid), cancel_(cancel) {}

  Result<FeatureSnappedMesh> run();

 private:
  double reach_of(const FacePair& pair) const;
  void count_crossings(const std::vector<FacePair>& pairs);
  FeatureJoins joins_of(const std::vector<FacePair>& pairs);
  std::vector<std::size_t> collinear_faces() const;

  SnappedFaces faces_;
  double reach_;
  const CoordinateGrid& grid_;
  const std::atomic<bool>* cancel_;
  IdVector<PointId, int> rounds_with_crossings_;
};

void FeatureSnapping::count_crossings(const std::vector<FacePair>& pairs) {
  rounds_with_crossings_.resize(faces_.point_count());
  std::vector<PointId> points;
  for (const auto& [f, g] : pairs)
    for (const std::size_t face : {f, g})
      points.insert(points.end(), faces_.corners(face).begin(), faces_.corners(face).end());
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const PointId p : points) ++rounds_with_crossings_[p];
}

double FeatureSnapping::reach_of(const FacePair& pair) const {
  int most = 0;
  for (const std::size_t face : {pair.first, pair.second})
    for (const PointId p : faces_.corners(face)) most = std::max(most, rounds_with_crossings_[p]);
  return std::ldexp(reach_, std::min(most / kPatience, kMaxDoublings));
}

std::vector<std::size_t> FeatureSnapping::collinear_faces() const {
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto [a, b, c] = faces_.triangle(f);
    if (faces_.is_open(f) && collinear(a, b, c)) found.push_back(f);
  }
  return found;
}

FeatureJoins FeatureSnapping::joins_of(const std::vector<FacePair>& pairs) {
  FeatureJoins joins;
  count_crossings(pairs);
  for (const FacePair& pair : pairs) join_near_features(faces_, pair.first, pair.second, reach_of(pair), grid_, joins);
  return joins;
}

Result<FeatureSnappedMesh> FeatureSnapping::run() {
  FeatureSnappedMesh best;
  std::size_t fewest = SIZE_MAX;
  faces_.drop_empty_faces();
  for (int round = 0, last_gain = 0; round < kMaxSnappingRounds && round - last_gain <= kMaxRoundsWithoutGain;
       ++round) {
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::vector<FacePair> pairs, crossing_faces(faces_, cancel_));
    const std::vector<std::size_t> flat = collinear_faces();
    const std::size_t count = pairs.size() + flat.size();
    if (count < fewest) {
      best = {faces_.mesh(), faces_.largest_displacement(), pairs.size()};
      fewest = count;
      last_gain = round;
    }
    const bool is_hopeless = count > 4 * fewest + 20;
    FeatureJoins joins = joins_of(pairs);
    for (const std::size_t face : flat) join_collinear_corners(faces_, face, joins);
    if (is_hopeless || joins.is_empty()) break;
    std::vector<std::size_t> open = flat;
    for (const auto& [f, g] : pairs) open.insert(open.end(), {f, g});
    faces_.close_all_but(open);
    faces_.apply(std::move(joins));
  }
  return best;
}

}  // namespace

Result<FeatureSnappedMesh> snap_features(const TriangleMesh& mesh, double reach, const CoordinateGrid& grid,
                                         const std::atomic<bool>* cancel) {
  return FeatureSnapping(mesh, reach, grid, cancel).run();
}

}  // namespace algebra3d
