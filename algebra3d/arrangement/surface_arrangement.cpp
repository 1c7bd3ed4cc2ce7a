#include "algebra3d/arrangement/surface_arrangement.h"

#include <array>

#include "algebra3d/arrangement/candidates.h"
#include "algebra3d/arrangement/facet_contacts.h"
#include "algebra3d/arrangement/outcome.h"
#include "algebra3d/arrangement/overlay.h"
#include "algebra3d/arrangement/surface_covers.h"

namespace algebra3d {

using namespace arrangement;

namespace {

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

/// What is kept of a cell, turned as the first operand has it that covers it.
int selected(const Facets& facets, const Pieces& pieces, SurfaceRule rule, std::uint32_t cell_side) {
  const Side side = cell_side % 2 == 0 ? Side::left : Side::right;
  std::array<int, 2> orientations{};
  for (const Cover& cover : pieces.covers_of(pieces.pieces[cell_side / 2]))
    if (cover.is_on(side)) orientations[facets[cover.facet].operand] = facets[cover.facet].orientation;
  if (!keeps(rule, orientations[0] != 0, orientations[1] != 0)) return 0;
  return orientations[0] != 0 ? orientations[0] : orientations[1];
}

}  // namespace

Result<TriangleMesh> combine_surfaces(const Operand& first, const Operand& second, SurfaceRule rule,
                                      const Monitor& monitor) {
  if (first.mesh->face_count() + second.mesh->face_count() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "the surfaces have more than {} triangles together",
                 TriangleMesh::kMaxFaces};
  const std::array<Operand, 2> list{first, second};
  const Operands operands(list);
  ASSIGN_OR_RETURN(const auto pairs, candidate_pairs(operands, monitor));
  Facets facets(operands);
  Skeleton skeleton(operands, facets);
  RETURN_IF_ERROR(find_contacts(pairs, facets, skeleton, monitor));
  RETURN_IF_ERROR(cut_segments(skeleton, monitor));
  Pieces pieces = divide(skeleton);
  complete_covers(skeleton, pieces);
  const Patches patches = find_patches(operands, facets);
  const Selection selection{[&](std::uint32_t cell_side) { return selected(facets, pieces, rule, cell_side); },
                            [&](std::uint32_t patch) {
                              const bool is_first = patches.patches[patch].operand == 0;
                              return static_cast<int>(keeps(rule, is_first, !is_first));
                            }};
  monitor.tell("building the result");
  return build_outcome(skeleton, pieces, patches, selection);
}

}  // namespace algebra3d
