#include "algebra3d/arrangement/surface_arrangement.h"

#include <array>
#include <cstddef>

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

/// What the rule has of a cell, turned as the first operand has it that covers it.
int selected(const Facets& facets, const Pieces& pieces, SurfaceRule rule, std::uint32_t cell_side) {
  const Side side = cell_side % 2 == 0 ? Side::left : Side::right;
  std::array<int, 2> orientations{};
  for (const Cover& cover : pieces.covers_of(pieces.pieces[cell_side / 2]))
    if (cover.is_on(side)) orientations[facets[cover.facet].operand] = facets[cover.facet].orientation;
  if (!keeps(rule, orientations[0] != 0, orientations[1] != 0)) return 0;
  return orientations[0] != 0 ? orientations[0] : orientations[1];
}

/// How the first operand that covers the cell has it.
int first_orientation(const Facets& facets, const Pieces& pieces, std::uint32_t cell_side) {
  const Side side = cell_side % 2 == 0 ? Side::left : Side::right;
  const Facet* first = nullptr;
  for (const Cover& cover : pieces.covers_of(pieces.pieces[cell_side / 2]))
    if (cover.is_on(side) && (first == nullptr || facets[cover.facet].operand < first->operand))
      first = &facets[cover.facet];
  return first == nullptr ? 0 : first->orientation;
}

/// Surfaces divided at one another. Refers to the operands.
struct SurfaceArrangement {
  explicit SurfaceArrangement(std::span<const Operand> list)
      : operands(list), facets(operands), skeleton(operands, facets) {}

  Status divide_at_one_another(const Monitor& monitor, const ArrangementOptions& limits);

  Operands operands;
  Facets facets;
  Skeleton skeleton;
  Pieces pieces;
  Patches patches;
};

Status check_size(std::span<const Operand> surfaces) {
  std::size_t face_count = 0;
  for (const Operand& surface : surfaces) face_count += surface.mesh->face_count();
  if (face_count <= TriangleMesh::kMaxFaces) return {};
  return Error{ErrorCode::limit_exceeded, "the surfaces have {} triangles together; expected at most {}", face_count,
               TriangleMesh::kMaxFaces};
}

Status SurfaceArrangement::divide_at_one_another(const Monitor& monitor, const ArrangementOptions& limits) {
  ASSIGN_OR_RETURN(const auto pairs, candidate_pairs(operands, monitor, limits.max_pairs));
  RETURN_IF_ERROR(find_contacts(pairs, facets, skeleton, monitor));
  RETURN_IF_ERROR(cut_segments(skeleton, monitor, limits.max_cuts));
  pieces = divide(skeleton);
  RETURN_IF_ERROR(complete_covers(skeleton, pieces, monitor));
  patches = find_patches(operands, facets);
  monitor.tell("building the result");
  return {};
}

}  // namespace

Result<TriangleMesh> combine_surfaces(const Operand& first, const Operand& second, SurfaceRule rule,
                                      const Monitor& monitor) {
  const std::array<Operand, 2> list{first, second};
  RETURN_IF_ERROR(check_size(list));
  SurfaceArrangement parts(list);
  RETURN_IF_ERROR(parts.divide_at_one_another(monitor, {}));
  const Selection selection{[&](std::uint32_t side) { return selected(parts.facets, parts.pieces, rule, side); },
                            [&](std::uint32_t patch) {
                              const bool is_first = parts.patches.patches[patch].operand == 0;
                              return static_cast<int>(keeps(rule, is_first, !is_first));
                            }};
  return build_outcome(parts.skeleton, parts.pieces, parts.patches, selection);
}

Result<TriangleMesh> unite_surfaces(std::span<const Operand> surfaces, const Monitor& monitor,
                                    const ArrangementOptions& limits) {
  RETURN_IF_ERROR(check_size(surfaces));
  SurfaceArrangement parts(surfaces);
  RETURN_IF_ERROR(parts.divide_at_one_another(monitor, limits));
  const Selection selection{[&](std::uint32_t side) { return first_orientation(parts.facets, parts.pieces, side); },
                            [](std::uint32_t) { return 1; }};
  return build_outcome(parts.skeleton, parts.pieces, parts.patches, selection);
}

}  // namespace algebra3d
