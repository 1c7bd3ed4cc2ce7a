#include "algebra3d/kernel/repair/detail/repaired_solid.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/kernel/repair/detail/loose_sheets.h"
#include "algebra3d/kernel/repair/detail/parity_estimate.h"
#include "algebra3d/kernel/repair/detail/repair_attempt.h"
#include "algebra3d/kernel/repair/detail/repair_strategy.h"
#include "algebra3d/kernel/repair/detail/soup_repair.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The search for the strategy that suits the given triangles.
class RepairSearch {
 public:
  RepairSearch(const KnownTriangles& given, const ValidityReport& found, const RepairOptions& options,
               const Monitor& monitor)
      : given_(given), found_(found), options_(options), monitor_(monitor) {}

  Result<RepairedSolid> run();
  std::size_t division_count() const { return division_count_; }

 private:
  Result<RepairAttempt> attempt(const RepairStrategy& strategy, const RepairAttempt* best = nullptr);
  Agreement agreement(const RepairAttempt& attempt);
  bool is_accepted(const RepairAttempt& attempt, bool is_doubtful) const;
  void remember(RepairAttempt attempt, bool is_wrong);
  Result<RepairedSolid> cheapest(RepairAttempt accepted);
  Status take_if_cheaper(const RepairStrategy& strategy, RepairAttempt& best);
  Result<RepairedSolid> finish(RepairAttempt best);
  Result<RepairedSolid> second_best();

  const KnownTriangles& given_;
  const ValidityReport& found_;
  const RepairOptions& options_;
  const Monitor& monitor_;
  std::optional<ParityEstimate> estimate_;
  std::size_t division_count_ = 0;
  std::optional<RepairAttempt> last_;  // the last one that is not needed any more, for others with the same triangles
  // Attempts that were not accepted: the first one, the first one that is not wrong, and the first of those that
  // replaced misconnected triangles. The estimate was made with these triangles, so it may be mistaken.
  std::optional<RepairAttempt> usual_, fair_, without_misconnected_;
};

/// `best`: the cheapest attempt so far, if one was accepted.
Result<RepairAttempt> RepairSearch::attempt(const RepairStrategy& strategy, const RepairAttempt* best) {
  std::vector<const RepairAttempt*> earlier;
  if (usual_) earlier.push_back(&*usual_);
  if (best != nullptr) earlier.push_back(best);
  if (last_) earlier.push_back(&*last_);
  RepairAttempt result(given_, strategy, options_, monitor_);
  A3D_TRY(result.make(found_, earlier));
  if (result.has_divided()) ++division_count_;
  return result;
}

Agreement RepairSearch::agreement(const RepairAttempt& attempt) {
  if (!estimate_) estimate_.emplace(*given_.mesh(), loose_sheets(*given_.mesh(), attempt.sheets()));
  return estimate_->compare(attempt.solid());
}

/// An attempt is preferred for its cost if it costs less than this part of the other one.
bool is_cheaper(const RepairAttempt& a, const RepairAttempt& b) {
  constexpr double kMuchCheaper = 0.95;
  return a.cost() < kMuchCheaper * b.cost();
}

/// Puts what another strategy gives in place of the best attempt so far, if that agrees and is cheaper.
Status RepairSearch::take_if_cheaper(const RepairStrategy& strategy, RepairAttempt& best) {
  A3D_ASSIGN(RepairAttempt other, attempt(strategy, &best));
  const bool may_be_cheaper = other.has_solid() && !other.costs_as_much_as(best) && !agreement(other).is_doubtful();
  if (may_be_cheaper) {
    A3D_TRY(other.measure());
    if (is_cheaper(other, best)) std::swap(other, best);
  }
  last_ = std::move(other);
  return {};
}

/// The accepted attempt, or a cheaper one: the part that it leaves out may be a cap that lacks a narrow strip. If
/// closing that adds less than leaving the cap out loses, it is closed. Of triangles that are balanced as given nothing
/// is lacking: cells with a negative winding number are then where hollows cross each other, and stay empty.
Result<RepairedSolid> RepairSearch::cheapest(RepairAttempt accepted) {
  if (!accepted.has_solid() || !accepted.may_be_done_otherwise()) return finish(std::move(accepted));
  A3D_TRY(accepted.measure());
  for (const CheaperStrategies& group : cheaper_strategies()) {
    if (!accepted.is_worth_trying(group.condition)) continue;
    for (const RepairStrategy& strategy : group.strategies)
      if (!strategy.keeps_negative || !is_balanced(*given_.mesh())) A3D_TRY(take_if_cheaper(strategy, accepted));
  }
  return finish(std::move(accepted));
}

/// Finishes the best attempt, or that which replaced misconnected triangles if it is cheaper.
Result<RepairedSolid> RepairSearch::finish(RepairAttempt best) {
  if (!without_misconnected_ || !best.has_solid()) return std::move(best).finish();
  A3D_TRY(best.measure());
  A3D_TRY(without_misconnected_->measure());
  if (is_cheaper(*without_misconnected_, best)) best = *std::move(without_misconnected_);
  return std::move(best).finish();
}

/// Only the usual repair may be accepted without a solid, when the triangles enclose nothing.
bool RepairSearch::is_accepted(const RepairAttempt& attempt, bool is_doubtful) const {
  return !is_doubtful && (!usual_ || attempt.has_solid());
}

void RepairSearch::remember(RepairAttempt attempt, bool is_wrong) {
  const bool is_fair = !is_wrong && attempt.has_solid();
  if (!fair_ && is_fair) fair_ = attempt;
  if (!without_misconnected_ && is_fair && attempt.has_replaced_misconnected()) without_misconnected_ = attempt;
  (usual_ ? last_ : usual_) = std::move(attempt);
}

/// When no attempt was accepted.
Result<RepairedSolid> RepairSearch::second_best() {
  if (fair_) return std::move(*fair_).finish();
  if (usual_->has_solid())
    return usual_->nothing("every repair left out most of the space that the triangles enclose, or added as much");
  return std::move(*usual_).finish();
}

Result<RepairedSolid> RepairSearch::run() {
  for (const RepairStrategy& strategy : search_strategies()) {
    A3D_ASSIGN(RepairAttempt made, attempt(strategy));
    if (!usual_ && made.keeps_what_is_enclosed()) return cheapest(std::move(made));
    const Agreement found = agreement(made);
    if (is_accepted(made, found.is_doubtful())) return cheapest(std::move(made));
    remember(std::move(made), found.is_wrong());
    if (!usual_->may_be_done_otherwise()) break;
  }
  return second_best();
}

}  // namespace

Result<RepairedSolid> repaired_solid(const KnownTriangles& given, const ValidityReport& found,
                                     const RepairOptions& options, const Monitor& monitor) {
  RepairSearch search(given, found, options, monitor);
  A3D_ASSIGN(RepairedSolid result, search.run());
  result.division_count = search.division_count();
  return result;
}

}  // namespace algebra3d
