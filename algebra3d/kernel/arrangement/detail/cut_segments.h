#pragma once

#include <span>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/segment_complex.h"
#include "algebra3d/kernel/arrangement/detail/slice.h"

namespace algebra3d::arrangement {

/// The nodes along each segment, from one end over all cuts to the other end.
class CutSegments {
 public:
  CutSegments() = default;
  /// The cuts of the complex must be sorted, as overlay leaves them. Cost: near-linear.
  explicit CutSegments(const SegmentComplex& complex);

  std::size_t size() const { return slices_.size(); }
  std::span<const NodeId> nodes(SegmentId segment) const { return slices_[segment].of(nodes_); }

 private:
  void sort_along(const SegmentComplex& complex, const Slice& slice);

  IdVector<SegmentId, Slice> slices_;
  std::vector<NodeId> nodes_;
};

}  // namespace algebra3d::arrangement
