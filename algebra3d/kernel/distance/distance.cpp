#include "algebra3d/kernel/distance/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "algebra3d/kernel/distance/detail/candidate_search.h"
#include "algebra3d/kernel/distance/detail/exact_closest.h"
#include "algebra3d/kernel/distance/detail/half_space.h"
#include "algebra3d/kernel/exact/plane.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using distances::CandidatePair;
using distances::ExactClosest;
using distances::Simplex;

/// Which vertices of a mesh lie on the far side of a plane, or in it: those of each set beyond the slab between two
/// points. Remembers what it was asked: faces share their corners.
class FarSide {
 public:
  FarSide(const TriangleMesh& mesh, RationalVec3 point, RationalVec3 normal)
      : mesh_(mesh), half_space_(std::move(point), std::move(normal)) {}

  bool has(FaceId face) {
    return std::ranges::all_of(mesh_.triangle(face), [this](std::uint32_t corner) { return has(VertexId(corner)); });
  }

 private:
  bool has(VertexId vertex) {
    const auto [entry, is_new] = known_.try_emplace(vertex);
    if (is_new) entry->second = half_space_.has(mesh_.point(vertex));
    return entry->second;
  }

  const TriangleMesh& mesh_;
  distances::HalfSpace half_space_;
  std::unordered_map<VertexId, bool> known_;
};

/// Chooses the nearest of the candidates. Those whose faces lie beyond the slab between the nearest points so far are
/// not nearer, which two products decide: so it is with parallel faces, which are all at one distance.
class ExactChoice {
 public:
  ExactChoice(const DistanceOperand& a, const DistanceOperand& b) : a_(*a.mesh), b_(*b.mesh) {}

  /// Ends at points whose squared distance is at most `enough`.
  void choose(std::span<const CandidatePair> candidates, const Rational& enough) {
    for (const CandidatePair& pair : candidates) {
      if (best_ && (pair.bounds.lower > upper_bound_ || best_->squared_distance <= enough)) return;
      if (best_ && first_side_->has(pair.first) && second_side_->has(pair.second)) continue;
      take_if_nearer(pair);
    }
  }
  /// Nothing if there was no candidate.
  std::optional<Rational> squared_distance() const {
    return best_ ? std::optional(best_->squared_distance) : std::nullopt;
  }
  std::optional<ClosestPoints> points() const {
    if (!best_) return std::nullopt;
    return ClosestPoints{ExactPoint(best_->first), ExactPoint(best_->second), best_->squared_distance, faces_.first,
                         faces_.second};
  }

 private:
  void take_if_nearer(const CandidatePair& pair) {
    ExactClosest points =
        exact_closest(Simplex::of_face(a_, pair.first), Simplex::of_face(b_, pair.second), pair.bounds.features);
    if (best_ && points.squared_distance >= best_->squared_distance) return;
    first_side_.emplace(a_, points.first, points.first - points.second);
    second_side_.emplace(b_, points.second, points.second - points.first);
    // The root is rounded to nearest.
    upper_bound_ = std::nextafter(points.squared_distance.nearest_root(), std::numeric_limits<double>::infinity());
    best_ = std::move(points);
    faces_ = {pair.first, pair.second};
  }

  const TriangleMesh &a_, &b_;
  std::optional<ExactClosest> best_;
  std::pair<FaceId, FaceId> faces_;  // that have these points
  double upper_bound_ = 0;
  std::optional<FarSide> first_side_, second_side_;
};

/// The nearest of all candidates.
Result<ExactChoice> choice_of(const DistanceOperand& a, const DistanceOperand& b, const Monitor& monitor) {
  ExactChoice choice(a, b);
  if (a.mesh->is_empty() || b.mesh->is_empty()) return choice;
  constexpr double kAnywhere = std::numeric_limits<double>::infinity(), kNothing = -1;
  A3D_ASSIGN(const std::vector<CandidatePair> candidates,
             distances::find_candidates(a, b, kAnywhere, kNothing, monitor));
  choice.choose(candidates, 0);
  return choice;
}

}  // namespace

Result<std::optional<ClosestPoints>> closest_points(const DistanceOperand& a, const DistanceOperand& b,
                                                    const Monitor& monitor) {
  A3D_ASSIGN(const ExactChoice choice, choice_of(a, b, monitor));
  return choice.points();
}

Result<std::optional<Rational>> squared_distance(const DistanceOperand& a, const DistanceOperand& b,
                                                 const Monitor& monitor) {
  A3D_ASSIGN(const ExactChoice choice, choice_of(a, b, monitor));
  return choice.squared_distance();
}

// The distance is that of one of the candidates, which are ordered by their lower bounds.
Result<std::optional<DistanceRange>> distance_range(const DistanceOperand& a, const DistanceOperand& b, double reach,
                                                    const Monitor& monitor) {
  if (a.mesh->is_empty() || b.mesh->is_empty()) return std::optional<DistanceRange>();
  constexpr double kNothing = -1;
  A3D_ASSIGN(const std::vector<CandidatePair> candidates, distances::find_candidates(a, b, reach, kNothing, monitor));
  if (candidates.empty()) return std::optional<DistanceRange>();
  DistanceRange range{candidates.front().bounds.lower, std::numeric_limits<double>::infinity()};
  for (const CandidatePair& pair : candidates) range.upper = std::min(range.upper, pair.bounds.upper);
  return std::optional(range);
}

Result<bool> are_within(const DistanceOperand& a, const DistanceOperand& b, const Rational& distance,
                        const Monitor& monitor) {
  if (a.mesh->is_empty() || b.mesh->is_empty()) return false;
  const double enough = distance.lower_double();
  A3D_ASSIGN(const std::vector<CandidatePair> candidates,
             distances::find_candidates(a, b, distance.upper_double(), enough, monitor));
  for (const CandidatePair& pair : candidates)
    if (pair.bounds.upper <= enough) return true;
  const Rational squared = distance * distance;
  ExactChoice choice(a, b);
  choice.choose(candidates, squared);
  const std::optional<Rational> least = choice.squared_distance();
  return least && *least <= squared;
}

}  // namespace algebra3d
