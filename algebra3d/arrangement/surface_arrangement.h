#pragma once

#include <cstdint>

#include "algebra3d/arrangement/arrangement.h"

namespace algebra3d {

/// What a set operation on two surfaces keeps.
enum class SurfaceRule : std::uint8_t { either, both, first_only, exactly_one };

/// The set operation on two surfaces: their triangles are divided at one another, and the pieces that the rule names
/// are kept, each once: `both` means pieces of planes that both cover. Where both cover a piece, it is turned as in the
/// first. Edges in which kept pieces of several planes meet are edges of the result; pieces of one plane that nothing
/// parts are brought together where the surfaces touch. No orientation is assumed, boundaries and edges with any number
/// of faces are allowed; groups of the operands mean nothing.
/// The result is a valid surface. Exactness: exact, for all valid operands. Errors: interrupted; limit_exceeded beyond
/// TriangleMesh::kMaxFaces. Cost: near-linear where the surfaces meet, linear elsewhere.
Result<TriangleMesh> combine_surfaces(const Operand& first, const Operand& second, SurfaceRule rule,
                                      const Monitor& monitor = {});

/// All triangles of any number of surfaces, divided at one another as above, what several cover once: turned as in the
/// first of them. Of the options, the limits count. Errors: besides those above, limit_exceeded beyond them.
Result<TriangleMesh> unite_surfaces(std::span<const Operand> surfaces, const Monitor& monitor = {},
                                    const ArrangementOptions& limits = {});

}  // namespace algebra3d
