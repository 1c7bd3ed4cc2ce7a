#include "algebra3d/kernel/arrangement/arrangement.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/build_result_mesh.h"
#include "algebra3d/kernel/arrangement/detail/classification.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// A rule that remembers what it said of the windings that most cells have: it is asked twice for each side of each
/// sub-edge. For one thread.
class RememberedRule {
 public:
  explicit RememberedRule(const KeepRule& rule) : rule_(rule) { answers_.fill(kUnknown); }

  bool operator()(const WindingVector& windings) {
    const auto first = static_cast<std::size_t>(windings[0]), second = static_cast<std::size_t>(windings[1]);
    if (first >= kFew || second >= kFew) return rule_(windings);  // also negative ones
    std::int8_t& answer = answers_[kFew * first + second];
    if (answer == kUnknown) answer = rule_(windings) ? 1 : 0;
    return answer == 1;
  }

 private:
  static constexpr std::size_t kFew = 4;
  static constexpr std::int8_t kUnknown = -1;

  const KeepRule& rule_;
  std::array<std::int8_t, kFew * kFew> answers_{};
};

}  // namespace

struct SolidArrangement::Parts {
  std::vector<Operand> list;
  arrangement::Subdivision subdivision;  // refers to the list
  arrangement::WindingJumps jumps;
  arrangement::Classification fronts;

  arrangement::Selection faces(const FaceRule& rule) const;
  arrangement::Selection solid(const KeepRule& rule) const;

 private:
  /// rule(front, back) as FaceRule, and 0 if both are the same; inlined, where a std::function would be called through.
  template <typename Rule>
  arrangement::Selection select(Rule rule) const;
};

SolidArrangement::SolidArrangement(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SolidArrangement::SolidArrangement(SolidArrangement&& other) noexcept = default;
SolidArrangement& SolidArrangement::operator=(SolidArrangement&& other) noexcept = default;
SolidArrangement::~SolidArrangement() = default;

Result<SolidArrangement> SolidArrangement::make(std::span<const Operand> operands, const Monitor& monitor,
                                                const ArrangementOptions& options) {
  using arrangement::Boundaries;
  A3D_TRY(arrangement::check_face_count("operands", operands));
  std::vector<Operand> list(operands.begin(), operands.end());
  const Boundaries boundaries = options.closure == Closure::each ? Boundaries::none : Boundaries::possible;
  A3D_ASSIGN(arrangement::Subdivision subdivision, arrangement::subdivide(list, boundaries, options, monitor));
  arrangement::WindingJumps jumps =
      arrangement::winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
  A3D_TRY(arrangement::check_stage("the winding jumps", [&] { return arrangement::audit(subdivision, jumps); }));
  A3D_ASSIGN(arrangement::Classification fronts, arrangement::classify(subdivision, jumps, options.closure, monitor));
  A3D_TRY(monitor.check());
  monitor.tell("building the result");
  return SolidArrangement(
      std::make_unique<Parts>(Parts{std::move(list), std::move(subdivision), std::move(jumps), std::move(fronts)}));
}

template <typename Rule>
arrangement::Selection SolidArrangement::Parts::select(Rule rule) const {
  using arrangement::PatchId, arrangement::SubEdgeSide;
  const auto of_side = [&](SubEdgeSide side) {
    const WindingVector jump = jumps[side], front = fronts.at_sides[side];
    return rule(front, front + jump);
  };
  const auto of_patch = [&](PatchId patch) {
    const std::size_t group = subdivision.operands.group(subdivision.patches[patch].operand);
    return rule(fronts.at_patches[patch], fronts.at_patches[patch] + WindingVector::of_group(group, 1));
  };
  return arrangement::Selection::of(subdivision, of_side, of_patch);
}

arrangement::Selection SolidArrangement::Parts::faces(const FaceRule& rule) const {
  return select(
      [&](const WindingVector& front, const WindingVector& back) { return front == back ? 0 : rule(front, back); });
}

arrangement::Selection SolidArrangement::Parts::solid(const KeepRule& rule) const {
  RememberedRule keeps(rule);
  return select([&](const WindingVector& front, const WindingVector& back) {
    return static_cast<int>(keeps(back)) - static_cast<int>(keeps(front));
  });
}

Result<TriangleMesh> SolidArrangement::faces(const FaceRule& rule) const {
  return arrangement::build_result_mesh(parts_->subdivision, parts_->faces(rule));
}

Result<TriangleMesh> SolidArrangement::solid(const KeepRule& rule) const& {
  return arrangement::build_result_mesh(parts_->subdivision, parts_->solid(rule));
}

Result<TriangleMesh> SolidArrangement::solid(const KeepRule& rule) && {
  const std::unique_ptr<Parts> parts = std::move(parts_);
  arrangement::Selection selection = parts->solid(rule);
  parts->jumps = {};
  parts->fronts = {};
  return arrangement::build_result_mesh(std::move(parts->subdivision), std::move(selection));
}

Result<TriangleMesh> combine_solids(std::span<const Operand> operands, const KeepRule& rule, const Monitor& monitor) {
  A3D_ASSIGN(SolidArrangement arrangement, SolidArrangement::make(operands, monitor));
  return std::move(arrangement).solid(rule);
}

}  // namespace algebra3d
