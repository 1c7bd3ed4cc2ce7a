// makeRegion: a region of its corners.
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/planar.h"

namespace algebra3d {
namespace {

/// One cycle of corners in their order.
class CycleOfCorners {
 public:
  void step(const Point2d& corner) { corners_.push_back(corner.position); }
  void combine(CycleOfCorners&& later) {
    corners_.reserve(corners_.size() + later.corners_.size());
    for (std::size_t i = 0; i < later.corners_.size(); ++i) corners_.push_back(later.corners_[i]);
  }
  Result<Maybe<Region>> finish(Context& context) {
    Polygons polygons;
    polygons.cycle_ends = {static_cast<std::uint32_t>(corners_.size())};
    polygons.face_ends = {1};
    polygons.corners = std::move(corners_);
    return Region::prove(polygons, context.monitor());
  }

 private:
  PointArray corners_;
};

Overload region_of_corners() {
  Overload overload = aggregate<CycleOfCorners>("corners");
  overload.counts_undefined = true;
  return overload;
}

}  // namespace

void register_make_regions(OperatorGroup& group) {
  group.add({
      .name = "makeRegion",
      .doc = "The region whose boundary passes through points, in order.",
      .detail =
          "The points are one cycle in either orientation; the first point is not repeated. Undefined, with the "
          "reason, if it bounds no region: with fewer than three points, or if segments intersect. Undefined points "
          "are left out, with a note.",
      .exactness = Exactness::exact,
      .cost = Cost::sorting,
      .overloads = {region_of_corners()},
      .examples = {{{"(point (0 0))", "(point (4 0))", "(point (4 4))", "(point undefined)", "(point (0 4))"},
                    "((((0.0 0.0) (4.0 0.0) (4.0 4.0) (0.0 4.0))))"},
                   {{"(point (0 0))", "(point (4 0))"}, "undefined"}},
      .errors = {{{"1"}, "makeRegion: expected values of type point, got int"}},
  });
}

}  // namespace algebra3d
