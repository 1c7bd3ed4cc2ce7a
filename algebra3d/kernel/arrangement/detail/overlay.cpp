#include "algebra3d/kernel/arrangement/detail/overlay.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/bucket_sort.h"
#include "algebra3d/kernel/arrangement/detail/collinear_cuts.h"
#include "algebra3d/kernel/arrangement/detail/crossings.h"
#include "algebra3d/kernel/arrangement/detail/id_tree.h"
#include "algebra3d/kernel/arrangement/detail/plane_elements.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/exact/exact_work.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

/// Two segments that cross in a point inside of both, in a plane.
struct SegmentCrossing {
  PlaneId plane;
  SegmentId first, second;
};

/// Cuts, collinear pairs and crossings of the segments of some planes, to be added to a SegmentComplex. Crossings have
/// no nodes yet.
struct PlaneCuts {
  std::vector<Cut> cuts;
  std::vector<CollinearSegments> collinear;
  std::vector<SegmentCrossing> crossings;

  /// Number of cuts, with the two of each crossing.
  std::size_t count() const { return cuts.size() + 2 * crossings.size(); }
};

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

/// Adds to `found` how the elements of one plane, at least one, cut each other. Several planes may be done in parallel.
/// Exact. Cost: n log n in the elements and the pairs whose boxes meet.
void overlay_plane(const Facets& facets, const SegmentComplex& complex, std::span<const PlaneElement> elements,
                   PlaneCuts& found) {
  PlaneOverlay(facets, complex, Elements(elements), found).run();
}

/// Cuts of garbage with coordinates of all sizes have numbers of thousands of bits, so few of them take long. The exact
/// arithmetic within this limit takes as long as the greatest number of cuts does with short numbers.
constexpr std::uint64_t kWorkPerCut = 1'000;

std::uint64_t most_work(std::size_t max_cuts) {
  return max_cuts > UINT64_MAX / kWorkPerCut ? UINT64_MAX : max_cuts * kWorkPerCut;
}

/// Finds the cuts in all planes, in parallel, and then adds them in the order of the planes: so nodes have the same ids
/// with any number of threads.
class Overlay {
 public:
  Overlay(const Operands& operands, const Facets& facets, SegmentComplex& complex, const Monitor& monitor,
          std::size_t max_cuts)
      : facets_(facets),
        complex_(complex),
        monitor_(monitor),
        max_cuts_(max_cuts),
        work_limit_(most_work(max_cuts)),
        cut_count_(complex.cuts.size()),
        crossings_(operands, facets, complex) {}

  Status run();

 private:
  std::vector<PlaneCuts> find_cuts();
  PlaneCuts find_cuts_in(IdRange<PlaneId> planes, const PlaneElements& elements);
  void add(const PlaneCuts& found);
  PlaneId plane_across(SegmentId segment, PlaneId plane) const;
  NodeId node_of(const SegmentCrossing& crossing);
  InputEdgeId edge_of(SegmentId segment) const { return complex_.segments[segment].edge; }

  const Facets& facets_;
  SegmentComplex& complex_;
  const Monitor& monitor_;
  std::size_t max_cuts_;
  ExactWorkLimit work_limit_;
  std::atomic<std::size_t> cut_count_;
  Crossings crossings_;
};

std::vector<PlaneCuts> Overlay::find_cuts() {
  const PlaneElements elements(facets_, complex_);
  return parallel_collect(facets_.planes.size(), kPlanesPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<PlaneCuts> found;
    if (begin < end) found.push_back(find_cuts_in(IdRange(PlaneId(begin), PlaneId(end)), elements));
    return found;
  });
}

/// Incomplete once the work is cancelled or there are too many cuts.
PlaneCuts Overlay::find_cuts_in(IdRange<PlaneId> planes, const PlaneElements& elements) {
  PlaneCuts found;
  std::vector<PlaneElement> in_plane;
  for (const PlaneId plane : planes) {
    if (monitor_.is_cancelled() || cut_count_ > max_cuts_ || work_limit_.is_exceeded()) break;
    elements.collect(plane, in_plane);
    if (in_plane.size() < 2) continue;
    const std::size_t before = found.count();
    cut_count_ += work_limit_.measured([&] {
      overlay_plane(facets_, complex_, in_plane, found);
      return found.count() - before;
    });
  }
  return found;
}

void Overlay::add(const PlaneCuts& found) {
  complex_.cuts.insert(complex_.cuts.end(), found.cuts.begin(), found.cuts.end());
  complex_.collinear.insert(complex_.collinear.end(), found.collinear.begin(), found.collinear.end());
  for (const SegmentCrossing& crossing : found.crossings) {
    const NodeId node = node_of(crossing);
    complex_.cuts.push_back({crossing.first, node});
    complex_.cuts.push_back({crossing.second, node});
  }
}

/// A plane through the segment other than `plane`; none if it is an edge of an operand.
PlaneId Overlay::plane_across(SegmentId segment, PlaneId plane) const {
  return edge_of(segment).is_none() ? other_plane(facets_, complex_.segments[segment], plane) : PlaneId::none();
}

NodeId Overlay::node_of(const SegmentCrossing& crossing) {
  const auto& [plane, a, b] = crossing;
  const PlaneId across_a = plane_across(a, plane), across_b = plane_across(b, plane);
  if (!across_a.is_none() && !across_b.is_none()) return crossings_.of_planes(plane, across_a, across_b);
  if (!across_a.is_none()) return crossings_.of_edge_and_plane({edge_of(b), across_a});
  if (!across_b.is_none()) return crossings_.of_edge_and_plane({edge_of(a), across_b});
  return crossings_.of_edges(edge_of(a), edge_of(b), facets_.planes[plane].projection);
}

Status Overlay::run() {
  const std::vector<PlaneCuts> found = find_cuts();
  A3D_TRY(monitor_.check());
  if (cut_count_ > max_cuts_)
    return Error{ErrorCode::limit_exceeded, "triangles cut each other more than {} times", max_cuts_};
  if (work_limit_.is_exceeded())
    return Error{ErrorCode::limit_exceeded,
                 "the coordinates are so far apart that dividing the triangles takes too long"};
  for (const PlaneCuts& part : found) add(part);
  return {};
}

}  // namespace

Result<SegmentComplex> overlay(const Operands& operands, const Facets& facets, SegmentComplex complex,
                               const Monitor& monitor, std::size_t max_cuts) {
  monitor.tell("finding crossings");
  A3D_TRY(Overlay(operands, facets, complex, monitor, max_cuts).run());
  complex.nodes.finish();
  share_cuts(complex);
  bucket_sort(
      complex.cuts, complex.segments.size(), [](const Cut& cut) { return cut.segment.index(); }, std::less());
  complex.cuts.erase(std::unique(complex.cuts.begin(), complex.cuts.end()), complex.cuts.end());
  return complex;
}

}  // namespace algebra3d::arrangement
