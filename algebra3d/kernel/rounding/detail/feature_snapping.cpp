#include "algebra3d/kernel/rounding/detail/feature_snapping.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/rounding/detail/crossing_faces.h"
#include "algebra3d/kernel/rounding/detail/near_features.h"
#include "base/id_vector.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The reach at level 0, in spacings. It is doubled from level to level. Levels differ from place to place.
constexpr double kLeastReach = 2;
/// Distances up to so many spacings need no better bound.
constexpr double kSmallDistance = 4;

/// So many rounds are made at a level, and so many of these without fewer crossings than ever.
constexpr int kMaxSnappingRounds = 40;
constexpr int kMaxRoundsWithoutGain = 10;
/// After so many rounds no cluster begins again.
constexpr int kMaxRoundsTogether = 400;

/// Clusters that are given up with no more crossings stay as they are; others are restored.
constexpr std::size_t kFewCrossings = 20;

/// A cluster with more crossings than so many, and so many times the given faces, is folded: to join features would
/// multiply its faces by as much, round by round.
constexpr std::size_t kManyCrossings = 100;
constexpr std::size_t kMostCrossingsPerFace = 3;

/// With so many times the crossings at first, and so many more, joining makes more of them than it takes away.
constexpr std::size_t kMostGrowth = 2;
constexpr std::size_t kManyMoreCrossings = 1000;

/// How a cluster gets on.
struct Progress {
  int rounds = 0, last_gain = 0;
  std::size_t crossings = 0, fewest = SIZE_MAX;
  bool can_join = true;  // something was joined in the last round
  bool is_given_up = false;

  void count_round() {
    ++rounds;
    if (crossings >= fewest) return;
    fewest = crossings;
    last_gain = rounds;
  }
  bool is_hopeless(std::size_t given_faces) const {
    return crossings > 0 &&
           (!can_join || rounds > kMaxSnappingRounds || rounds - last_gain > kMaxRoundsWithoutGain ||
            crossings > 4 * fewest + 20 || crossings > kMostCrossingsPerFace * given_faces + kManyCrossings);
  }
  /// Begins the count of rounds again, for two clusters that became one.
  void add(const Progress& other) {
    *this = {.crossings = crossings + other.crossings,
             .fewest = fewest > SIZE_MAX - other.fewest ? SIZE_MAX : fewest + other.fewest,
             .is_given_up = is_given_up || other.is_given_up};
  }
};

/// The faults of the faces that are left to mend.
struct Faults {
  std::vector<FacePair> pairs;          ///< faces that cross
  std::vector<std::size_t> flat_faces;  ///< faces without area
};

class FeatureSnapping {
 public:
  FeatureSnapping(const TriangleMesh& mesh, const CoordinateGrid& grid, double spacing, const SnappingLimits& limits,
                  const std::atomic<bool>* cancel, Folded folded)
      : faces_(mesh, folded),
        grid_(grid),
        spacing_(spacing),
        limits_(limits),
        cancel_(cancel),
        levels_(faces_.point_count()) {}

  Result<FeatureSnappedMesh> run();

 private:
  /// Clusters that are restored, and those of them that begin again; ascending. And the faces with faults of the
  /// latter, some of which may be given ones.
  struct Left {
    std::vector<PointId> restored, again;
    std::vector<std::size_t> faces;
  };

  /// In spacings of the grid.
  static double reach_at(int level) { return std::ldexp(kLeastReach, level); }
  int level_of(std::size_t face) const;
  int level_of(const FacePair& pair) const { return std::max(level_of(pair.first), level_of(pair.second)); }
  PointId cluster_of(std::size_t face) { return faces_.cluster_of(faces_.corners(face)[0]); }
  Result<Faults> find_faults(const CrossingSearch& search) const;
  void tie_clusters(const std::vector<FacePair>& pairs);
  void note_progress(const Faults& faults);
  std::vector<PointId> hopeless_clusters() const;
  std::vector<PointId> raise_levels(const std::vector<PointId>& clusters, const Faults& faults);
  Left leave_hopeless_clusters(Faults& faults);
  Result<FeatureJoins> joins_of(const Faults& faults);

