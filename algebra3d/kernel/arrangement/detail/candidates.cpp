#include "algebra3d/kernel/arrangement/detail/candidates.h"

#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/facet_slabs.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/search/node_gaps.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

class CandidateFinder {
 public:
  CandidateFinder(const Operands& operands, const Monitor& monitor, std::size_t max_pairs)
      : operands_(operands), monitor_(monitor), max_pairs_(max_pairs) {}

  std::vector<FacePair> run() {
    constexpr std::size_t kFewOperands = 8;
    if (operands_.count() <= kFewOperands)
      pair_hierarchies();
    else
      pair_faces();
    return std::move(pairs_);
  }

 private:
  std::vector<FacePair> pair_two(OperandId a, OperandId b, BoxHierarchy::Share share) const;
  FacetSlabs slabs_around(OperandId one, OperandId other) const {
    return {operands_.mesh(one), operands_.hierarchy(one), operands_.mesh(other), operands_.hierarchy(other)};
  }
  std::size_t share_count() const;
  void add(std::vector<FacePair> pairs);
  void pair_hierarchies();
  OperandId dominant_operand() const;
  void pair_with_others(OperandId one, const IdTree<OperandId>& operand_tree);
  void pair_faces();
  IdTree<InputFaceId> faces_near_others(OperandId left_out, const IdTree<OperandId>& operand_tree) const;
  bool goes_on() const { return !monitor_.is_cancelled() && pairs_.size() <= max_pairs_; }

  const Operands& operands_;
  const Monitor& monitor_;
  std::size_t max_pairs_;
  std::vector<FacePair> pairs_;
};

std::vector<FacePair> CandidateFinder::pair_two(OperandId a, OperandId b, BoxHierarchy::Share share) const {
  std::vector<FacePair> pairs;
  NodeGaps gaps(operands_.mesh(a), operands_.hierarchy(a), operands_.mesh(b), operands_.hierarchy(b));
  FacetSlabs around_a = slabs_around(a, b), around_b = slabs_around(b, a);
  operands_.hierarchy(a).for_each_pair_with(
      operands_.hierarchy(b),
      [&](std::uint32_t f, std::uint32_t g) {
        if (around_a.misses(g) || around_b.misses(f)) return true;
        gaps.note_visit();
        pairs.push_back({operands_.input(a, FaceId(f)), operands_.input(b, FaceId(g))});
        return pairs.size() <= max_pairs_;
      },
      [&](BoxHierarchy::Node m, BoxHierarchy::Node n) {
        return around_a.miss(n) || around_b.miss(m) || gaps.exceed(m, n, 0);
      },
      [&] { return !monitor_.is_cancelled(); }, share);
  return pairs;
}

/// Number of shares of a search. It follows from the operands alone, so that the order of the pairs does.
std::size_t CandidateFinder::share_count() const {
  constexpr std::size_t kFacesWorthAThread = 1500, kMaxShares = 16;
  if (operands_.face_count() < kFacesWorthAThread) return 1;
  return std::clamp<std::size_t>(operands_.face_count() / kWorthAThread, 2, kMaxShares);
}

void CandidateFinder::add(std::vector<FacePair> pairs) {
  if (pairs_.empty())
    pairs_ = std::move(pairs);
  else
    pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
}

/// Few operands: the hierarchy of each against that of each other one.
void CandidateFinder::pair_hierarchies() {
  const auto shares = static_cast<std::uint32_t>(share_count());
  for (const OperandId a : operands_.ids())
    for (const OperandId b : IdRange(OperandId(a.index() + 1), OperandId(operands_.count()))) {
      add(parallel_collect(shares, 1, [&](std::size_t share, std::size_t) {
        return pair_two(a, b, {static_cast<std::uint32_t>(share), shares});
      }));
      if (pairs_.size() > max_pairs_) return;
    }
}

/// The operand that has more faces than all others together, if it is worth a search of its own; else none.
OperandId CandidateFinder::dominant_operand() const {
  for (const OperandId i : operands_.ids())
    if (operands_.mesh(i).face_count() > std::max(operands_.face_count() / 2, kWorthAThread)) return i;
  return {};
}

/// One operand against all others that its box meets.
void CandidateFinder::pair_with_others(OperandId one, const IdTree<OperandId>& operand_tree) {
  operand_tree.for_each_in(operands_.hierarchy(one).bounds(), [&](OperandId other) {
    if (other != one && goes_on()) add(pair_two(std::min(one, other), std::max(one, other), {0, 1}));
  });
}

/// The faces of all operands whose boxes meet those of others.
IdTree<InputFaceId> CandidateFinder::faces_near_others(OperandId left_out,
                                                       const IdTree<OperandId>& operand_tree) const {
  IdTree<InputFaceId>::Boxes boxes;
  for (const OperandId i : operands_.ids()) {
    if (i == left_out || !operand_tree.has_more_in(operands_.hierarchy(i).bounds(), 1)) continue;
    for (const InputFaceId face : operands_.faces(i))
      boxes.add(box_of_triangle(operands_.mesh(i).corners(operands_.in_mesh(i, face))), face);
  }
  return boxes.tree();
}

/// Many operands: one tree over the faces of all whose boxes meet others. Where one operand has nearly all faces and
/// few of them are near others, its hierarchy finds these sooner.
void CandidateFinder::pair_faces() {
  IdTree<OperandId>::Boxes boxes;
  for (const OperandId i : operands_.ids()) boxes.add(operands_.hierarchy(i).bounds(), i);
  const IdTree<OperandId> operand_tree = boxes.tree();
  const OperandId dominant = dominant_operand();
  if (!dominant.is_none()) pair_with_others(dominant, operand_tree);
  faces_near_others(dominant, operand_tree).for_each_pair([&](InputFaceId first, InputFaceId second) {
    if (operands_.operand_of(first) != operands_.operand_of(second)) pairs_.push_back({first, second});
    return goes_on();
  });
}

}  // namespace

Result<Candidates> find_candidates(const Operands& operands, const Monitor& monitor, std::size_t max_pairs) {
  monitor.tell("finding near triangles");
  Candidates result{CandidateFinder(operands, monitor, max_pairs).run()};
  A3D_TRY(monitor.check());
  if (result.pairs.size() > max_pairs)
    return Error{ErrorCode::limit_exceeded, "more than {} pairs of triangles may touch", max_pairs};
  return result;
}

}  // namespace algebra3d::arrangement
