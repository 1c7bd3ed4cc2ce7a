#pragma once

#include <cstddef>
#include <functional>

#include "algebra3d/base/box3.h"
#include "queries/streams/datum.h"
#include "queries/streams/mapping.h"

namespace queries {

/// One side of a join by boxes: a stream, and its spatial attribute.
struct JoinSide {
  TupleStreamPtr stream;
  std::size_t attribute;
};

/// The window that looks up the partners of a tuple, from the box of its attribute; empty for no partners.
using WindowOfBox = std::function<algebra3d::Box3(const algebra3d::Box3& box)>;

/// The concatenated pairs of tuples of both sides such that the box of the first meets the window of the second, in the
/// order of the second stream. The first side is held in memory with an R-tree over it, part by part if it exceeds the
/// work memory (block_join.h). Interruptible.
TupleStreamPtr box_join(JoinSide build, JoinSide probe, WindowOfBox window, const Context& context);

}  // namespace queries
