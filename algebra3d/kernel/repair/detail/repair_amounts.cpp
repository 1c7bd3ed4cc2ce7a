#include "algebra3d/kernel/repair/detail/repair_amounts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/inside_test.h"
#include "algebra3d/kernel/repair/detail/measure_frame.h"
#include "algebra3d/kernel/repair/detail/part_distance.h"
#include "algebra3d/kernel/repair/detail/surface_distance.h"
#include "algebra3d/kernel/repair/detail/unmatched_parts.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

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
  const InsideTest test(frame_.solid());
  UnmatchedFlags are_outside(matching.given.triangles.size()), are_inside(matching.given.triangles.size());
  double area_outside = 0, area_inside = 0;
  std::vector<SurfacePart> outside;
  for (const SurfacePart& part : far) {
    A3D_TRY(frame_.pause());
    const Vec3 middle = frame_.scale().unscaled(part.polygon.middle());
    const bool is_inside = test.is_inside(middle);
    if (is_inside && area_inside == 0) amounts_.inside.where = middle;
    (is_inside ? area_inside : area_outside) += part.polygon.area();
    (is_inside ? are_inside : are_outside)[part.triangle] = true;
    if (!is_inside) outside.push_back(part);
  }
  amounts_.left_out.area = frame_.scale().area(area_outside);
  amounts_.inside.area = frame_.scale().area(area_inside);
  amounts_.left_out.triangle_count = count_with_doubles(are_outside, given, matching.given);
  amounts_.inside.triangle_count = count_with_doubles(are_inside, given, matching.given);
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
  const InsideTest test(solid);
  for (const SurfacePart& part : far) {
    A3D_TRY(frame.pause());
    if (are_outside[part.triangle]) continue;
    are_outside[part.triangle] = !test.is_inside(frame.scale().unscaled(part.polygon.middle()));
  }
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
