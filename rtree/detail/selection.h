#pragma once

#include <cstddef>
#include <cstdint>

namespace rtree {

/// An entry during bulk loading: the centre of its box and its index in the input.
struct Seed {
  double center[3];
  std::uint32_t index;
};

/// Reorders `seeds` so that none of the first `first_count` comes after any of the others by (center[axis], index). The
/// selected set does not depend on the order of the seeds. Indices must be distinct; no centre may be NaN. Cost: linear
/// on average. Source: [floyd1975], with a fixed sample instead of recursion.
void select_first(Seed* seeds, std::size_t count, std::size_t first_count, std::size_t axis);

}  // namespace rtree
