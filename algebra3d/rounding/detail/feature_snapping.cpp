#include "algebra3d/rounding/detail/feature_snapping.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/exact/predicates.h"
#include "algebra3d/rounding/detail/crossing_faces.h"
#include "algebra3d/rounding/detail/near_features.h"

namespace algebra3d {
namespace {

/// The reach at level 0, in spacings. It is doubled from level to level.
constexpr double kLeastReach = 2;
/// So many rounds are made at a level, and so many of these without fewer crossings than ever.
constexpr int kMaxSnappingRounds = 40;
constexpr int kMaxRoundsWithoutGain = 10;

/// Clusters that are given up with no more crossings stay as they are; others are restored.
constexpr std::size_t kFewCrossings = 20;

/// How a cluster gets on at its level.
struct Progress {
  int level = 0;
  int rounds = 0, last_gain = 0;
  std::size_t crossings = 0, fewest = SIZE_MAX;
  bool can_join = true;  // something was joined in the last round

  void count_round() {
    ++rounds;
    if (crossings >= fewest) return;
    fewest = crossings;
    last_gain = rounds;
  }
  bool is_hopeless() const {
    return crossings > 0 && (!can_join || rounds > kMaxSnappingRounds || rounds - last_gain > kMaxRoundsWithoutGain ||
                             crossings > 4 * fewest + 20);
  }
  /// In spacings of the grid.
  double reach() const { return std::ldexp(kLeastReach, level); }
};

/// The faults of the faces that are left to mend.
struct Faults {
  std::vector<FacePair> pairs;          ///< faces that cross
  std::vector<std::size_t> flat_faces;  ///< faces without area
};

class FeatureSnapping {
 public:
  FeatureSnapping(const TriangleMesh& mesh, const CoordinateGrid& grid, double spacing, double largest_reach,
                  const std::atomic<bool>* cancel, Folded folded)
      : faces_(mesh, folded), grid_(grid), spacing_(spacing), largest_reach_(largest_reach), cancel_(cancel) {}

  Result<FeatureSnappedMesh> run();

 private:
  bool is_given_up(const Progress& progress) const { return progress.reach() > largest_reach_; }
  PointId cluster_of(std::size_t face) { return faces_.cluster_of(faces_.corners(face)[0]); }
  Result<Faults> find_faults(const CrossingSearch& search) const;
  void tie_clusters(const std::vector<FacePair>& pairs);
  void note_progress(const Faults& faults);
  std::vector<PointId> raise_hopeless_clusters(Faults& faults);
  FeatureJoins joins_of(const Faults& faults);

  SnappedFaces faces_;
  CoordinateGrid grid_;
  double spacing_, largest_reach_;
  const std::atomic<bool>* cancel_;
  std::map<PointId, Progress> progress_;  // of clusters that cross, or did
  double reached_ = 0;                    // the largest reach used, in coordinate units
};

Result<Faults> FeatureSnapping::find_faults(const CrossingSearch& search) const {
  Faults faults;
  ALGEBRA3D_ASSIGN_OR_RETURN(faults.pairs, search.find(cancel_));
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_.is_open(f)) continue;
    const auto [a, b, c] = faces_.triangle(f);
    if (collinear(a, b, c)) faults.flat_faces.push_back(f);
  }
  return faults;
}

/// Faces that cross are of one cluster. Clusters that became one begin anew, at the highest of their levels.
void FeatureSnapping::tie_clusters(const std::vector<FacePair>& pairs) {
  for (const auto& [f, g] : pairs) faces_.tie(faces_.corners(f)[0], faces_.corners(g)[0]);
  std::map<PointId, Progress> progress;
  for (const auto& [old_cluster, old] : progress_) {
    const auto [entry, is_new] = progress.try_emplace(faces_.cluster_of(old_cluster), old);
    if (!is_new)
      entry->second = {.level = std::max(entry->second.level, old.level),
                       .crossings = entry->second.crossings + old.crossings};
  }
  progress_ = std::move(progress);
}

