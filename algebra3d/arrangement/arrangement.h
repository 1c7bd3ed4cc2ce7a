#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// One solid that takes part in a set operation.
struct Operand {
  const TriangleMesh* mesh = nullptr;  ///< a valid volume (validity.h)
  /// 0 or 1: what the rule does not tell apart is one group.
  std::uint32_t group = 0;
};

/// Says of a place off all boundaries whether the result holds it, by the number of operands of each group that do.
/// False where no operand is.
using KeepRule = std::function<bool(const std::array<std::int32_t, 2>& holding)>;

/// The regularised set operation that `rule` says, on any number of solids at once: the closure of the inside of the
/// set of places that the rule keeps.
///
/// The result is a valid volume: cavities, nested bodies and bodies that touch included; the empty mesh if nothing is
/// kept. Its vertices are vertices of the operands, or the exact points in which three of their planes meet. Where
/// operands touch, facets are merged and corners that nothing demands are left out; faces that touch no other operand
/// are taken over as they are. The same operands give the same triangles.
/// Exactness: exact, for all valid operands. Errors: interrupted; limit_exceeded beyond TriangleMesh::kMaxFaces.
/// Cost: near-linear in the faces of operands whose boxes meet, linear in those of the others.
/// Source: the whole is ours; see docs/set-operations.md for its parts.
Result<TriangleMesh> combine_solids(std::span<const Operand> operands, const KeepRule& rule,
                                    const std::atomic<bool>* cancel = nullptr);

}  // namespace algebra3d
