#include "algebra3d/kernel/rounding/rounded_image.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/predicates_filter.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/rounding/detail/simpler_form.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The vertices of the image, rounded.
RoundedVertices image_vertices(const AffineMap& map, const PointArray& points) {
  constexpr std::size_t kImagesPerTask = 1000;
  RoundedVertices result;
  std::vector<Vec3> places(points.size());
  result.movements.resize(points.size());
  parallel_for(points.size(), kImagesPerTask, [&](std::size_t i) {
    places[i] = map.apply_rounded(points[i]);
    if (!is_finite(places[i]) || map.image_is_double(points[i], places[i])) return;
    const double spacing = CoordinateGrid::doubles().spacing_up_to(detail::largest(places[i]));
    result.movements[i] = std::sqrt(3.0) / 2 * spacing;  // half a spacing along each axis
  });
  result.are_finite = std::ranges::all_of(places, is_finite);
  result.points = PointArray(std::move(places));
  result.moved = static_cast<std::size_t>(std::ranges::count_if(result.movements, [](double m) { return m > 0; }));
  result.largest_movement = rounded_up(std::ranges::max(result.movements));
  return result;
}

/// One flag per vertex: whether it is a corner of a face with a corner that moved.
std::vector<bool> are_at_moved_faces(const TriangleMesh& mesh, const RoundedVertices& vertices) {
  std::vector<bool> result(mesh.vertex_count());
  const std::vector<bool> moves = faces_that_move(mesh, vertices.movements);
  for (const FaceId face : faces(mesh))
    if (moves[face.index()])
      for (const std::uint32_t v : mesh.triangle(face)) result[v] = true;
  return result;
}

}  // namespace

Result<std::optional<RoundedSolid>> rounded_image(const AffineMap& map, const TriangleMesh& solid,
                                                  const std::atomic<bool>* cancel) {
  if (solid.is_empty()) return std::optional<RoundedSolid>();
  const RoundedVertices vertices = image_vertices(map, solid.points());
  if (!vertices.are_finite || !are_apart(vertices)) return std::optional<RoundedSolid>();
  RoundedSolid result{TriangleMesh(solid, vertices.points)};
  result.moved_vertices = vertices.moved;
  result.largest_movement = vertices.largest_movement;
  result.method = RoundingMethod::vertices_moved;
  ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = cancel};
  const CoordinateGrid grid = CoordinateGrid::doubles();
  const double tolerance = superfluous_within(*result.mesh, grid, grid.spacing_up_to(largest_coordinate(*result.mesh)));
  TriangleStars stars(*result.mesh);
  bool is_simpler = false;
  if (tolerance > 0) {
    A3D_ASSIGN(is_simpler, make_simpler(stars, are_at_moved_faces(solid, vertices), tolerance, cancel));
  }
  if (is_simpler) {
    result.mesh = stars.mesh();
    result.largest_movement = rounded_up(result.largest_movement + 2 * tolerance);
  } else {
    options.preimage = preimage_of(map, solid, vertices.points.approx());
  }
  A3D_ASSIGN(const ValidityReport report, prove_volume(*result.mesh, options));
  const bool is_found = report.is_valid() && report.contact_vertices == 0;
  return is_found ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace algebra3d