void FeatureSnapping::note_progress(const Faults& faults) {
  for (auto& [cluster, progress] : progress_)
    if (!is_given_up(progress)) progress.crossings = 0;
  for (const FacePair& pair : faults.pairs) ++progress_[cluster_of(pair.first)].crossings;
  for (const std::size_t face : faults.flat_faces) ++progress_[cluster_of(face)].crossings;
  for (auto& [cluster, progress] : progress_)
    if (progress.crossings > 0 && !is_given_up(progress)) progress.count_round();
}

/// Raises the levels of the clusters that do not get on, and returns those that are to be restored; those that
/// are given up at the last level with few crossings stay as they are. Removes the faults of all these.
std::vector<PointId> FeatureSnapping::raise_hopeless_clusters(Faults& faults) {
  std::vector<PointId> raised;
  for (auto& [cluster, progress] : progress_) {
    if (is_given_up(progress) || !progress.is_hopeless()) continue;
    const bool has_few = progress.crossings <= kFewCrossings;
    progress = {.level = progress.level + 1, .crossings = progress.crossings};
    if (!is_given_up(progress) || !has_few) raised.push_back(cluster);
  }
  const auto is_left_out = [&](std::size_t face) {
    const PointId cluster = cluster_of(face);
    return std::ranges::binary_search(raised, cluster) || is_given_up(progress_[cluster]);
  };
  std::erase_if(faults.pairs, [&](const FacePair& pair) { return is_left_out(pair.first); });
  std::erase_if(faults.flat_faces, is_left_out);
  return raised;
}

FeatureJoins FeatureSnapping::joins_of(const Faults& faults) {
  FeatureJoins joins;
  for (const FacePair& pair : faults.pairs) progress_[cluster_of(pair.first)].can_join = false;
  for (const FacePair& pair : faults.pairs) {
    Progress& progress = progress_[cluster_of(pair.first)];
    const double reach = progress.reach() * spacing_;
    const CoordinateGrid grid = progress.level == 0 ? grid_ : CoordinateGrid::multiples(reach / kLeastReach);
    reached_ = std::max(reached_, reach);
    progress.can_join |= join_near_features(faces_, pair.first, pair.second, reach, grid, joins);
  }
  for (const std::size_t face : faults.flat_faces) {
    join_collinear_corners(faces_, face, joins);
    progress_[cluster_of(face)].can_join = true;
  }
  return joins;
}

Result<FeatureSnappedMesh> FeatureSnapping::run() {
  const CrossingSearch search(faces_);
  std::size_t crossings_before = 0;
  for (int round = 0;; ++round) {
    ALGEBRA3D_ASSIGN_OR_RETURN(Faults faults, find_faults(search));
    if (round == 0) crossings_before = faults.pairs.size();
    tie_clusters(faults.pairs);
    note_progress(faults);
    const std::vector<PointId> raised = raise_hopeless_clusters(faults);
    if (faults.pairs.empty() && faults.flat_faces.empty() && raised.empty()) break;
    FeatureJoins joins = joins_of(faults);
    std::vector<std::size_t> open = faults.flat_faces;
    for (const auto& [f, g] : faults.pairs) open.insert(open.end(), {f, g});
    faces_.close_all_but(open);
    faces_.apply(std::move(joins));
    faces_.restore(raised);
  }
  FeatureSnappedMesh result{faces_.mesh(), faces_.largest_displacement(), reached_, crossings_before};
  for (const auto& [cluster, progress] : progress_)
    if (is_given_up(progress)) result.crossing_pairs += progress.crossings;
  return result;
}

}  // namespace

Result<FeatureSnappedMesh> snap_features(const TriangleMesh& mesh, const CoordinateGrid& grid, double spacing,
                                         double largest_reach, const std::atomic<bool>* cancel, Folded folded) {
  return FeatureSnapping(mesh, grid, spacing, largest_reach, cancel, folded).run();
}

}  // namespace algebra3d
