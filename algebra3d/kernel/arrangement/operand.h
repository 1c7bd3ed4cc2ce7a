#pragma once

#include <cstddef>
#include <cstdint>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// A mesh that takes part in an arrangement: a solid, a surface, or a part of triangles that are closed only together
/// (Closure).
struct Operand {
  const TriangleMesh* mesh = nullptr;  ///< a valid volume or surface, as Closure says
  /// Index into WindingVector, 0 or 1. Operands that the rule treats alike are one group. Surfaces ignore it.
  std::uint32_t group = 0;
  /// Boxes of all faces of the mesh; null: made where needed.
  const BoxHierarchy* hierarchy = nullptr;
};

/// Whether each operand of a SolidArrangement is closed alone or only together with others. Arrangements of surfaces
/// (surface_arrangement.h) ignore it.
enum class Closure : std::uint8_t {
  /// Every operand is a valid volume (validity.h).
  each,
  /// Every operand is a valid surface, and the triangles of all operands of a group together are closed: along every
  /// line as many run one way as the other. The operands may cross and overlap each other. Around a non-manifold edge
  /// of an operand that no other one touches, its triangles alternate (EdgeOrder, topology.h).
  together,
};

/// The kind of operands of an arrangement, and limits of its work.
struct ArrangementOptions {
  Closure closure = Closure::each;
  /// Maximum number of candidate face pairs (faces of different operands whose boxes meet); beyond it: limit_exceeded.
  std::size_t max_pairs = SIZE_MAX;
  /// Maximum number of cuts of segments (detail/segment_complex.h), repetitions included. n triangles may make some
  /// n^3. Beyond it: limit_exceeded.
  std::size_t max_cuts = SIZE_MAX;
};

}  // namespace algebra3d
