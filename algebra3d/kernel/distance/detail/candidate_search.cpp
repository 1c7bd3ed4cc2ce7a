#include "algebra3d/kernel/distance/detail/candidate_search.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>

#include "algebra3d/kernel/distance/detail/near_pair.h"
#include "algebra3d/kernel/distance/detail/separation.h"
#include "algebra3d/kernel/search/node_gaps.h"
#include "algebra3d/kernel/search/slab_gaps.h"
#include "base/propagate.h"

namespace algebra3d::distances {
namespace {

class CandidateSearch {
 public:
  CandidateSearch(const DistanceOperand& a, const DistanceOperand& b, double reach, double enough)
      : a_(a),
        b_(b),
        rounded_(unite(a.hierarchy->bounds(), b.hierarchy->bounds())),
        separation_(a, b),
        gaps_(*a.mesh, *a.hierarchy, *b.mesh, *b.hierarchy),
        slab_gaps_(*a.mesh, *a.hierarchy, *b.mesh, *b.hierarchy),
        nearest_(reach),
        enough_(enough) {}

  /// Takes a pair into account, and returns the distance beyond which pairs are of no interest: negative if the pair is
  /// enough.
  double visit(FaceId first, FaceId second) {
    ++visits_;
    gaps_.note_visit();
    if (separation_.keeps_apart(first, second, nearest_)) return nearest_;
    if (++measured_ == kLong) start_from_parts();
    const DistanceBounds bounds = this->bounds(first, second);
    // Also of a pair beyond the reach, the direction is a good one.
    if (bounds.upper < closest_) turn_separation(bounds);
    if (bounds.lower > nearest_) return nearest_;
    nearest_ = std::min(nearest_, bounds.upper);
    candidates_.push_back({first, second, bounds});
    if (candidates_.size() > 2 * kept_ + kFew) drop_distant();
    return bounds.upper <= enough_ ? -1 : nearest_;
  }

  /// Takes a near pair into account before the search, if the sets are large: a bound and a direction from the
  /// beginning spare most pairs of nodes.
  void begin() {
    constexpr std::size_t kMany = 256;
    if (std::min(a_.hierarchy->face_count(), b_.hierarchy->face_count()) < kMany) return;
    start_from(b_.hierarchy->root());
  }

  /// The distance beyond which pairs are of no interest.
  double reach() const { return nearest_; }

  /// True if no faces of two nodes are of interest.
  bool are_apart(BoxHierarchy::Node first, BoxHierarchy::Node second) {
    return separation_.keeps_apart(first, second, nearest_) || slab_gaps_.exceed(first, second, nearest_) ||
           gaps_.exceed(first, second, nearest_);
  }

  std::vector<CandidatePair> take();

 private:
  /// Pairs of faces that are measured before a search is long: the sets are near each other in many places.
  static constexpr std::uint64_t kLong = 1024;

  void start_from(BoxHierarchy::Node node) {
    const Box3 box = b_.hierarchy->bounds(node);
    if (const auto pair = near_pair(a_, b_, 0.5 * box.min + 0.5 * box.max, rounded_)) visit(pair->first, pair->second);
  }

  /// From up to 16 parts of the second set: the pair that is nearest to the middle may be far from the nearest one.
  void start_from_parts() {
    constexpr std::uint32_t kLevels = 4;
    const std::uint32_t top = b_.hierarchy->root().level, level = top - std::min(top, kLevels);
    for (std::uint32_t index = 0; index < b_.hierarchy->node_count(level); ++index) start_from({level, index});
  }

  DistanceBounds bounds(FaceId first, FaceId second) const {
    return rounded_.bounds(Simplex::of_face(*a_.mesh, first), Simplex::of_face(*b_.mesh, second));
  }

  /// Turns the separation to the direction of the closest pair so far, unless it is little closer than that of its
  /// direction and it was turned not long ago.
  void turn_separation(const DistanceBounds& bounds) {
    constexpr double kMuch = 0.99;
    constexpr std::uint64_t kWhile = 256;
    closest_ = bounds.upper;
    if (closest_ > kMuch * closest_of_separation_ && visits_ < visits_of_separation_ + kWhile) return;
    separation_.turn(bounds.direction);
    closest_of_separation_ = closest_;
    visits_of_separation_ = visits_;
  }

  static constexpr std::size_t kFew = 64;

  void drop_distant() {
    std::erase_if(candidates_, [this](const CandidatePair& pair) { return pair.bounds.lower > nearest_; });
    kept_ = candidates_.size();
  }

  const DistanceOperand &a_, &b_;
  RoundedDistances rounded_;
  Separation separation_;
  NodeGaps gaps_;
  SlabGaps slab_gaps_;
  double nearest_, enough_;
  double closest_ = std::numeric_limits<double>::infinity();                // pair so far, also beyond `nearest_`
  double closest_of_separation_ = std::numeric_limits<double>::infinity();  // when they were turned
  std::uint64_t visits_ = 0, visits_of_separation_ = 0, measured_ = 0;
  std::vector<CandidatePair> candidates_;
  std::size_t kept_ = 0;  // after the last time when distant ones were dropped
};

std::vector<CandidatePair> CandidateSearch::take() {
  drop_distant();
  std::ranges::sort(candidates_, {},
                    [](const CandidatePair& pair) { return std::tuple(pair.bounds.lower, pair.first, pair.second); });
  return std::move(candidates_);
}

}  // namespace

Result<std::vector<CandidatePair>> find_candidates(const DistanceOperand& a, const DistanceOperand& b, double reach,
                                                   double enough, const Monitor& monitor) {
  CandidateSearch search(a, b, reach, enough);
  search.begin();
  a.hierarchy->for_each_near_pair_with(
      *b.hierarchy, search.reach(),
      [&](std::uint32_t first, std::uint32_t second) { return search.visit(FaceId(first), FaceId(second)); },
      [&](BoxHierarchy::Node first, BoxHierarchy::Node second) { return search.are_apart(first, second); },
      [&] { return !monitor.is_cancelled(); });
  A3D_TRY(monitor.check());
  return search.take();
}

}  // namespace algebra3d::distances
