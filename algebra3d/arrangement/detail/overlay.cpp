#include "algebra3d/arrangement/detail/overlay.h"

#include <algorithm>
#include <functional>
#include <span>

#include "algebra3d/arrangement/detail/bucket_sort.h"
#include "algebra3d/arrangement/detail/collinear_cuts.h"
#include "algebra3d/arrangement/detail/crossings.h"
#include "algebra3d/arrangement/detail/id_tree.h"
#include "algebra3d/arrangement/detail/plane_elements.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A segment or a touched node, among the elements of one plane.
using ElementId = StrongId<struct ElementTag>;
using Elements = IdSpan<ElementId, const PlaneElement>;

/// Cuts the segments of one plane at one another.
class PlaneOverlay {
 public:
  PlaneOverlay(const Facets& facets, SegmentComplex& complex, Crossings& crossings, Elements elements)
      : facets_(facets),
        complex_(complex),
        crossings_(crossings),
        elements_(elements),
        plane_(elements[ElementId(0)].plane),
        projection_(facets.planes[plane_].projection) {}

  void run();

 private:
  /// More elements than this are paired by a tree of their boxes.
  static constexpr std::size_t kFewElements = 24;

  Box3 box_of(const PlaneElement& element) const;
  void relate_all_pairs();
  void relate(const PlaneElement& a, const PlaneElement& b);
  void relate_node(const PlaneElement& node, const PlaneElement& segment);
  void relate_segments(const PlaneElement& a, const PlaneElement& b);
  void cross(const PlaneElement& a, const PlaneElement& b);
  NodeId crossing_of(const PlaneElement& a, const PlaneElement& b);
  InputEdgeId edge_of(const PlaneElement& element) const { return complex_.segments[element.segment].edge; }
  PlaneId plane_across(const PlaneElement& element) const;
  int turn(NodeId a, NodeId b, NodeId c) const {
    if (a == b || b == c || a == c) return 0;
    return orient2d(projection_, complex_.nodes[a], complex_.nodes[b], complex_.nodes[c]);
  }

  const Facets& facets_;
  SegmentComplex& complex_;
  Crossings& crossings_;
  Elements elements_;
  PlaneId plane_;
  Projection projection_;
};

Box3 PlaneOverlay::box_of(const PlaneElement& element) const {
  Box3 box = algebra3d::box_of(complex_.nodes[element.from]);
  box.extend(algebra3d::box_of(complex_.nodes[element.to]));
  return box;
}

void PlaneOverlay::run() {
  if (elements_.size() < 2) return;
  if (elements_.size() <= kFewElements) return relate_all_pairs();
  IdTree<ElementId>::Boxes boxes;
  boxes.reserve(elements_.size());
  for (const ElementId e : elements_.ids()) boxes.add(box_of(elements_[e]), e);
  boxes.tree().for_each_pair([&](ElementId a, ElementId b) {
    relate(elements_[a], elements_[b]);
    return true;
  });
}

void PlaneOverlay::relate_all_pairs() {
  IdVector<ElementId, Box3> boxes;
  boxes.reserve(elements_.size());
  for (const PlaneElement& element : elements_) boxes.push_back(box_of(element));
  for (const ElementId a : elements_.ids())
    for (const ElementId b : IdRange(ElementId(a.index() + 1), boxes.next_id()))
      if (boxes[a].intersects(boxes[b])) relate(elements_[a], elements_[b]);
}

void PlaneOverlay::relate(const PlaneElement& a, const PlaneElement& b) {
  if (a.segment == b.segment) return;  // also two nodes
  if (a.facet == b.facet && !a.facet.is_none() && (a.is_boundary || b.is_boundary)) return;
  if (a.is_node()) return relate_node(a, b);
  if (b.is_node()) return relate_node(b, a);
  relate_segments(a, b);
}

void PlaneOverlay::relate_node(const PlaneElement& node, const PlaneElement& segment) {
  if (turn(segment.from, segment.to, node.from) == 0) cut_if_inside(complex_, segment.segment, node.from);
}

void PlaneOverlay::relate_segments(const PlaneElement& a, const PlaneElement& b) {
  const int b_from = turn(a.from, a.to, b.from), b_to = turn(a.from, a.to, b.to);
  if (b_from == 0 && b_to == 0) return complex_.note_collinear(a.segment, b.segment);
  if (b_from * b_to > 0) return;
  const int a_from = turn(b.from, b.to, a.from), a_to = turn(b.from, b.to, a.to);
  if (a_from * a_to > 0) return;
  if (b_from == 0) cut_if_inside(complex_, a.segment, b.from);
  if (b_to == 0) cut_if_inside(complex_, a.segment, b.to);
  if (a_from == 0) cut_if_inside(complex_, b.segment, a.from);
  if (a_to == 0) cut_if_inside(complex_, b.segment, a.to);
  if (b_from * b_to < 0 && a_from * a_to < 0) cross(a, b);
}

/// A plane through the segment other than this one; none if it is an edge of an operand.
PlaneId PlaneOverlay::plane_across(const PlaneElement& element) const {
  return edge_of(element).is_none() ? other_plane(facets_, complex_.segments[element.segment], plane_)
                                    : PlaneId::none();
}

NodeId PlaneOverlay::crossing_of(const PlaneElement& a, const PlaneElement& b) {
  const PlaneId across_a = plane_across(a), across_b = plane_across(b);
  if (!across_a.is_none() && !across_b.is_none()) return crossings_.of_planes(plane_, across_a, across_b);
  if (!across_a.is_none()) return crossings_.of_edge_and_plane({edge_of(b), across_a});
  if (!across_b.is_none()) return crossings_.of_edge_and_plane({edge_of(a), across_b});
  return crossings_.of_edges(edge_of(a), edge_of(b), projection_);
}

void PlaneOverlay::cross(const PlaneElement& a, const PlaneElement& b) {
  const NodeId node = crossing_of(a, b);
  complex_.cuts.push_back({a.segment, node});
  complex_.cuts.push_back({b.segment, node});
}

}  // namespace

Result<SegmentComplex> overlay(const Operands& operands, const Facets& facets, SegmentComplex complex,
                               const Monitor& monitor, std::size_t max_cuts) {
  monitor.tell("finding crossings");
  Crossings crossings(operands, facets, complex);
  const std::vector<PlaneElement> elements = plane_elements(facets, complex);
  for (std::size_t begin = 0, end = 0; begin < elements.size(); begin = end) {
    while (end < elements.size() && elements[end].plane == elements[begin].plane) ++end;
    ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
    const std::span<const PlaneElement> in_plane = std::span(elements).subspan(begin, end - begin);
    PlaneOverlay(facets, complex, crossings, Elements(in_plane)).run();
    if (complex.cuts.size() > max_cuts)
      return Error{ErrorCode::limit_exceeded, "triangles cut each other more than {} times", max_cuts};
  }
  share_cuts(complex);
  bucket_sort(
      complex.cuts, complex.segments.size(), [](const Cut& cut) { return cut.segment.index(); }, std::less());
  complex.cuts.erase(std::unique(complex.cuts.begin(), complex.cuts.end()), complex.cuts.end());
  return complex;
}

}  // namespace algebra3d::arrangement
