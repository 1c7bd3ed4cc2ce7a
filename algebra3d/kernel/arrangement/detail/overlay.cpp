#include "algebra3d/kernel/arrangement/detail/overlay.h"

#include <algorithm>
#include <atomic>
#include <functional>

#include "algebra3d/kernel/arrangement/detail/bucket_sort.h"
#include "algebra3d/kernel/arrangement/detail/collinear_cuts.h"
#include "algebra3d/kernel/arrangement/detail/crossings.h"
#include "algebra3d/kernel/arrangement/detail/plane_overlay.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/exact/exact_work.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

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
