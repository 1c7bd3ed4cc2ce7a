#include "algebra3d/distance/detail/candidate_search.h"

#include <algorithm>
#include <tuple>

namespace algebra3d::distances {
namespace {

class CandidateSearch {
 public:
  CandidateSearch(const DistanceOperand& a, const DistanceOperand& b, double reach, double enough)
      : a_(a), b_(b), rounded_(unite(a.hierarchy->bounds(), b.hierarchy->bounds())), nearest_(reach), enough_(enough) {}

  /// Takes a pair into account, and returns the distance beyond which pairs are of no interest: negative if the pair is
  /// enough.
  double visit(FaceId first, FaceId second) {
    const DistanceBounds bounds =
        rounded_.bounds(Simplex::of_face(*a_.mesh, first), Simplex::of_face(*b_.mesh, second));
    if (bounds.lower > nearest_) return nearest_;
    nearest_ = std::min(nearest_, bounds.upper);
    candidates_.push_back({first, second, bounds});
    if (candidates_.size() > 2 * kept_ + kFew) drop_distant();
    return bounds.upper <= enough_ ? -1 : nearest_;
  }

  std::vector<CandidatePair> take();

 private:
  static constexpr std::size_t kFew = 64;

  void drop_distant() {
    std::erase_if(candidates_, [this](const CandidatePair& pair) { return pair.bounds.lower > nearest_; });
    kept_ = candidates_.size();
  }

  const DistanceOperand &a_, &b_;
  RoundedDistances rounded_;
  double nearest_, enough_;
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
  a.hierarchy->for_each_near_pair_with(
      *b.hierarchy, reach,
      [&](std::uint32_t first, std::uint32_t second) { return search.visit(FaceId(first), FaceId(second)); },
      [&] { return !monitor.is_cancelled(); });
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  return search.take();
}

}  // namespace algebra3d::distances
