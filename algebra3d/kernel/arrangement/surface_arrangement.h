#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/operand.h"

namespace algebra3d {

/// The parts that a set operation on two surfaces keeps: those that either, both, only the first, or exactly one of
/// them covers.
enum class SurfaceRule : std::uint8_t { either, both, first_only, exactly_one };

/// The set operation on two surfaces: their triangles are divided at one another, and the parts that the rule names are
/// kept, each once. `both` keeps where the two lie upon each other in a plane, not lines in which they cross. A part
/// that both cover is oriented as in the first one. Edges in which kept parts of several planes meet are edges of the
/// result; parts of one plane that nothing divides are merged where the surfaces touch. No orientation is assumed;
/// boundaries and edges with any number of faces are allowed; groups of the operands mean nothing. The result is a
/// valid surface. Runs stages 0 to 7 and 9 of docs/set-operations.md.
/// Exactness: exact, for all valid operands. Errors: interrupted; limit_exceeded beyond TriangleMesh::kMaxFaces faces;
/// internal if operands are not valid, as far as that is noticed. Cost: near-linear where the surfaces meet, linear
/// elsewhere.
Result<TriangleMesh> combine_surfaces(const Operand& first, const Operand& second, SurfaceRule rule,
                                      const Monitor& monitor = {});

/// The union of any number of surfaces, as above. A part that several cover is oriented as in the first of them. Only
/// the limits of `limits` are used. Errors: also limit_exceeded beyond them.
Result<TriangleMesh> unite_surfaces(std::span<const Operand> surfaces, const Monitor& monitor = {},
                                    const ArrangementOptions& limits = {});

}  // namespace algebra3d
