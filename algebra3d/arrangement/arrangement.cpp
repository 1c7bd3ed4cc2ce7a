#include "algebra3d/arrangement/arrangement.h"

#include <utility>
#include <vector>

#include "algebra3d/arrangement/candidates.h"
#include "algebra3d/arrangement/classification.h"
#include "algebra3d/arrangement/facet_contacts.h"
#include "algebra3d/arrangement/outcome.h"
#include "algebra3d/arrangement/overlay.h"
#include "algebra3d/arrangement/surface_covers.h"
#include "algebra3d/base/parallel.h"

namespace algebra3d {

using namespace arrangement;

/// Each part is made from those before it, which it refers to.
struct SolidArrangement::Parts {
  explicit Parts(std::span<const Operand> given)
      : list(given.begin(), given.end()), operands(list), facets(operands), skeleton(operands, facets) {}

  /// Pieces from contacts; patches from facets.
  Status subdivide(const ArrangementOptions& options, const Monitor& monitor);

  std::vector<Operand> list;
  Operands operands;
  Facets facets;
  Skeleton skeleton;
  Pieces pieces;
  Patches patches;
  Classification classification;
};

Status SolidArrangement::Parts::subdivide(const ArrangementOptions& options, const Monitor& monitor) {
  Status status;
  const auto find_pieces = [&] {
    status = cut_segments(skeleton, monitor, options.max_cuts);
    if (!status) return;
    pieces = divide(skeleton);
    if (options.closure == Closure::together) status = complete_covers(skeleton, pieces, monitor.silent());
    if (!status) return;
    count_steps(skeleton, pieces);
  };
  const auto find_rest = [&] { patches = find_patches(operands, facets); };
  in_parallel(operands.face_count() >= kWorthAThread, find_pieces, find_rest);
  return status;
}

SolidArrangement::SolidArrangement(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SolidArrangement::SolidArrangement(SolidArrangement&& other) noexcept = default;
SolidArrangement& SolidArrangement::operator=(SolidArrangement&& other) noexcept = default;
SolidArrangement::~SolidArrangement() = default;

Result<SolidArrangement> SolidArrangement::make(std::span<const Operand> operands, const Monitor& monitor,
                                                const ArrangementOptions& options) {
  std::size_t face_count = 0;
  for (const Operand& operand : operands) face_count += operand.mesh->face_count();
  if (face_count > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "the operands have {} triangles together; expected at most {}", face_count,
                 TriangleMesh::kMaxFaces};

  auto parts = std::make_unique<Parts>(operands);
  ASSIGN_OR_RETURN(const auto pairs, candidate_pairs(parts->operands, monitor, options.max_pairs));
  RETURN_IF_ERROR(find_contacts(pairs, parts->facets, parts->skeleton, monitor));
  RETURN_IF_ERROR(parts->subdivide(options, monitor));
  ASSIGN_OR_RETURN(parts->classification,
                   classify(parts->skeleton, parts->pieces, parts->patches, options.closure, monitor));
  monitor.tell("building the result");
  return SolidArrangement(std::move(parts));
}

Result<TriangleMesh> SolidArrangement::faces(const FaceRule& rule) const {
  const Classification& fronts = parts_->classification;
  const Selection selection{[&](std::uint32_t cell_side) {
                              const Windings& step = parts_->pieces.pieces[cell_side / 2].steps[cell_side % 2];
                              const Windings& front = fronts.cell_fronts[cell_side];
                              return step == Windings{} ? 0 : rule(front, front + step);
                            },
                            [&](std::uint32_t patch) {
                              Windings step{};
                              step[parts_->operands.group(parts_->patches.patches[patch].operand)] = 1;
                              return rule(fronts.patch_fronts[patch], fronts.patch_fronts[patch] + step);
                            }};
  return build_outcome(parts_->skeleton, parts_->pieces, parts_->patches, selection);
}

Result<TriangleMesh> SolidArrangement::solid(const KeepRule& rule) const {
  return faces([&](const Holding& front, const Holding& back) {
    return static_cast<int>(rule(back)) - static_cast<int>(rule(front));
  });
}

Result<TriangleMesh> combine_solids(std::span<const Operand> operands, const KeepRule& rule, const Monitor& monitor) {
  ASSIGN_OR_RETURN(const SolidArrangement arrangement, SolidArrangement::make(operands, monitor));
  return arrangement.solid(rule);
}

}  // namespace algebra3d
