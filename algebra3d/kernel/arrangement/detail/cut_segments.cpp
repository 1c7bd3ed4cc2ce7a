#include "algebra3d/kernel/arrangement/detail/cut_segments.h"

#include <algorithm>
#include <compare>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {

CutSegments::CutSegments(const SegmentComplex& complex) {
  slices_.reserve(complex.segments.size());
  nodes_.reserve(2 * complex.segments.size() + complex.cuts.size());
  auto cut = complex.cuts.begin();
  for (const SegmentId s : complex.segments.ids()) {
    const Segment& segment = complex.segments[s];
    const std::size_t first = nodes_.size();
    nodes_.push_back(segment.from);
    for (; cut != complex.cuts.end() && cut->segment == s; ++cut)
      if (cut->node != segment.from && cut->node != segment.to) nodes_.push_back(cut->node);
    nodes_.push_back(segment.to);
    slices_.push_back(Slice::from(first, nodes_));
    if (slices_.back().size() > 3) sort_along(complex, slices_.back());  // one cut is between the ends
  }
}

/// On a line, the lexicographic order is that along it.
void CutSegments::sort_along(const SegmentComplex& complex, const Slice& slice) {
  const auto begin = nodes_.begin() + slice.first, end = nodes_.begin() + slice.last;
  const NodeId from = *begin;
  const NodePool& nodes = complex.nodes;
  std::sort(begin, end, [&](NodeId a, NodeId b) { return std::is_lt(compare(nodes[a], nodes[b])); });
  if (*begin != from) std::reverse(begin, end);
}

}  // namespace algebra3d::arrangement
