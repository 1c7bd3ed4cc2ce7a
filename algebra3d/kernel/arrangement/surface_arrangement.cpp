#include "algebra3d/kernel/arrangement/surface_arrangement.h"

#include <array>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/build_result_mesh.h"
#include "algebra3d/kernel/arrangement/detail/subdivision.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using arrangement::Facet;
using arrangement::IncidentFacet;
using arrangement::OperandId;
using arrangement::PatchId;
using arrangement::Selection;
using arrangement::Subdivision;
using arrangement::SubEdgeSide;

constexpr OperandId kFirst(0);

bool keeps(SurfaceRule rule, bool is_in_first, bool is_in_second) {
  switch (rule) {
    case SurfaceRule::either:
      return is_in_first || is_in_second;
    case SurfaceRule::both:
      return is_in_first && is_in_second;
    case SurfaceRule::first_only:
      return is_in_first && !is_in_second;
    default:
      return is_in_first != is_in_second;
  }
}

/// Calls visit(facet) for each facet on the sub-facet at the side.
template <typename Visit>
void for_each_facet(const Subdivision& subdivision, SubEdgeSide at, const Visit& visit) {
  for (const IncidentFacet& incident : subdivision.sub_edges.incident_to(at.sub_edge()))
    if (includes(incident.sides(), at.side())) visit(subdivision.facets[incident.facet()]);
}

/// The choice of the rule for a sub-facet, oriented as in the first operand that covers it.
int selected(const Subdivision& subdivision, SurfaceRule rule, SubEdgeSide at) {
  int in_first = 0, in_second = 0;
  for_each_facet(subdivision, at,
                 [&](const Facet& facet) { (facet.operand == kFirst ? in_first : in_second) = facet.orientation; });
  if (!keeps(rule, in_first != 0, in_second != 0)) return 0;
  return in_first != 0 ? in_first : in_second;
}

/// How the first operand that covers the sub-facet has it.
int first_orientation(const Subdivision& subdivision, SubEdgeSide at) {
  const Facet* first = nullptr;
  for_each_facet(subdivision, at, [&](const Facet& facet) {
    if (first == nullptr || facet.operand < first->operand) first = &facet;
  });
  return first == nullptr ? 0 : first->orientation;
}

Result<Subdivision> subdivided(std::span<const Operand> surfaces, const Monitor& monitor,
                               const ArrangementOptions& limits) {
  A3D_TRY(arrangement::check_face_count("surfaces", surfaces));
  auto subdivision = arrangement::subdivide(surfaces, arrangement::Boundaries::possible, limits, monitor);
  if (subdivision.ok()) monitor.tell("building the result");
  return subdivision;
}

}  // namespace

Result<TriangleMesh> combine_surfaces(const Operand& first, const Operand& second, SurfaceRule rule,
                                      const Monitor& monitor) {
  const std::array<Operand, 2> list{first, second};
  A3D_ASSIGN(Subdivision subdivision, subdivided(list, monitor, {}));
  const auto keep_sub_facet = [&](SubEdgeSide at) { return selected(subdivision, rule, at); };
  const auto keep_patch = [&](PatchId patch) {
    const bool is_first = subdivision.patches[patch].operand == kFirst;
    return static_cast<int>(keeps(rule, is_first, !is_first));
  };
  Selection selection = Selection::of(subdivision, keep_sub_facet, keep_patch);
  return build_result_mesh(std::move(subdivision), std::move(selection));
}

Result<TriangleMesh> unite_surfaces(std::span<const Operand> surfaces, const Monitor& monitor,
                                    const ArrangementOptions& limits) {
  A3D_ASSIGN(Subdivision subdivision, subdivided(surfaces, monitor, limits));
  const auto keep_sub_facet = [&](SubEdgeSide at) { return first_orientation(subdivision, at); };
  Selection selection = Selection::of(subdivision, keep_sub_facet, [](PatchId) { return 1; });
  return build_result_mesh(std::move(subdivision), std::move(selection));
}

}  // namespace algebra3d
