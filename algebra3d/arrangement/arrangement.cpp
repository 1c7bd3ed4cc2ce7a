#include "algebra3d/arrangement/arrangement.h"

#include "algebra3d/arrangement/candidates.h"
#include "algebra3d/arrangement/classification.h"
#include "algebra3d/arrangement/facet_contacts.h"
#include "algebra3d/arrangement/outcome.h"
#include "algebra3d/arrangement/overlay.h"

namespace algebra3d {

Result<TriangleMesh> combine_solids(std::span<const Operand> operands, const KeepRule& rule,
                                    const std::atomic<bool>* cancel) {
  using namespace arrangement;
  std::size_t face_count = 0;
  for (const Operand& operand : operands) face_count += operand.mesh->face_count();
  if (face_count > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "the operands have {} triangles together; expected at most {}", face_count,
                 TriangleMesh::kMaxFaces};

  const Operands all(operands);
  ASSIGN_OR_RETURN(const auto pairs, candidate_pairs(all, cancel));
  Facets facets(all);
  Skeleton skeleton(all, facets);
  RETURN_IF_ERROR(find_contacts(pairs, facets, skeleton, cancel));
  RETURN_IF_ERROR(cut_segments(skeleton, cancel));
  const Pieces pieces = divide(skeleton);
  const Patches patches = find_patches(all, facets);
  ASSIGN_OR_RETURN(const Classification classification, classify(skeleton, pieces, patches, cancel));
  return build_outcome(skeleton, pieces, patches, classification, rule);
}

}  // namespace algebra3d
