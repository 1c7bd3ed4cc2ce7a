#include "algebra3d/kernel/arrangement/divide_and_conquer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/operands.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using arrangement::OperandId;

/// So many solids are one arrangement. Smaller and larger numbers were slower (docs/decisions/0007).
constexpr std::size_t kFewSolids = 8;

enum class Operation : std::uint8_t { unite, intersect };

/// A solid and the middle of its box, by which solids are halved.
struct PlacedSolid {
  Operand solid;
  Vec3 middle;
};

class DivideAndConquer {
 public:
  DivideAndConquer(Operation operation, std::span<const Operand> solids, const Monitor& monitor)
      : operation_(operation), solids_(solids.begin(), solids.end()), monitor_(monitor) {
    for (Operand& solid : solids_) solid.group = 0;
  }

  Result<TriangleMesh> run();

 private:
  bool is_crowded() const;
  std::vector<PlacedSolid> placed_solids() const;
  static std::size_t halve_by_place(std::span<PlacedSolid> solids);
  Result<TriangleMesh> at_once(std::span<const Operand> solids, const Monitor& monitor) const;
  Result<TriangleMesh> few_at_once(std::span<const PlacedSolid> solids);
  Result<TriangleMesh> in_halves(std::span<PlacedSolid> solids);
  void tell();

  Operation operation_;
  std::vector<Operand> solids_;
  std::vector<std::unique_ptr<const BoxHierarchy>> hierarchies_;  // of solids that came without one
  Monitor monitor_;
  std::atomic<std::size_t> done_ = 0;  // of the solids
};

/// The smallest box of doubles. Hierarchies have boxes of floats, in which solids that nearly touch do so.
Box3 smallest_box_of(const TriangleMesh& mesh) {
  Box3 box;
  for (std::size_t i = 0; i < mesh.points().size(); ++i) box.extend(box_of(mesh.points()[i]));
  return box;
}

/// True if a solid meets more than two others on the average.
bool DivideAndConquer::is_crowded() const {
  arrangement::IdTree<OperandId>::Boxes boxes;
  for (const OperandId i : IdRange<OperandId>(solids_.size())) boxes.add(smallest_box_of(*solids_[i.index()].mesh), i);
  std::size_t pairs = 0;
  boxes.tree().for_each_pair([&](OperandId, OperandId) { return ++pairs <= solids_.size(); });
  return pairs > solids_.size();
}

std::vector<PlacedSolid> DivideAndConquer::placed_solids() const {
  std::vector<PlacedSolid> placed;
  placed.reserve(solids_.size());
  for (const Operand& solid : solids_) {
    const Box3 box = solid.hierarchy->bounds();
    placed.push_back({solid, 0.5 * box.min + 0.5 * box.max});
  }
  return placed;
}

/// Sorts along the longest axis of the box around their middles. Returns where to divide them: half-way, or at the
/// nearest end of a run of equal places there, since the parts of a grid then stay boxes.
std::size_t DivideAndConquer::halve_by_place(std::span<PlacedSolid> solids) {
  Box3 all;
  for (const PlacedSolid& solid : solids) all.extend(solid.middle);
  const Vec3 size = 0.5 * all.max - 0.5 * all.min;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto place = [axis](const PlacedSolid& solid) { return solid.middle[axis]; };
  std::ranges::stable_sort(solids, {}, place);
  const std::size_t half = solids.size() / 2;
  const auto run = std::ranges::equal_range(solids, place(solids[half]), {}, place);
  const auto begin = static_cast<std::size_t>(run.begin() - solids.begin()), end = begin + run.size();
  if (begin == 0 && end == solids.size()) return half;
  if (begin == 0) return end;
  return end == solids.size() || half - begin <= end - half ? begin : end;
}

Result<TriangleMesh> DivideAndConquer::at_once(std::span<const Operand> solids, const Monitor& monitor) const {
  const auto needed = operation_ == Operation::unite ? 1 : static_cast<int>(solids.size());
  return combine_solids(
      solids, [needed](const WindingVector& windings) { return windings[0] >= needed; }, monitor);
}

void DivideAndConquer::tell() {
  const char* what = operation_ == Operation::unite ? "uniting parts, " : "intersecting parts, ";
  monitor_.tell(what + std::to_string(done_ * 100 / solids_.size()) + " %");
}

Result<TriangleMesh> DivideAndConquer::few_at_once(std::span<const PlacedSolid> solids) {
  std::vector<Operand> few;
  for (const PlacedSolid& solid : solids) few.push_back(solid.solid);
  auto result = at_once(few, monitor_.silent());
  done_ += solids.size();
  tell();
  return result;
}

Result<TriangleMesh> DivideAndConquer::in_halves(std::span<PlacedSolid> solids) {
  if (solids.size() <= kFewSolids) return few_at_once(solids);
  const std::size_t half = halve_by_place(solids);
  Result<TriangleMesh> first = TriangleMesh(), second = TriangleMesh();
  parallel_invoke(
      true, [&] { first = in_halves(solids.first(half)); }, [&] { second = in_halves(solids.subspan(half)); });
  if (!first.ok()) return first;
  if (!second.ok()) return second;
  const std::array<Operand, 2> halves{{{&*first}, {&*second}}};
  // The last and largest arrangement reports its own progress.
  return at_once(halves, solids.size() == solids_.size() ? monitor_ : monitor_.silent());
}

Result<TriangleMesh> DivideAndConquer::run() {
  if (solids_.size() <= kFewSolids) return at_once(solids_, monitor_);
  for (Operand& solid : solids_) {
    if (solid.hierarchy != nullptr) continue;
    hierarchies_.push_back(arrangement::hierarchy_of(*solid.mesh));
    solid.hierarchy = hierarchies_.back().get();
  }
  if (!is_crowded()) return at_once(solids_, monitor_);
  std::vector<PlacedSolid> placed = placed_solids();
  return in_halves(placed);
}

}  // namespace

Result<TriangleMesh> unite_solids(std::span<const Operand> solids, const Monitor& monitor) {
  return DivideAndConquer(Operation::unite, solids, monitor).run();
}

Result<TriangleMesh> intersect_solids(std::span<const Operand> solids, const Monitor& monitor) {
  return DivideAndConquer(Operation::intersect, solids, monitor).run();
}

}  // namespace algebra3d
