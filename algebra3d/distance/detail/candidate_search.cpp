#include "algebra3d/distance/detail/candidate_search.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>

#include "algebra3d/distance/detail/slab.h"

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

  /// Looks for a near pair before the search, in which a bound and a direction from the beginning spare most pairs of
  /// nodes. From the middle of one set to the nearest point of the other, from there back, and so on: each way is
  /// shorter than the one before. Where sets are small the search itself costs no more.
  void begin() {
    constexpr std::size_t kMany = 256;
    constexpr int kRounds = 3;
    if (std::min(a_.hierarchy->face_count(), b_.hierarchy->face_count()) < kMany) return;
    const Box3 box = b_.hierarchy->bounds();
    Vec3 place = 0.5 * box.min + 0.5 * box.max;
    FaceId first, second;
    for (int round = 0; round < kRounds; ++round) {
      first = approach(a_, place);
      if (first.is_valid()) second = approach(b_, place);
      if (!first.is_valid() || !second.is_valid()) return;
    }
    // Also where the pair is beyond the reach, its direction is a good one.
    slabs_.turn(bounds(first, second).direction);
    visit(first, second);
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

  /// The face that seems nearest to the place, which moves to its nearest point, but for rounding. Invalid if distances
  /// leave the range of doubles.
  FaceId approach(const DistanceOperand& set, Vec3& place) const {
    const Vec3 start = place;
    const PointRef from(start);
    DistanceBounds best;
    best.upper = std::numeric_limits<double>::infinity();
    FaceId nearest;
    set.hierarchy->for_each_near(Box3::of(start), best.upper, [&](std::uint32_t face) {
      const DistanceBounds bounds = rounded_.bounds({{from, from, from}, 1}, Simplex::of_face(*set.mesh, FaceId(face)));
      if (bounds.upper < best.upper) {
        best = bounds;
        nearest = FaceId(face);
      }
      return best.upper;
    });
    if (nearest.is_valid()) place = start + best.upper * best.direction;
    return nearest;
  }

  /// The direction of the nearest pair so far is that of the slabs. It is left for a while where little changes.
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
