#include "algebra3d/values/spatial_relations/place_of_box.h"

#include "algebra3d/values/spatial_relations/point_location.h"

namespace algebra3d {
namespace {

struct BoxPlacer {
  const Box3& box;
  double reach;

  PlaceOfBox operator()(const PointSet&) const { return {}; }
  PlaceOfBox operator()(const Box3&) const { return {}; }
  PlaceOfBox operator()(const Surface3d& surface) const {
    return {surface.geometry().hierarchy().least_gap(box, reach), false};
  }
  // The box is connected, so if it does not meet the boundary, all of it lies where one corner lies.
  PlaceOfBox operator()(const Volume3d& solid) const {
    const double gap = solid.geometry().hierarchy().least_gap(box, reach);
    const bool is_apart = gap > 0;
    return {gap, is_apart && place_in_solid(box.min, solid.geometry()) == Placement::inside};
  }
};

}  // namespace

PlaceOfBox place_of_box(const Box3& box, const SpatialSet& set, double reach) {
  return std::visit(BoxPlacer{box, reach}, set);
}

}  // namespace algebra3d
