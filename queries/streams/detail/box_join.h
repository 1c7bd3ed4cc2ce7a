#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "algebra3d/base/box3.h"
#include "queries/streams/datum.h"
#include "queries/streams/detail/tuple_pair.h"
#include "queries/streams/mapping.h"

namespace queries {

/// One side of a join by boxes: a stream, and its spatial attribute.
struct JoinSide {
  TupleStreamPtr stream;
  std::size_t attribute;
};

/// The window that looks up the partners of a tuple, from the box of its attribute; empty for no partners.
using WindowOfBox = std::function<algebra3d::Box3(const algebra3d::Box3& box)>;

/// A stream of pairs of tuples, like TupleStream.
class PairStream {
 public:
  virtual ~PairStream() = default;
  PairStream() = default;
  PairStream(const PairStream&) = delete;
  PairStream& operator=(const PairStream&) = delete;
  virtual Result<TuplePair> next() = 0;
};
using PairStreamPtr = std::shared_ptr<PairStream>;

/// The pairs of tuples of both sides such that the box of the first (the build side) meets the window of the second
/// (the probe side), in the order of the second stream, and for each of its tuples in that of the first. The first side
/// is held in memory with an R-tree over it; if it does not fit, both sides are divided by space (partitioned_boxes.h).
/// Interruptible.
PairStreamPtr box_pairs(JoinSide build, JoinSide probe, WindowOfBox window, const Context& context);

/// The pairs of different tuples of one stream that meet in this way, each once: the earlier tuple first, in the order
/// of the later ones, and for each of these in that of the earlier ones. As above.
PairStreamPtr box_pairs_within(JoinSide side, WindowOfBox window, const Context& context);

/// The tuples of pairs, concatenated.
TupleStreamPtr concatenated_pairs(PairStreamPtr pairs);

}  // namespace queries
