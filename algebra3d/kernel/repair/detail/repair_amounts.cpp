#include "algebra3d/kernel/repair/detail/repair_amounts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/detail/inside_test.h"
#include "algebra3d/kernel/repair/detail/measure_frame.h"
#include "algebra3d/kernel/repair/detail/surface_distance.h"
#include "algebra3d/kernel/repair/detail/unmatched_parts.h"
#include "base/propagate.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// Triangles of the mesh whose boxes are no farther than the reach from those of the parts.
std::vector<Triangle3> triangles_near(const MeasureFrame& frame, const TriangleMesh& mesh,
                                      std::span<const SurfacePart> parts, double reach) {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const SurfacePart& part : parts) {
    Box3 box;
    for (const Vec3& corner : part.polygon.corners) box.extend(corner);
    box.min = box.min - Vec3{reach, reach, reach};
    box.max = box.max + Vec3{reach, reach, reach};
    entries.push_back({box, 0});
  }
  const auto places = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::vector<Triangle3> result;
  for (const FaceId face : faces(mesh)) {
    const Triangle3 corners = frame.scale().scaled(mesh, face);
    if (places.window(box_of(corners)).next()) result.push_back(corners);
  }
  return result;
}

/// The parts that are not proved to be within the tolerance of the mesh (SurfaceDistance::is_near). Errors:
/// interrupted. Cost: linear in the mesh, and a few searches per part.
Result<std::vector<SurfacePart>> far_parts(MeasureFrame& frame, const TriangleMesh& mesh,
                                           const std::vector<SurfacePart>& parts) {
  std::vector<SurfacePart> far;
  if (parts.empty()) return far;
  const SurfaceDistance surface(triangles_near(frame, mesh, parts, 2 * frame.tolerance()));
  const auto is_near = [&](const Triangle3& triangle) {
    return !surface.is_empty() && surface.is_near(triangle, frame.tolerance());
  };
  for (const SurfacePart& part : parts) {
    A3D_TRY(frame.pause());
    if (!std::ranges::all_of(part.polygon.triangles(), is_near)) far.push_back(part);
  }
  return far;
}

/// One flag per part: whether its middle is inside the solid. Errors: interrupted.
Result<std::vector<bool>> are_inside(const MeasureFrame& frame, const TriangleMesh& solid,
                                     const std::vector<SurfacePart>& parts) {
  std::vector<Vec3> middles;
  middles.reserve(parts.size());
  for (const SurfacePart& part : parts) middles.push_back(frame.scale().unscaled(part.polygon.middle()));
  return InsideTest(solid).are_inside(middles, frame.monitor());
}

/// Sets `distance`, an upper bound of how far any point of the parts is from the mesh, and `where`, their farthest
/// point; both in coordinate units, while the parts are scaled.
void measure_distance(const MeasureFrame& frame, const TriangleMesh& mesh, const std::vector<SurfacePart>& parts,
                      SurfaceAmount& amount) {
  std::vector<Triangle3> triangles;
  double reach = frame.tolerance();
  for (const SurfacePart& part : parts)
    for (const Triangle3& triangle : part.polygon.triangles()) {
      triangles.push_back(triangle);
      const Box3 box = box_of(triangle);
      reach = std::max(reach, length(box.max - box.min));
    }
  if (triangles.empty()) return;
  // Near triangles of the mesh give most distances; all of them are asked if something is farther away.
  const auto farthest_from = [&](double distance) {
    return SurfaceDistance(triangles_near(frame, mesh, parts, distance)).farthest(triangles);
  };
  FarthestBounds farthest = farthest_from(reach);
  if (!(farthest.at_most <= reach)) farthest = farthest_from(std::numeric_limits<double>::infinity());
  amount.distance = frame.scale().unscaled(farthest.at_most);
  amount.where = frame.scale().unscaled(farthest.where);
}

using UnmatchedFlags = IdVector<UnmatchedId, bool>;