  SnappedFaces faces_;
  CoordinateGrid grid_;
  double spacing_;
  SnappingLimits limits_;
  const std::atomic<bool>* cancel_;
  IdVector<PointId, int> levels_;         // of the corners of given faces
  std::map<PointId, Progress> progress_;  // of clusters that cross, or did
  double reached_ = 0;                    // the largest reach used, in coordinate units
  int rounds_ = 0;
};

Result<Faults> FeatureSnapping::find_faults(const CrossingSearch& search) const {
  Faults faults;
  A3D_ASSIGN(faults.pairs, search.find(cancel_));
  for (const std::size_t f : faces_.open_faces()) {
    const auto [a, b, c] = faces_.triangle(f);
    if (collinear(a, b, c)) faults.flat_faces.push_back(f);
  }
  return faults;
}

/// The highest level at a corner of the given face.
int FeatureSnapping::level_of(std::size_t face) const {
  int level = 0;
  for (const PointId corner : faces_.corners(faces_.given_of(face))) level = std::max(level, levels_[corner]);
  return level;
}

/// Faces that cross are of one cluster.
void FeatureSnapping::tie_clusters(const std::vector<FacePair>& pairs) {
  for (const auto& [f, g] : pairs) faces_.tie(faces_.corners(f)[0], faces_.corners(g)[0]);
  std::map<PointId, Progress> progress;
  for (const auto& [old_cluster, old] : progress_) {
    const auto [entry, is_new] = progress.try_emplace(faces_.cluster_of(old_cluster), old);
    if (!is_new) entry->second.add(old);
  }
  progress_ = std::move(progress);
}

void FeatureSnapping::note_progress(const Faults& faults) {
  for (auto& [cluster, progress] : progress_)
    if (!progress.is_given_up) progress.crossings = 0;
  for (const FacePair& pair : faults.pairs) ++progress_[cluster_of(pair.first)].crossings;
  for (const std::size_t face : faults.flat_faces) ++progress_[cluster_of(face)].crossings;
  for (auto& [cluster, progress] : progress_)
    if (progress.crossings > 0 && !progress.is_given_up) progress.count_round();
}

/// Ascending.
std::vector<PointId> FeatureSnapping::hopeless_clusters() const {
  std::vector<PointId> clusters;
  for (const auto& [cluster, progress] : progress_)
    if (!progress.is_given_up && progress.is_hopeless(faces_.given_count())) clusters.push_back(cluster);
  return clusters;
}

/// Raises the levels where faces of some clusters cross, and returns those clusters of which some are too high now.
std::vector<PointId> FeatureSnapping::raise_levels(const std::vector<PointId>& clusters, const Faults& faults) {
  std::map<PointId, int> raised;
  std::vector<PointId> too_high;
  const auto raise = [&](std::size_t face, int level) {
    const PointId cluster = cluster_of(face);
    if (!std::ranges::binary_search(clusters, cluster)) return;
    if (reach_at(level) > limits_.largest_reach) too_high.push_back(cluster);
    for (const PointId corner : faces_.corners(faces_.given_of(face))) {
      int& to = raised[corner];
      to = std::max(to, level);
    }
  };
  for (const FacePair& pair : faults.pairs)
    for (const std::size_t face : {pair.first, pair.second}) raise(face, level_of(pair) + 1);
  for (const std::size_t face : faults.flat_faces) raise(face, level_of(face) + 1);
  for (const auto& [corner, level] : raised) levels_[corner] = std::max(levels_[corner], level);
  std::ranges::sort(too_high);
  too_high.erase(std::unique(too_high.begin(), too_high.end()), too_high.end());
  return too_high;
}

