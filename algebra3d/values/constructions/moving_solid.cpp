#include "algebra3d/values/constructions/moving_solid.h"

#include <array>
#include <utility>

#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/planar/constrained_delaunay.h"
#include "algebra3d/kernel/planar/noding.h"
#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/kernel/validity/validity.h"
#include "algebra3d/values/constructions/detail/heights.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

/// The closed surface of a slab, triangle by triangle, over the corners at its start and then those at its end.
class SlabSurface {
 public:
  SlabSurface(const MovingSlab& slab, const Monitor& monitor)
      : start_(slab.polygons->start),
        end_(slab.polygons->end),
        count_(static_cast<std::uint32_t>(start_.corners.size())),
        monitor_(monitor) {
    add_at_height(start_.corners, slab.from, points_);
    add_at_height(end_.corners, slab.to, points_);
  }

  /// Equal points are one; triangles without area are left out.
  Result<TriangleMesh> mesh();

 private:
  Status add_cover(const Polygons& polygons, bool is_above);
  void add_side(std::uint32_t a, std::uint32_t b);
  void add_sides();

  const Polygons &start_, &end_;
  std::uint32_t count_;
  Monitor monitor_;
  PointArray points_;
  std::vector<Triangle> triangles_;
};

/// At the end of a slab corners may fall together and segments lie on each other: the faces that they bound are
/// covered.
Status SlabSurface::add_cover(const Polygons& polygons, bool is_above) {
  A3D_ASSIGN(const std::vector<DirectedEdge> edges, noded(polygons.corners, segments_of(polygons), monitor_));
  A3D_ASSIGN(const std::vector<Triangle> cover, constrained_delaunay(polygons.corners, edges, monitor_));
  for (const auto& [a, b, c] : cover)
    triangles_.push_back(is_above ? Triangle{count_ + a, count_ + b, count_ + c} : Triangle{a, c, b});
  return {};
}

void SlabSurface::add_side(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t a_later = count_ + a, b_later = count_ + b;
  if (std::is_lt(compare(points_[a], points_[b]))) {
    triangles_.push_back({a, b, b_later});
    triangles_.push_back({a, b_later, a_later});
  } else {
    triangles_.push_back({a, b, a_later});
    triangles_.push_back({b, b_later, a_later});
  }
}

void SlabSurface::add_sides() {
  for (std::size_t c = 0; c < start_.cycle_count(); ++c) {
    std::uint32_t previous = start_.cycle_ends[c] - 1;
    for (std::uint32_t i = start_.first_corner(c); i < start_.cycle_ends[c]; ++i)
      add_side(std::exchange(previous, i), i);
  }
}

Result<TriangleMesh> SlabSurface::mesh() {
  A3D_TRY(add_cover(start_, false));
  A3D_TRY(add_cover(end_, true));
  add_sides();
  std::vector<std::array<ExactPoint, 3>> corners;
  corners.reserve(triangles_.size());
  for (const auto& [a, b, c] : triangles_)
    if (!collinear(points_[a], points_[b], points_[c]))
      corners.push_back({points_.point(a), points_.point(b), points_.point(c)});
  WeldedTriangles welded = weld(corners);
  return TriangleMesh(std::move(welded.points), welded.triangles);
}

}  // namespace

Result<Maybe<TriangleMesh>> swept_solid(const MovingSlab& slab, const Monitor& monitor) {
  A3D_ASSIGN(TriangleMesh surface, SlabSurface(slab, monitor).mesh());
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = monitor.cancel()};
  A3D_ASSIGN(const ValidityReport proof, prove_volume(surface, options));
  if (proof.is_valid()) return Maybe<TriangleMesh>(std::move(surface));
  // Where covers have corners in the middle of edges, or sides touch, the surface is divided first. It bounds a solid
  // if it winds round every place once or not at all.
  bool is_simple = true;
  A3D_ASSIGN(TriangleMesh solid, solid_by_winding(
                                     surface,
                                     [&](int winding) {
                                       is_simple = is_simple && winding == 1;
                                       return winding > 0;
                                     },
                                     monitor));
  if (!is_simple) return Maybe<TriangleMesh>(Undefined{"the sides of the solid pass through one another"});
  return Maybe<TriangleMesh>(std::move(solid));
}

}  // namespace algebra3d
