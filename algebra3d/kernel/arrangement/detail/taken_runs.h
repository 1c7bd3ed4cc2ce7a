#pragma once

#include <cstddef>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/patch_corners.h"

namespace algebra3d::arrangement {

/// A run of faces of an operand that become consecutive faces of the result, too.
struct TakenRun {
  OperandId operand;
  FaceId first;      ///< of the operand's mesh
  FaceId new_first;  ///< of the result
  std::size_t count;
  bool is_flipped;  ///< the result has them flipped

  bool contains(FaceId face) const { return std::size_t{face.index()} - first.index() < count; }
  /// The half-edge of the result along the edge of one of its half-edges. Flipped faces keep their first corner first,
  /// so their half-edges come in the opposite order.
  HalfedgeId along(HalfedgeId halfedge) const {
    const std::uint32_t moved = halfedge.index() + shift();
    return HalfedgeId(is_flipped ? moved + 2 - 2 * (moved % 3) : moved);
  }
  /// The half-edge of the result that leaves the vertex which the half-edge leaves.
  HalfedgeId leaving(HalfedgeId halfedge) const {
    const std::uint32_t moved = halfedge.index() + shift(), corner = moved % 3;
    return HalfedgeId(is_flipped && corner != 0 ? moved + 3 - 2 * corner : moved);
  }

 private:
  std::uint32_t shift() const { return 3 * (new_first.index() - first.index()); }
};

/// All faces that a result takes over from operands, in runs: the faces of kept patches, in the order of the operands.
class TakenRuns {
 public:
  /// Cost: linear in the faces, in parallel.
  TakenRuns(const Operands& operands, const Patches& patches, const KeptPatches& kept);

  /// Number of faces.
  std::size_t face_count() const { return runs_.empty() ? 0 : runs_.back().new_first.index() + runs_.back().count; }
  auto begin() const { return runs_.begin(); }
  auto end() const { return runs_.end(); }
  /// The run with a face of an operand; null if the face is not taken over.
  const TakenRun* find(InputFaceId face) const;
  /// The run with a face of the result. Cost: logarithmic.
  const TakenRun& with(FaceId new_face) const;

 private:
  static constexpr std::size_t kFacesPerBlock = 64;

  const Operands& operands_;
  std::vector<TakenRun> runs_;
  // For each block of input faces the first run that ends after its beginning.
  std::vector<std::uint32_t> first_runs_;
};

}  // namespace algebra3d::arrangement
