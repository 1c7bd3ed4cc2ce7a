#include "algebra3d/distance/detail/candidate_search.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>

#include "algebra3d/distance/detail/near_pair.h"
#include "algebra3d/distance/detail/slabs.h"

namespace algebra3d::distances {
namespace {

class CandidateSearch {
 public:
  CandidateSearch(const DistanceOperand& a, const DistanceOperand& b, double reach, double enough)
      : a_(a),
        b_(b),
        rounded_(unite(a.hierarchy->bounds(), b.hierarchy->bounds())),
        slabs_(a, b),
        nearest_(reach),
        enough_(enough) {}

  /// Takes a pair into account, and returns the distance beyond which pairs are of no interest: negative if the pair is
  /// enough.
  double visit(FaceId first, FaceId second) {
    ++visits_;
    if (slabs_.distance(first, second) > nearest_) return nearest_;
    const DistanceBounds bounds = this->bounds(first, second);
    if (bounds.lower > nearest_) return nearest_;
    if (bounds.upper < nearest_) improve(bounds);
    candidates_.push_back({first, second, bounds});
    if (candidates_.size() > 2 * kept_ + kFew) drop_distant();
    return bounds.upper <= enough_ ? -1 : nearest_;
  }

  /// Takes a near pair into account before the search, if the sets are large: a bound and a direction from the
  /// beginning spare most pairs of nodes.
  void begin() {
    constexpr std::size_t kMany = 256;
    if (std::min(a_.hierarchy->face_count(), b_.hierarchy->face_count()) < kMany) return;
    const auto pair = near_pair(a_, b_, rounded_);
    if (!pair) return;
    // Also where the pair is beyond the reach, its direction is a good one.
    slabs_.turn(bounds(pair->first, pair->second).direction);
    visit(pair->first, pair->second);
  }

  /// The distance beyond which pairs are of no interest.
  double reach() const { return nearest_; }

  /// True if no faces of two nodes are of interest.
  bool are_apart(BoxHierarchy::Node first, BoxHierarchy::Node second) {
    return slabs_.distance(first, second) > nearest_;
  }

  std::vector<CandidatePair> take();

 private:
  DistanceBounds bounds(FaceId first, FaceId second) const {
    return rounded_.bounds(Simplex::of_face(*a_.mesh, first), Simplex::of_face(*b_.mesh, second));
  }

  /// Keeps the bound of the nearest pair so far, and turns the slabs to its direction, unless the bound has changed
  /// little and they were turned not long ago.
  void improve(const DistanceBounds& bounds) {
    constexpr double kMuch = 0.99;
    constexpr std::uint64_t kWhile = 256;
    nearest_ = bounds.upper;
    if (nearest_ > kMuch * nearest_of_slabs_ && visits_ < visits_of_slabs_ + kWhile) return;
    slabs_.turn(bounds.direction);
    nearest_of_slabs_ = nearest_;
    visits_of_slabs_ = visits_;
  }

  static constexpr std::size_t kFew = 64;

  void drop_distant() {
    std::erase_if(candidates_, [this](const CandidatePair& pair) { return pair.bounds.lower > nearest_; });
    kept_ = candidates_.size();
  }

  const DistanceOperand &a_, &b_;
  RoundedDistances rounded_;
  Slabs slabs_;
  double nearest_, enough_;
  double nearest_of_slabs_ = std::numeric_limits<double>::infinity();  // when they were turned
  std::uint64_t visits_ = 0, visits_of_slabs_ = 0;
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
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  return search.take();
}

}  // namespace algebra3d::distances
