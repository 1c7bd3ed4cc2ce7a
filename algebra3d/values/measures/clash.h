#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

/// How two solids clash. The kinds are explained in docs/measures.md.
enum class ClashKind : std::uint8_t { duplication, envelopment, piercing, protrusion, touching, clearance };
/// Its name in results: "duplication".
std::string_view name_of(ClashKind kind);

/// A clash, and where it is.
struct Clash {
  ClashKind kind;
  /// Square of the depth, of an envelopment, a piercing or a protrusion: no shift of one of the solids by less ends the
  /// clash. The depth is the largest distance of a boundary point of one solid that lies inside the other from the
  /// other's boundary, within the bounds of farthest_point.h.
  std::optional<Rational> squared_depth;
  Rational squared_distance;  ///< of the solids: 0 unless the clearance is violated
  /// The deepest point; where solids touch or are equal, a common point; where the clearance is violated, the point of
  /// the first solid that is nearest to the second.
  ExactPoint point;
  FaceId first_face, second_face;  ///< a triangle that holds the point, and one nearest to it; may be invalid
};

/// The clash of two solids; nothing if one is empty, or if they do not meet and their distance is at least `clearance`.
/// Kinds are decided exactly. Errors: interrupted, limit_exceeded. Cost: that of the relation of the solids; of their
/// arrangement and a search for the farthest point if they overlap; of their distance if they do not meet.
Result<std::optional<Clash>> clash_of(const Volume3d& a, const Volume3d& b, const Rational& clearance,
                                      const Monitor& monitor = {});

}  // namespace algebra3d
