#include "algebra3d/kernel/arrangement/detail/upward_linking.h"

#include <algorithm>
#include <optional>

#include "algebra3d/kernel/arrangement/detail/faces_above.h"
#include "algebra3d/kernel/arrangement/detail/seed_from_above.h"
#include "base/propagate.h"

namespace algebra3d::arrangement {
namespace {

/// If no more operands than this may surround a patch, they are looked at one by one.
constexpr std::size_t kMany = 8;

class UpwardLinker {
 public:
  UpwardLinker(const Subdivision& subdivision, LinkedWindings& linked, PointLocation& location)
      : operands_(subdivision.operands),
        patches_(subdivision.patches),
        linked_(linked),
        location_(location),
        face_tree_(operands_),
        faces_above_(operands_, face_tree_) {}

  Result<SetWindings> run(const Monitor& monitor);

 private:
  /// Windings of a cell: those of a front winding and how much they exceed it.
  struct CellWindings {
    FrontWindingId front;
    WindingVector excess;
  };
  /// Where a ray upwards has ended.
  struct RayEnd {
    CellWindings below;                 ///< the cell above the last face of the own set
    std::optional<CellWindings> above;  ///< the same cell, as another set knows it; nothing: the unbounded cell
  };
  /// A face by the height of its middle, rounded.
  struct Highest {
    double height;
    InputFaceId face;

    void raise_to(const Highest& other) {
      if (face.is_none() || height < other.height) *this = other;
    }
  };

  FrontWindingId set_of(PatchId patch) { return linked_.sets.find(linked_.ids.of(patch)).set; }
  CellWindings cell_beside(PatchId patch, bool is_in_front) const;
  std::vector<InputFaceId> highest_faces();
  IdVector<PatchId, Highest> highest_faces_of_patches() const;
  std::optional<RayEnd> shoot_up(InputFaceId start);

  const Operands& operands_;
  const Patches& patches_;
  LinkedWindings& linked_;
  PointLocation& location_;
  FaceTree face_tree_;
  FacesAbove faces_above_;
};

UpwardLinker::CellWindings UpwardLinker::cell_beside(PatchId patch, bool is_in_front) const {
  const std::size_t group = operands_.group(patches_[patch].operand);
  return {linked_.ids.of(patch), WindingVector::of_group(group, is_in_front ? 0 : 1)};
}

IdVector<PatchId, UpwardLinker::Highest> UpwardLinker::highest_faces_of_patches() const {
  IdVector<PatchId, Highest> highest(patches_.patches.size());
  for (const InputFaceId face : operands_.faces()) {
    const PatchId patch = patches_.of_face[face];
    if (patch.is_none()) continue;
    const TriangleRef corners = operands_.corners(face);
    highest[patch].raise_to({corners[0].approx.z / 3 + corners[1].approx.z / 3 + corners[2].approx.z / 3, face});
  }
  return highest;
}

/// The highest face (by its middle) of the patches of each set, ascending: from there the way up is shortest.
std::vector<InputFaceId> UpwardLinker::highest_faces() {
  const IdVector<PatchId, Highest> of_patches = highest_faces_of_patches();
  std::map<FrontWindingId, Highest> of_sets;
  for (const PatchId patch : of_patches.ids()) of_sets[set_of(patch)].raise_to(of_patches[patch]);
  std::vector<InputFaceId> result;
  result.reserve(of_sets.size());
  for (const auto& [set, highest] : of_sets) result.push_back(highest.face);
  std::ranges::sort(result);
  return result;
}

/// Nothing if the ray hits a face that is in no patch, or two faces at one height.
std::optional<UpwardLinker::RayEnd> UpwardLinker::shoot_up(InputFaceId start) {
  const PatchId patch = patches_.of_face[start];
  const FrontWindingId own_set = set_of(patch);
  RayEnd end{cell_beside(patch, is_cell_above_in_front(operands_.corners(start))), {}};
  bool are_all_patches = true;
  const bool is_ordered = faces_above_.for_each(centroid(operands_, start), [&](InputFaceId face, int sign) {
    const PatchId hit = patches_.of_face[face];
    are_all_patches = !hit.is_none();
    if (!are_all_patches) return false;
    const bool is_own = set_of(hit) == own_set;
    if (is_own)
      end.below = cell_beside(hit, sign > 0);
    else
      end.above = cell_beside(hit, sign < 0);
    return is_own;
  });
  if (!is_ordered || !are_all_patches) return std::nullopt;
  return end;
}

/// A set that is linked to others is one with them from then on; since each takes one step that links two sets or ends
/// in the unbounded cell, one of those that are linked together has ended there.
Result<SetWindings> UpwardLinker::run(const Monitor& monitor) {
  SetWindings known;
  if (operands_.count() <= kMany) return known;
  std::vector<CellWindings> unbounded;
  for (const InputFaceId face : highest_faces()) {
    if (!location_.has_more_near(operands_.point(Operands::halfedge(face, 0)), kMany)) continue;
    A3D_TRY(monitor.check());
    const std::optional<RayEnd> end = shoot_up(face);
    if (!end) continue;
    if (end->above)
      linked_.sets.unite(end->below.front, end->above->front, end->below.excess - end->above->excess);
    else
      unbounded.push_back(end->below);
  }
  for (const auto& [front, excess] : unbounded) {
    const auto [set, difference] = linked_.sets.find(front);
    known.try_emplace(set, -excess - difference);
  }
  return known;
}

}  // namespace

Result<SetWindings> link_upwards(const Subdivision& subdivision, LinkedWindings& linked, PointLocation& location,
                                 const Monitor& monitor) {
  return UpwardLinker(subdivision, linked, location).run(monitor);
}

}  // namespace algebra3d::arrangement
