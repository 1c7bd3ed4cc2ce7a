#include "algebra3d/kernel/arrangement/detail/plane_overlay.h"

#include <array>

#include "algebra3d/kernel/arrangement/detail/collinear_cuts.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A segment or a touched node, among the elements of one plane.
using ElementId = StrongId<struct ElementTag>;
using Elements = IdSpan<ElementId, const PlaneElement>;

/// Cuts the segments of one plane at one another.
class PlaneOverlay {
 public:
  PlaneOverlay(const Facets& facets, const SegmentComplex& complex, Elements elements, PlaneCuts& found)
      : complex_(complex),
        elements_(elements),
        plane_(elements[ElementId(0)].plane),
        projection_(facets.planes[plane_].projection),
        found_(found) {}

  void run();

 private:
  /// More elements than this are paired by a tree of their boxes.
  static constexpr std::size_t kFewElements = 24;

  Box3 box_of(const PlaneElement& element) const;
  void relate_all_pairs();
  void relate(const PlaneElement& a, const PlaneElement& b);
  void relate_node(const PlaneElement& node, const PlaneElement& segment);
  void relate_segments(const PlaneElement& a, const PlaneElement& b);
  void cut(const PlaneElement& segment, NodeId node) { cut_if_inside(complex_, segment.segment, node, found_.cuts); }
  int turn(NodeId a, NodeId b, NodeId c) const {
    if (a == b || b == c || a == c) return 0;
    return orient2d(projection_, complex_.nodes[a], complex_.nodes[b], complex_.nodes[c]);
  }

  const SegmentComplex& complex_;
  Elements elements_;
  PlaneId plane_;
  Projection projection_;
  PlaneCuts& found_;
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
  std::array<Box3, kFewElements> boxes;
  for (const ElementId e : elements_.ids()) boxes[e.index()] = box_of(elements_[e]);
  for (const ElementId a : elements_.ids())
    for (const ElementId b : IdRange(ElementId(a.index() + 1), ElementId(elements_.size())))
      if (boxes[a.index()].intersects(boxes[b.index()])) relate(elements_[a], elements_[b]);
}

void PlaneOverlay::relate(const PlaneElement& a, const PlaneElement& b) {
  if (a.segment == b.segment) return;  // also two nodes
  if (a.facet == b.facet && !a.facet.is_none() && (a.is_boundary || b.is_boundary)) return;
  if (a.is_node()) return relate_node(a, b);
  if (b.is_node()) return relate_node(b, a);
  relate_segments(a, b);
}

void PlaneOverlay::relate_node(const PlaneElement& node, const PlaneElement& segment) {
  if (turn(segment.from, segment.to, node.from) == 0) cut(segment, node.from);
}

void PlaneOverlay::relate_segments(const PlaneElement& a, const PlaneElement& b) {
  const int b_from = turn(a.from, a.to, b.from), b_to = turn(a.from, a.to, b.to);
  if (b_from == 0 && b_to == 0) return found_.collinear.push_back({a.segment, b.segment});
  if (b_from * b_to > 0) return;
  const int a_from = turn(b.from, b.to, a.from), a_to = turn(b.from, b.to, a.to);
  if (a_from * a_to > 0) return;
  if (b_from == 0) cut(a, b.from);
  if (b_to == 0) cut(a, b.to);
  if (a_from == 0) cut(b, a.from);
  if (a_to == 0) cut(b, a.to);
  if (b_from * b_to < 0 && a_from * a_to < 0) found_.crossings.push_back({plane_, a.segment, b.segment});
}

}  // namespace

void overlay_plane(const Facets& facets, const SegmentComplex& complex, std::span<const PlaneElement> elements,
                   PlaneCuts& found) {
  PlaneOverlay(facets, complex, Elements(elements), found).run();
}

}  // namespace algebra3d::arrangement
