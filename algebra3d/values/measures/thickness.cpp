#include "algebra3d/values/measures/thickness.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "algebra3d/values/measures/detail/opposite_triangle.h"
#include "algebra3d/values/measures/detail/ray_sections.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

RationalVec3 exact_centroid(const TriangleRef& triangle) {
  return Rational(1, 3) * (triangle[0].rational() + triangle[1].rational() + triangle[2].rational());
}

/// By exact sections of all triangles that the ray may meet.
FacetThickness exact_thickness_behind(const Geometry& solid, FaceId face) {
  const TriangleRef triangle = solid.mesh.corners(face);
  const RationalVec3 corner = triangle[0].rational();
  const RationalVec3 u = triangle[1].rational() - corner, v = triangle[2].rational() - corner;
  const Ray ray{exact_centroid(triangle), cross(v, u)};
  const std::vector<RaySection> sections = sections_of(ray, solid);
  // Other triangles may touch the centroid. The ray is inside right behind it, and must leave.
  const auto opposite =
      std::ranges::find_if(sections, [](const RaySection& section) { return section.first.sign() > 0; });
  const Rational square = opposite->first * opposite->first * dot(ray.direction, ray.direction);
  return {face, opposite->face, square.nearest_root()};
}

FacetThickness thickness_behind(OppositeSearch& search, const Geometry& solid, FaceId face) {
  const std::optional<OppositeSearch::Opposite> opposite = search.behind(face);
  return opposite ? FacetThickness{face, opposite->face, opposite->thickness} : exact_thickness_behind(solid, face);
}

}  // namespace

Result<std::vector<FacetThickness>> facet_thicknesses(const Volume3d& solid, const Monitor& monitor) {
  constexpr std::size_t kTask = 64;
  const Geometry& geometry = solid.geometry();
  const double margin = OppositeSearch::margin_of(geometry);
  const Stage stage(monitor, "measuring thickness", geometry.mesh.face_count());
  std::vector<FacetThickness> all =
      parallel_collect(geometry.mesh.face_count(), kTask, [&](std::size_t begin, std::size_t end) {
        std::vector<FacetThickness> part;
        Stage own(stage);
        OppositeSearch search(geometry, margin);
        for (std::size_t f = begin; f < end && own.begin_step(); ++f)
          part.push_back(thickness_behind(search, geometry, FaceId(f)));
        return part;
      });
  A3D_TRY(monitor.check());
  return all;
}

ExactPoint centroid_of(const TriangleRef& triangle) {
  return ExactPoint(exact_centroid(triangle));
}

}  // namespace algebra3d
