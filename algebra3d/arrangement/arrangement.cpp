#include "algebra3d/arrangement/arrangement.h"

#include <utility>
#include <vector>

#include "algebra3d/arrangement/detail/build_result_mesh.h"
#include "algebra3d/arrangement/detail/classification.h"
#include "algebra3d/arrangement/detail/stage_audit.h"
#include "algebra3d/arrangement/detail/subdivision.h"

namespace algebra3d {

struct SolidArrangement::Parts {
  std::vector<Operand> list;
  arrangement::Subdivision subdivision;  // refers to the list
  arrangement::WindingJumps jumps;
  arrangement::Classification fronts;
};

SolidArrangement::SolidArrangement(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SolidArrangement::SolidArrangement(SolidArrangement&& other) noexcept = default;
SolidArrangement& SolidArrangement::operator=(SolidArrangement&& other) noexcept = default;
SolidArrangement::~SolidArrangement() = default;

Result<SolidArrangement> SolidArrangement::make(std::span<const Operand> operands, const Monitor& monitor,
                                                const ArrangementOptions& options) {
  using arrangement::Boundaries;
  ALGEBRA3D_RETURN_IF_ERROR(arrangement::check_face_count("operands", operands));
  std::vector<Operand> list(operands.begin(), operands.end());
  const Boundaries boundaries = options.closure == Closure::each ? Boundaries::none : Boundaries::possible;
  ALGEBRA3D_ASSIGN_OR_RETURN(arrangement::Subdivision subdivision,
                             arrangement::subdivide(list, boundaries, options, monitor));
  arrangement::WindingJumps jumps =
      arrangement::winding_jumps(subdivision.operands, subdivision.facets, subdivision.sub_edges);
  ALGEBRA3D_RETURN_IF_ERROR(
      arrangement::check_stage("the winding jumps", [&] { return arrangement::audit(subdivision, jumps); }));
  ALGEBRA3D_ASSIGN_OR_RETURN(arrangement::Classification fronts,
                             arrangement::classify(subdivision, jumps, options.closure, monitor));
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  monitor.tell("building the result");
  return SolidArrangement(
      std::make_unique<Parts>(Parts{std::move(list), std::move(subdivision), std::move(jumps), std::move(fronts)}));
}

Result<TriangleMesh> SolidArrangement::faces(const FaceRule& rule) const {
  using arrangement::PatchId, arrangement::SubEdgeSide;
  const auto& [list, subdivision, jumps, fronts] = *parts_;
  const auto keep_sub_facet = [&, &jumps = jumps, &fronts = fronts](SubEdgeSide side) {
    return jumps[side] == WindingVector() ? 0 : rule(fronts.at_sides[side], fronts.at_sides[side] + jumps[side]);
  };
  const auto keep_patch = [&, &subdivision = subdivision, &fronts = fronts](PatchId patch) {
    const std::size_t group = subdivision.operands.group(subdivision.patches[patch].operand);
    return rule(fronts.at_patches[patch], fronts.at_patches[patch] + WindingVector::of_group(group, 1));
  };
  return arrangement::build_result_mesh(subdivision, {keep_sub_facet, keep_patch});
}

Result<TriangleMesh> SolidArrangement::solid(const KeepRule& rule) const {
  return faces([&](const WindingVector& front, const WindingVector& back) {
    return static_cast<int>(rule(back)) - static_cast<int>(rule(front));
  });
}

Result<TriangleMesh> combine_solids(std::span<const Operand> operands, const KeepRule& rule, const Monitor& monitor) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const SolidArrangement arrangement, SolidArrangement::make(operands, monitor));
  return arrangement.solid(rule);
}

}  // namespace algebra3d