/// Adds to flagged triangles those that lie upon them.
UnmatchedFlags with_doubles(UnmatchedFlags are_counted, const GivenParts& given) {
  for (const auto& [triangle, earlier] : given.lies_upon)
    if (are_counted[earlier]) are_counted[triangle] = true;
  return are_counted;
}

/// How many triangles as given are flagged, or lie upon flagged ones.
std::uint64_t count_with_doubles(const UnmatchedFlags& are_counted, const GivenParts& given,
                                 const UnmatchedTriangles& all) {
  const UnmatchedFlags flags = with_doubles(are_counted, given);
  std::uint64_t count = 0;
  for (const UnmatchedId i : flags.ids())
    if (flags[i]) count += all.copies[i];
  return count;
}

class RepairMeasure {
 public:
  RepairMeasure(const TriangleMesh& given, const TriangleMesh& solid, double moved, const Monitor& monitor)
      : frame_(given, solid, moved, monitor) {}

  Result<MeasuredRepair> run(const FaceMatches& recognised, std::span<const HoleCover> covers);

 private:
  Status measure_left_out(const TriangleMatching& matching, const GivenParts& given);
  Result<std::vector<UnmatchedId>> measure_added(const TriangleMatching& matching);
  std::vector<bool> find_added(const TriangleMatching& matching, const std::vector<UnmatchedId>& added,
                               std::span<const HoleCover> covers) const;

  MeasureFrame frame_;
  RepairAmounts amounts_;
};

/// Measures parts that are outside the solid as left out, and others as inside.
Status RepairMeasure::measure_left_out(const TriangleMatching& matching, const GivenParts& given) {
  A3D_ASSIGN(const std::vector<SurfacePart> far, far_parts(frame_, frame_.solid(), given.parts));
  if (far.empty()) return {};
  A3D_ASSIGN(const std::vector<bool> is_inside, are_inside(frame_, frame_.solid(), far));
  UnmatchedFlags are_outside(matching.given.triangles.size()), have_inside(matching.given.triangles.size());
  double area_outside = 0, area_inside = 0;
  std::vector<SurfacePart> outside;
  for (std::size_t i = 0; i < far.size(); ++i) {
    const SurfacePart& part = far[i];
    if (is_inside[i] && area_inside == 0) amounts_.inside.where = frame_.scale().unscaled(part.polygon.middle());
    (is_inside[i] ? area_inside : area_outside) += part.polygon.area();
    (is_inside[i] ? have_inside : are_outside)[part.triangle] = true;
    if (!is_inside[i]) outside.push_back(part);
  }
  amounts_.left_out.area = frame_.scale().area(area_outside);
  amounts_.inside.area = frame_.scale().area(area_inside);
  amounts_.left_out.triangle_count = count_with_doubles(are_outside, given, matching.given);
  amounts_.inside.triangle_count = count_with_doubles(have_inside, given, matching.given);
  measure_distance(frame_, frame_.solid(), outside, amounts_.left_out);
  return {};
}

/// Measures parts of the solid's boundary where there was no triangle; gives the faces that they are of.
Result<std::vector<UnmatchedId>> RepairMeasure::measure_added(const TriangleMatching& matching) {
  A3D_ASSIGN(const std::vector<SurfacePart> parts, parts_of_solid(frame_, matching));
  A3D_ASSIGN(const std::vector<SurfacePart> far, far_parts(frame_, frame_.given(), parts));
  double area = 0;
  std::vector<UnmatchedId> added;
  for (const SurfacePart& part : far) {
    area += part.polygon.area();
    if (added.empty() || added.back() != part.triangle) added.push_back(part.triangle);
  }
  amounts_.added.area = frame_.scale().area(area);
  amounts_.added.triangle_count = added.size();
  measure_distance(frame_, frame_.given(), far, amounts_.added);
  return added;
}

