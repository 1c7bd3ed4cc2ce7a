#include "algebra3d/kernel/arrangement/detail/collinear_cuts.h"

#include <algorithm>
#include <compare>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/disjoint_sets.h"
#include "base/equal_span.h"

namespace algebra3d::arrangement {
namespace {

/// A node at which the segments of a line end or are cut. A line is named by one of its segments.
struct NodeOnLine {
  SegmentId line;
  NodeId node;

  friend auto operator<=>(const NodeOnLine&, const NodeOnLine&) = default;
};

/// Segments by the lines in which they lie, as far as these have more than one segment.
class Lines {
 public:
  explicit Lines(const SegmentComplex& complex) : lines_(complex.segments.size()), is_shared_(complex.segments.size()) {
    for (const auto& [a, b] : complex.collinear) {
      lines_.unite(a.index(), b.index());
      is_shared_[a] = is_shared_[b] = true;
    }
  }

  /// None for a segment that is alone on its line.
  SegmentId of(SegmentId segment) {
    return is_shared_[segment] ? SegmentId(lines_.find(segment.index())) : SegmentId::none();
  }

 private:
  DisjointSets lines_;
  IdVector<SegmentId, bool> is_shared_;
};

/// Ascending, each once.
std::vector<NodeOnLine> nodes_on_lines(const SegmentComplex& complex, Lines& lines) {
  std::vector<NodeOnLine> nodes;
  const auto add = [&](SegmentId segment, NodeId node) {
    if (const SegmentId line = lines.of(segment); !line.is_none()) nodes.push_back({line, node});
  };
  for (const SegmentId s : complex.segments.ids()) {
    add(s, complex.segments[s].from);
    add(s, complex.segments[s].to);
  }
  for (const auto& [segment, node] : complex.cuts) add(segment, node);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void cut_if_inside(const SegmentComplex& complex, SegmentId segment, NodeId node, std::vector<Cut>& cuts) {
  const auto [from, to] = std::pair(complex.segments[segment].from, complex.segments[segment].to);
  if (node == from || node == to) return;
  const NodePool& nodes = complex.nodes;
  if (compare(nodes[from], nodes[node]) == compare(nodes[node], nodes[to])) cuts.push_back({segment, node});
}

void share_cuts(SegmentComplex& complex) {
  Lines lines(complex);
  const std::vector<NodeOnLine> nodes = nodes_on_lines(complex, lines);
  for (const SegmentId s : complex.segments.ids()) {
    const SegmentId line = lines.of(s);
    if (line.is_none()) continue;
    for (const NodeOnLine& at : equal_span(nodes, line, &NodeOnLine::line))
      cut_if_inside(complex, s, at.node, complex.cuts);
  }
}

}  // namespace algebra3d::arrangement
