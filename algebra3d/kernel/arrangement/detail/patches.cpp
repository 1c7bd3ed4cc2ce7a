#include "algebra3d/kernel/arrangement/detail/patches.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/disjoint_sets.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Consecutive faces, which one task labels: faces with one label are connected, connected faces need not have one
/// label. Labels count from 0 in each block.
struct FaceBlock {
  IdRange<InputFaceId> faces;
  std::vector<Patch> labels = {};  ///< where each begins
  DisjointSets connected{0};       ///< labels that are found to meet
  std::uint32_t first_label = 0;   ///< number of its label 0 among the labels of all blocks
  /// A face and a neighbour in an earlier block.
  std::vector<std::pair<InputFaceId, InputFaceId>> links_back = {};
};

/// Connected-component labelling in two passes: a face takes the label of a neighbour before it; labels that meet are
/// united; then each face takes the patch of its label. Faces are taken in their order and not from neighbour to
/// neighbour, since that jumps about in memory. Source: [rosenfeld1966], for pictures.
class PatchFinder {
 public:
  PatchFinder(const Operands& operands, const Facets& facets) : operands_(operands), facets_(facets) {
    result_.of_face.resize(operands.face_count());
    for (std::size_t first = 0; first < operands.face_count(); first += kFacesPerTask)
      blocks_.push_back({{InputFaceId(first), InputFaceId(std::min(first + kFacesPerTask, operands.face_count()))}});
  }

  Patches run();

 private:
  void label(FaceBlock& block);
  PatchId label_near(FaceBlock& block, OperandId operand, InputFaceId face);
  std::vector<PatchId> number_patches();

  const Operands& operands_;
  const Facets& facets_;
  std::vector<FaceBlock> blocks_;
  Patches result_;  // of_face has the labels first
};

void PatchFinder::label(FaceBlock& block) {
  OperandId operand = operands_.operand_of(block.faces.front());
  for (const InputFaceId face : block.faces) {
    if (!facets_.of_face[face].is_none()) continue;
    while (face >= *operands_.faces(operand).end()) operand = OperandId(operand.index() + 1);
    PatchId label = label_near(block, operand, face);
    if (label.is_none()) {
      label = PatchId(block.connected.add());
      block.labels.push_back({operand, face});
    }
    result_.of_face[face] = label;
  }
}

/// A label of the neighbours before the face, all of which are united; none if there are no such neighbours.
PatchId PatchFinder::label_near(FaceBlock& block, OperandId operand, InputFaceId face) {
  PatchId label;
  const auto join = [&](HalfedgeId along) {
    const InputFaceId neighbour = operands_.input(operand, TriangleMesh::face(along));
    if (neighbour >= face) return;
    if (neighbour < block.faces.front()) {
      if (facets_.of_face[neighbour].is_none()) block.links_back.emplace_back(face, neighbour);
      return;
    }
    const PatchId known = result_.of_face[neighbour];
    if (known.is_none() || known == label) return;
    if (!label.is_none()) block.connected.unite(label.index(), known.index());
    label = known;
  };
  const TriangleMesh& mesh = operands_.mesh(operand);
  for (const InputHalfedgeId halfedge : Operands::halfedges(face)) {
    const HalfedgeId h = operands_.in_mesh(operand, halfedge);
    if (const HalfedgeId other = mesh.opposite(h); other.is_valid())
      join(other);
    else if (mesh.is_nonmanifold(h))
      for (const HalfedgeId along : mesh.edge_halfedges(h)) join(along);
  }
  return label;
}

/// The patches of all labels, block by block. A set of labels is represented by its first one, so patches are numbered
/// in the order of their first faces.
std::vector<PatchId> PatchFinder::number_patches() {
  const auto label_of = [&](InputFaceId face) {
    return blocks_[face.index() / kFacesPerTask].first_label + result_.of_face[face].index();
  };
  DisjointSets labels(0);
  for (FaceBlock& block : blocks_) {
    block.first_label = static_cast<std::uint32_t>(labels.size());
    for (std::uint32_t i = 0; i < block.labels.size(); ++i) {
      labels.add();
      labels.unite(block.first_label + i, block.first_label + block.connected.find(i));
    }
    for (const auto& [face, neighbour] : block.links_back) labels.unite(label_of(face), label_of(neighbour));
  }
  std::vector<PatchId> patches;
  patches.reserve(labels.size());
  for (const FaceBlock& block : blocks_)
    for (const Patch& beginning : block.labels) {
      const std::uint32_t first = labels.find(static_cast<std::uint32_t>(patches.size()));
      patches.push_back(first < patches.size() ? patches[first] : result_.patches.push_back(beginning));
    }
  return patches;
}

Patches PatchFinder::run() {
  parallel_for(blocks_.size(), 1, [&](std::size_t i) { label(blocks_[i]); });
  const std::vector<PatchId> patches = number_patches();
  parallel_for(blocks_.size(), 1, [&](std::size_t i) {
    for (const InputFaceId face : blocks_[i].faces)
      if (PatchId& label = result_.of_face[face]; !label.is_none())
        label = patches[blocks_[i].first_label + label.index()];
  });
  return std::move(result_);
}

}  // namespace

Patches find_patches(const Operands& operands, const Facets& facets) {
  return PatchFinder(operands, facets).run();
}

}  // namespace algebra3d::arrangement