/// A cover is there if one of six points of one of its triangles lies upon a face that was added.
std::vector<bool> RepairMeasure::find_added(const TriangleMatching& matching, const std::vector<UnmatchedId>& added,
                                            std::span<const HoleCover> covers) const {
  std::vector<Triangle3> faces;
  faces.reserve(added.size());
  for (const UnmatchedId face : added) faces.push_back(matching.solid.triangles[face].corners);
  const SurfaceDistance surface(std::move(faces));
  const BinaryScale& scale = frame_.scale();
  const auto is_added = [&](const std::array<Vec3, 3>& triangle) {
    if (surface.is_empty()) return false;
    for (const double share : {1.0 / 3, 0.8})
      for (std::size_t i = 0; i < 3; ++i) {
        const double rest = (1 - share) / 2;
        const Vec3 point = share * scale.scaled(triangle[i]) + rest * scale.scaled(triangle[(i + 1) % 3]) +
                           rest * scale.scaled(triangle[(i + 2) % 3]);
        if (surface.to(point) <= frame_.tolerance()) return true;
      }
    return false;
  };
  std::vector<bool> result;
  for (const HoleCover& cover : covers) result.push_back(std::ranges::any_of(cover.triangles, is_added));
  return result;
}

Result<MeasuredRepair> RepairMeasure::run(const FaceMatches& recognised, std::span<const HoleCover> covers) {
  const TriangleMatching matching = match_triangles(frame_, recognised);
  A3D_ASSIGN(const GivenParts given, parts_of_given(frame_, matching));
  A3D_TRY(measure_left_out(matching, given));
  A3D_ASSIGN(const std::vector<UnmatchedId> added, measure_added(matching));
  amounts_.area_seen = frame_.scale().area(given.area_seen);
  amounts_.tolerance = frame_.scale().unscaled(frame_.tolerance());
  return MeasuredRepair{amounts_, find_added(matching, added, covers)};
}

/// The unmatched triangle with the corners of a face; none if the face is matched, or degenerate.
UnmatchedId find_unmatched(const MeasureFrame& frame, const UnmatchedTriangles& unmatched, FaceId face) {
  const Triangle3 key = key_of(frame.of_given(face));
  const auto corners_of = [](const MeasuredTriangle& triangle) { return triangle.corners; };
  const auto place = std::ranges::lower_bound(unmatched.triangles, key, {}, corners_of);
  const bool is_there = place != unmatched.triangles.end() && place->corners == key;
  return is_there ? UnmatchedId(place - unmatched.triangles.begin()) : UnmatchedId::none();
}

}  // namespace

Result<MeasuredRepair> measure_repair(const TriangleMesh& given, const TriangleMesh& solid,
                                      const FaceMatches& recognised, double moved, std::span<const HoleCover> covers,
                                      const Monitor& monitor) {
  return RepairMeasure(given, solid, moved, monitor).run(recognised, covers);
}

Result<TriangleClasses> classify_triangles(const TriangleMesh& given, const TriangleMesh& solid, double moved,
                                           const Monitor& monitor) {
  MeasureFrame frame(given, solid, moved, monitor);
  const TriangleMatching matching = match_triangles(frame, {});
  A3D_ASSIGN(const GivenParts left, parts_of_given(frame, matching));
  A3D_ASSIGN(const std::vector<SurfacePart> far, far_parts(frame, solid, left.parts));
  UnmatchedFlags are_outside(matching.given.triangles.size());
  A3D_ASSIGN(const std::vector<bool> is_inside, are_inside(frame, solid, far));
  for (std::size_t i = 0; i < far.size(); ++i)
    if (!is_inside[i]) are_outside[far[i].triangle] = true;
  are_outside = with_doubles(std::move(are_outside), left);
  const UnmatchedFlags are_divided = with_doubles(left.are_covered, left);
  TriangleClasses result;
  for (const FaceId face : faces(given)) {
    const UnmatchedId i = find_unmatched(frame, matching.given, face);
    result.are_divided.push_back(!i.is_none() && are_divided[i]);
    result.are_outside.push_back(!i.is_none() && are_outside[i]);
  }
  return result;
}

}  // namespace algebra3d
