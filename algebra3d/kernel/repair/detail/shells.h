#pragma once

#include <memory>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "base/disjoint_ids.h"
#include "base/id_vector.h"

namespace algebra3d {

/// A shell of a soup.
using ShellId = StrongId<struct ShellTag>;

/// A shell of a soup: manifold patches, united across non-manifold edges at which each alone would be unbalanced.
/// Bodies that touch in an edge are shells by themselves here, whereas shells of a valid volume (validity.h) are faces
/// connected across common edges of any kind.
struct Shell {
  std::vector<FaceId> triangles;  ///< ascending
  Box3 box;
  /// Exact, or for large closed shells an estimate with the right sign, good enough to sort shells by size. For open
  /// shells the rounded volume of the pyramids over the triangles, with the apex in the middle of the box.
  Rational volume;
  bool is_flipped = false;

  Rational size() const { return volume.abs(); }
  /// Notes that all triangles are to be flipped.
  void flip() {
    is_flipped = !is_flipped;
    volume = -volume;
  }
};

/// The shells of a soup, in the order of their first triangle. Errors: interrupted. Cost: linear, and that of
/// exact_volume for shells whose estimates overlap.
Result<IdVector<ShellId, Shell>> find_shells(const IndexedSoup& soup, const Monitor& monitor);

}  // namespace algebra3d