/// Restores clusters that do not get on, and raises the levels where they cross; those that are given up with few
/// crossings stay as they are. Removes the faults of all these.
FeatureSnapping::Left FeatureSnapping::leave_hopeless_clusters(Faults& faults) {
  const std::vector<PointId> hopeless = hopeless_clusters();
  const std::vector<PointId> given_up = rounds_ < kMaxRoundsTogether ? raise_levels(hopeless, faults) : hopeless;
  Left left;
  for (const PointId cluster : hopeless) {
    Progress& progress = progress_[cluster];
    progress.is_given_up = std::ranges::binary_search(given_up, cluster);
    if (!progress.is_given_up) left.again.push_back(cluster);
    if (!progress.is_given_up || progress.crossings > kFewCrossings) left.restored.push_back(cluster);
  }
  const auto begins_again = [&](std::size_t face) { return std::ranges::binary_search(left.again, cluster_of(face)); };
  for (const auto& [f, g] : faults.pairs)
    if (begins_again(f)) left.faces.insert(left.faces.end(), {f, g});
  std::ranges::copy_if(faults.flat_faces, std::back_inserter(left.faces), begins_again);
  const auto is_left_out = [&](std::size_t face) {
    const PointId cluster = cluster_of(face);
    return std::ranges::binary_search(hopeless, cluster) || progress_[cluster].is_given_up;
  };
  std::erase_if(faults.pairs, [&](const FacePair& pair) { return is_left_out(pair.first); });
  std::erase_if(faults.flat_faces, is_left_out);
  for (const PointId cluster : left.again) progress_.erase(cluster);
  return left;
}

Result<FeatureJoins> FeatureSnapping::joins_of(const Faults& faults) {
  const Monitor monitor(cancel_);
  FeatureJoins joins;
  for (const FacePair& pair : faults.pairs) progress_[cluster_of(pair.first)].can_join = false;
  for (const FacePair& pair : faults.pairs) {
    A3D_TRY(monitor.check());
    Progress& progress = progress_[cluster_of(pair.first)];
    const int level = level_of(pair);
    const double reach = reach_at(level) * spacing_;
    const CoordinateGrid grid = level == 0 ? grid_ : CoordinateGrid::multiples(reach / kLeastReach);
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
  std::size_t crossings_before = 0, work = 0;
  for (;; ++rounds_) {
    A3D_ASSIGN(Faults faults, find_faults(search));
    if (rounds_ == 0) crossings_before = faults.pairs.size();
    work += faults.pairs.size() + (rounds_ == 0 ? 0 : faces_.open_faces().size());
    const bool is_hopeless = faults.pairs.size() > kMostGrowth * crossings_before + kManyMoreCrossings;
    if (is_hopeless || crossings_before > limits_.most_crossings || work > limits_.most_work)
      return FeatureSnappedMesh{.crossings_before = crossings_before, .crossing_pairs = crossings_before, .work = work};
    tie_clusters(faults.pairs);
    note_progress(faults);
    Left left = leave_hopeless_clusters(faults);
    if (faults.pairs.empty() && faults.flat_faces.empty() && left.restored.empty()) break;
    A3D_ASSIGN(FeatureJoins joins, joins_of(faults));
    std::vector<std::size_t> open = std::move(left.faces);
    open.insert(open.end(), faults.flat_faces.begin(), faults.flat_faces.end());
    for (const auto& [f, g] : faults.pairs) open.insert(open.end(), {f, g});
    faces_.close_all_but(std::move(open));
    faces_.restore(left.restored);
    if (!left.again.empty()) faces_.untie(left.again);
    A3D_TRY(faces_.apply(std::move(joins), cancel_));
  }
  A3D_ASSIGN(const double distance, faces_.largest_distance(kSmallDistance * spacing_, cancel_));
  FeatureSnappedMesh result{faces_.mesh(), faces_.largest_displacement(), distance, reached_, crossings_before, 0,
                            work};
  for (const auto& [cluster, progress] : progress_)
    if (progress.is_given_up) result.crossing_pairs += progress.crossings;
  return result;
}

}  // namespace

Result<FeatureSnappedMesh> snap_features(const TriangleMesh& mesh, const CoordinateGrid& grid, double spacing,
                                         const SnappingLimits& limits, const std::atomic<bool>* cancel, Folded folded) {
  return FeatureSnapping(mesh, grid, spacing, limits, cancel, folded).run();
}

}  // namespace algebra3d
