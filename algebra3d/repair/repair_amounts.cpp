#include "algebra3d/repair/repair_amounts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algebra3d/exact/vertical_line.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/repair/facet_overlap.h"
#include "algebra3d/repair/known_facets.h"
#include "algebra3d/repair/scaled_triangles.h"
#include "algebra3d/repair/surface_distance.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

using NumberTree = rtree::RTree<std::uint32_t>;

/// Facets that the other surface does not have, and what is asked about them.
struct LoneFacets {
  std::vector<MeasuredFacet> facets;
  std::vector<std::uint64_t> copies;  // of each: how many facets have its corners
  NumberTree tree;

  void add(const Triangle3& corners, std::uint64_t count) {
    facets.emplace_back(corners);
    copies.push_back(count);
  }
  void index(double tolerance) {
    std::vector<rtree::Entry<std::uint32_t>> entries;
    for (std::uint32_t i = 0; i < facets.size(); ++i) entries.push_back({box(i, tolerance), i});
    tree = NumberTree::bulk_load(entries);
  }
  Box3 box(std::uint32_t i, double wider) const {
    Box3 result = box_of(facets[i].corners);
    result.min = result.min - Vec3{wider, wider, wider};
    result.max = result.max + Vec3{wider, wider, wider};
    return result;
  }
  std::vector<std::uint32_t> near(std::uint32_t i, const NumberTree& others, double wider) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t other : others.window(box(i, wider))) result.push_back(other);
    std::ranges::sort(result);
    return result;
  }
};

/// The rest of one facet.
struct LeftPart {
  std::uint32_t facet;
  ConvexPolygon polygon;
};

/// The same three corners in the same order, whichever way the facet looks.
Triangle3 key_of(Triangle3 corners) {
  std::ranges::sort(corners);
  return corners;
}

/// Whether points are inside a solid.
class InsideTest {
 public:
  explicit InsideTest(const TriangleMesh& solid) : solid_(solid), hierarchy_(solid, all_faces(solid)) {}

  bool holds(const Vec3& point) const {
    if (!hierarchy_.bounds().contains(point)) return false;
    int winding = 0;
    hierarchy_.for_each_on_vertical_ray(Box3::of(point), 1, [&](std::uint32_t face) {
      const LineCrossing crossing = cross_vertical_line(point, solid_.corners(FaceId(face)));
      if (crossing.side == -1) winding += crossing.sign;
    });
    return winding > 0;
  }

 private:
  static std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> faces(mesh.face_count());
    for (std::uint32_t f = 0; f < faces.size(); ++f) faces[f] = f;
    return faces;
  }

  const TriangleMesh& solid_;
  BoxHierarchy hierarchy_;
};

class RepairMeasure {
 public:
  RepairMeasure(const TriangleMesh& given, const TriangleMesh& solid, double moved, const Monitor& monitor)
      : given_(given), solid_(solid), monitor_(monitor) {
    const double largest = std::max(largest_coordinate(given), largest_coordinate(solid));
    scale_ = BinaryScale(largest);
    Box3 box;
    for (const Vec3& p : given.points().approx()) box.extend(scale_.scaled(p));
    constexpr double kNoisePerDiagonal = 1e-6, kFloats = 4 * 0x1p-23;
    const double size = box.is_empty() ? 0 : length(box.max - box.min);
    tolerance_ = std::max({scale_.scaled(moved), kNoisePerDiagonal * size, kFloats * scale_.scaled(largest)});
  }

  Result<MeasuredRepair> run(const std::vector<std::uint32_t>& recognised, std::span<const HoleCover> covers);
  Result<FacetFates> fates();

 private:
  void match(const std::vector<std::uint32_t>& recognised);
  void index_near_faces();
  ConvexPolygon whole(const MeasuredFacet& facet) const { return {{facet.corners.begin(), facet.corners.end()}}; }
  Result<std::vector<LeftPart>> parts_of_given();
  Status sort_parts_of_given(const std::vector<LeftPart>& parts);
  std::vector<bool> with_doubles(std::vector<bool> are_counted) const;
  std::uint64_t count_with_doubles(std::vector<bool> are_counted) const;
  Result<std::vector<LeftPart>> parts_of_solid();
  Status sort_parts_of_solid(const std::vector<LeftPart>& parts);
  std::vector<bool> find_added(std::span<const HoleCover> covers) const;
  std::vector<Triangle3> triangles_near(const TriangleMesh& mesh, std::span<const LeftPart> parts, double reach) const;
  Result<std::vector<LeftPart>> far_parts(const TriangleMesh& mesh, const std::vector<LeftPart>& parts);
  void measure_distance(const TriangleMesh& mesh, const std::vector<LeftPart>& parts, SurfaceAmount& amount) const;
  /// Ends every few steps with an error if that was asked for.
  Status pause() { return ++steps_ % 256 == 0 ? monitor_.check() : Status(); }
  bool counts(const ConvexPolygon& part) const { return part.area() > tolerance_ * tolerance_; }

  const TriangleMesh& given_;
  const TriangleMesh& solid_;
  const Monitor& monitor_;
  BinaryScale scale_;
  double tolerance_;  // scaled, as all that follows
  double seen_ = 0;
  LoneFacets lone_given_, lone_solid_;
  std::vector<MeasuredFacet> near_faces_;  // of the solid, near lone facets of the file
  std::vector<bool> near_is_lone_;         // of each
  NumberTree near_tree_;
  std::vector<bool> are_covered_;  // lone facets of the file, by faces that only the solid has
  std::vector<std::pair<std::uint32_t, std::uint32_t>> upon_;  // lone facets that lie upon earlier ones
  std::vector<std::uint32_t> added_faces_;                     // numbers in lone_solid_
  RepairAmounts amounts_;
  std::uint64_t steps_ = 0;
};

/// Finds the facets that the two surfaces have in common, and takes their area down as seen.
void RepairMeasure::match(const std::vector<std::uint32_t>& recognised) {
  std::vector<bool> is_known(given_.face_count());
  for (const std::uint32_t face : recognised)
    if (face != KnownFacets::kNone) is_known[face] = true;
  std::vector<Triangle3> keys;
  for (std::uint32_t f = 0; f < given_.face_count(); ++f) {
    const Triangle3 corners = scale_.scaled(given_, f);
    if (is_known[f]) seen_ += area_of(corners);
    if (!is_known[f] && area_of(corners) > 0) keys.push_back(key_of(corners));
  }
  std::ranges::sort(keys);
  std::vector<bool> is_common(keys.size());  // of the first of equal ones
  for (std::uint32_t f = 0; f < solid_.face_count(); ++f) {
    if (f < recognised.size() && recognised[f] != KnownFacets::kNone) continue;
    const Triangle3 corners = scale_.scaled(solid_, f);
    const auto place = std::ranges::lower_bound(keys, key_of(corners));
    if (place != keys.end() && *place == key_of(corners))
      is_common[static_cast<std::size_t>(place - keys.begin())] = true;
    else if (area_of(corners) > 0)
      lone_solid_.add(corners, 1);
  }
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    while (last < keys.size() && keys[last] == keys[first]) ++last;
    if (is_common[first])
      seen_ += area_of(keys[first]);
    else
      lone_given_.add(keys[first], last - first);
  }
  lone_given_.index(tolerance_);
  lone_solid_.index(tolerance_);
}

/// Faces of the solid that may meet lone facets of the file.
void RepairMeasure::index_near_faces() {
  if (lone_given_.facets.empty()) return;
  std::vector<Triangle3> lone;
  for (const MeasuredFacet& facet : lone_solid_.facets) lone.push_back(key_of(facet.corners));
  std::ranges::sort(lone);
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t f = 0; f < solid_.face_count(); ++f) {
    const Triangle3 corners = scale_.scaled(solid_, f);
    if (!lone_given_.tree.window(box_of(corners)).next()) continue;
    entries.push_back({box_of(corners), static_cast<std::uint32_t>(near_faces_.size())});
    near_faces_.emplace_back(corners);
    near_is_lone_.push_back(std::ranges::binary_search(lone, key_of(corners)));
  }
  near_tree_ = NumberTree::bulk_load(entries);
}

double area_of_parts(const std::vector<ConvexPolygon>& parts) {
  double sum = 0;
  for (const ConvexPolygon& part : parts) sum += part.area();
  return sum;
}

/// The parts that do not lie upon the solid, divided where the solid crosses them.
Result<std::vector<LeftPart>> RepairMeasure::parts_of_given() {
  constexpr std::size_t kMostParts = 2000;
  std::vector<LeftPart> result;
  are_covered_.assign(lone_given_.facets.size(), false);
  for (std::uint32_t i = 0; i < lone_given_.facets.size(); ++i) {
    RETURN_IF_ERROR(pause());
    const MeasuredFacet& facet = lone_given_.facets[i];
    std::vector<ConvexPolygon> parts{whole(facet)};
    for (const std::uint32_t other : lone_given_.near(i, lone_given_.tree, 0)) {
      if (other >= i || parts.empty() || parts.size() > kMostParts) break;
      if (!are_coplanar(facet, lone_given_.facets[other], tolerance_)) continue;
      const double before = area_of_parts(parts);
      subtract(parts, facet, lone_given_.facets[other], tolerance_);
      if (area_of_parts(parts) < before - tolerance_ * tolerance_) upon_.emplace_back(i, other);
    }
    seen_ += area_of_parts(parts);
    if (parts.empty()) continue;
    std::vector<std::uint32_t> crossing;
    for (const std::uint32_t face : lone_given_.near(i, near_tree_, tolerance_)) {
      RETURN_IF_ERROR(pause());
      if (!are_coplanar(facet, near_faces_[face], tolerance_)) {
        crossing.push_back(face);
        continue;
      }
      const double before = area_of_parts(parts);
      subtract(parts, facet, near_faces_[face], tolerance_);
      const double covered = before - area_of_parts(parts);
      // A facet that the two have in common has been seen before.
      if (!near_is_lone_[face])
        seen_ -= covered;
      else if (covered > tolerance_ * tolerance_)
        are_covered_[i] = true;
    }
    for (const std::uint32_t face : crossing) {
      if (parts.empty()) break;
      RETURN_IF_ERROR(pause());
      divide_at(parts, facet, near_faces_[face], tolerance_, kMostParts);
    }
    for (ConvexPolygon& part : parts)
      if (counts(part)) result.push_back({i, std::move(part)});
  }
  return result;
}

/// Triangles of the mesh that are no farther than the reach from the parts.
std::vector<Triangle3> RepairMeasure::triangles_near(const TriangleMesh& mesh, std::span<const LeftPart> parts,
                                                     double reach) const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const LeftPart& part : parts) {
    Box3 box;
    for (const Vec3& corner : part.polygon.corners) box.extend(corner);
    box.min = box.min - Vec3{reach, reach, reach};
    box.max = box.max + Vec3{reach, reach, reach};
    entries.push_back({box, 0});
  }
  const NumberTree places = NumberTree::bulk_load(entries);
  std::vector<Triangle3> result;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle3 corners = scale_.scaled(mesh, f);
    if (places.window(box_of(corners)).next()) result.push_back(corners);
  }
  return result;
}

/// The facets that are somewhere farther from the mesh than the tolerance.
Result<std::vector<LeftPart>> RepairMeasure::far_parts(const TriangleMesh& mesh, const std::vector<LeftPart>& parts) {
  std::vector<LeftPart> far;
  if (parts.empty()) return far;
  const SurfaceDistance surface(triangles_near(mesh, parts, 2 * tolerance_));
  for (const LeftPart& part : parts) {
    RETURN_IF_ERROR(pause());
    const auto is_near = [&](const Triangle3& triangle) {
      return !surface.is_empty() && surface.is_near(triangle, tolerance_);
    };
    if (!std::ranges::all_of(part.polygon.triangles(), is_near)) far.push_back(part);
  }
  return far;
}

/// Near triangles of the mesh tell most distances; all of them are asked if something is farther away.
void RepairMeasure::measure_distance(const TriangleMesh& mesh, const std::vector<LeftPart>& parts,
                                     SurfaceAmount& amount) const {
  std::vector<Triangle3> triangles;
  double reach = tolerance_;
  for (const LeftPart& part : parts)
    for (const Triangle3& triangle : part.polygon.triangles()) {
      triangles.push_back(triangle);
      const Box3 box = box_of(triangle);
      reach = std::max(reach, length(box.max - box.min));
    }
  if (triangles.empty()) return;
  FarthestPoint farthest = SurfaceDistance(triangles_near(mesh, parts, reach)).farthest(triangles);
  if (!(farthest.at_most <= reach))
    farthest =
        SurfaceDistance(triangles_near(mesh, parts, std::numeric_limits<double>::infinity())).farthest(triangles);
  amount.distance = scale_.length(farthest.at_most);
  amount.where = scale_.point(farthest.where);
}

/// Those lone facets of the file, and others that lie upon them.
std::vector<bool> RepairMeasure::with_doubles(std::vector<bool> are_counted) const {
  for (const auto& [facet, other] : upon_)
    if (are_counted[other]) are_counted[facet] = true;
  return are_counted;
}

/// How many facets of the file those are.
std::uint64_t RepairMeasure::count_with_doubles(std::vector<bool> are_counted) const {
  are_counted = with_doubles(std::move(are_counted));
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < are_counted.size(); ++i)
    if (are_counted[i]) count += lone_given_.copies[i];
  return count;
}

Status RepairMeasure::sort_parts_of_given(const std::vector<LeftPart>& parts) {
  ASSIGN_OR_RETURN(const std::vector<LeftPart> far, far_parts(solid_, parts));
  if (far.empty()) return {};
  const InsideTest test(solid_);
  std::vector<LeftPart> outside;
  std::array<std::vector<bool>, 2> are_there;  // lone facets: outside, inside
  are_there.fill(std::vector<bool>(lone_given_.facets.size()));
  std::array<double, 2> areas{};
  for (const LeftPart& part : far) {
    RETURN_IF_ERROR(pause());
    const Vec3 middle = scale_.point(part.polygon.middle());
    const bool is_inside = test.holds(middle);
    SurfaceAmount& amount = is_inside ? amounts_.inside : amounts_.dropped;
    if (is_inside && areas[1] == 0) amount.where = middle;
    areas[is_inside ? 1 : 0] += part.polygon.area();
    are_there[is_inside ? 1 : 0][part.facet] = true;
    if (!is_inside) outside.push_back(part);
  }
  amounts_.dropped.area = scale_.area(areas[0]);
  amounts_.inside.area = scale_.area(areas[1]);
  amounts_.dropped.facet_count = count_with_doubles(std::move(are_there[0]));
  amounts_.inside.facet_count = count_with_doubles(std::move(are_there[1]));
  measure_distance(solid_, outside, amounts_.dropped);
  return {};
}

/// The parts that do not lie upon facets of the file.
Result<std::vector<LeftPart>> RepairMeasure::parts_of_solid() {
  std::vector<LeftPart> result;
  for (std::uint32_t i = 0; i < lone_solid_.facets.size(); ++i) {
    RETURN_IF_ERROR(pause());
    const MeasuredFacet& facet = lone_solid_.facets[i];
    std::vector<ConvexPolygon> parts{whole(facet)};
    for (const std::uint32_t other : lone_solid_.near(i, lone_given_.tree, 0)) {
      if (parts.empty()) break;
      if (are_coplanar(facet, lone_given_.facets[other], tolerance_))
        subtract(parts, facet, lone_given_.facets[other], tolerance_);
    }
    for (ConvexPolygon& part : parts)
      if (counts(part)) result.push_back({i, std::move(part)});
  }
  return result;
}

Status RepairMeasure::sort_parts_of_solid(const std::vector<LeftPart>& parts) {
  ASSIGN_OR_RETURN(const std::vector<LeftPart> far, far_parts(given_, parts));
  double area = 0;
  for (const LeftPart& part : far) {
    area += part.polygon.area();
    if (added_faces_.empty() || added_faces_.back() != part.facet) added_faces_.push_back(part.facet);
  }
  amounts_.added.area = scale_.area(area);
  amounts_.added.facet_count = added_faces_.size();
  measure_distance(given_, far, amounts_.added);
  return {};
}

/// A cover is there if one of some points of its triangles lies upon a face that was added.
std::vector<bool> RepairMeasure::find_added(std::span<const HoleCover> covers) const {
  std::vector<Triangle3> added;
  for (const std::uint32_t face : added_faces_) added.push_back(lone_solid_.facets[face].corners);
  const SurfaceDistance surface(std::move(added));
  const auto is_added = [&](const std::array<Vec3, 3>& triangle) {
    if (surface.is_empty()) return false;
    for (const double share : {1.0 / 3, 0.8})
      for (std::size_t i = 0; i < 3; ++i) {
        const double rest = (1 - share) / 2;
        const Vec3 point = share * scale_.scaled(triangle[i]) + rest * scale_.scaled(triangle[(i + 1) % 3]) +
                           rest * scale_.scaled(triangle[(i + 2) % 3]);
        if (surface.to(point) <= tolerance_) return true;
      }
    return false;
  };
  std::vector<bool> result;
  for (const HoleCover& cover : covers) result.push_back(std::ranges::any_of(cover.triangles, is_added));
  return result;
}

Result<MeasuredRepair> RepairMeasure::run(const std::vector<std::uint32_t>& recognised,
                                          std::span<const HoleCover> covers) {
  match(recognised);
  index_near_faces();
  ASSIGN_OR_RETURN(const std::vector<LeftPart> left, parts_of_given());
  RETURN_IF_ERROR(sort_parts_of_given(left));
  ASSIGN_OR_RETURN(const std::vector<LeftPart> made, parts_of_solid());
  RETURN_IF_ERROR(sort_parts_of_solid(made));
  amounts_.area_seen = scale_.area(seen_);
  amounts_.tolerance = scale_.length(tolerance_);
  return MeasuredRepair{amounts_, find_added(covers)};
}

Result<FacetFates> RepairMeasure::fates() {
  match({});
  index_near_faces();
  ASSIGN_OR_RETURN(const std::vector<LeftPart> left, parts_of_given());
  ASSIGN_OR_RETURN(const std::vector<LeftPart> far, far_parts(solid_, left));
  std::vector<bool> are_outside(lone_given_.facets.size());
  const InsideTest test(solid_);
  for (const LeftPart& part : far) {
    RETURN_IF_ERROR(pause());
    if (!are_outside[part.facet] && !test.holds(scale_.point(part.polygon.middle()))) are_outside[part.facet] = true;
  }
  are_outside = with_doubles(std::move(are_outside));
  const std::vector<bool> are_divided = with_doubles(are_covered_);
  FacetFates result;
  const auto corners_of = [](const MeasuredFacet& facet) { return facet.corners; };
  for (std::uint32_t f = 0; f < given_.face_count(); ++f) {
    const Triangle3 key = key_of(scale_.scaled(given_, f));
    const auto place = std::ranges::lower_bound(lone_given_.facets, key, {}, corners_of);
    const bool is_lone = place != lone_given_.facets.end() && place->corners == key;
    const auto i = static_cast<std::size_t>(place - lone_given_.facets.begin());
    result.are_divided.push_back(is_lone && are_divided[i]);
    result.are_outside.push_back(is_lone && are_outside[i]);
  }
  return result;
}

}  // namespace

Result<FacetFates> facet_fates(const TriangleMesh& facets, const TriangleMesh& solid, double moved,
                               const Monitor& monitor) {
  return RepairMeasure(facets, solid, moved, monitor).fates();
}

Result<MeasuredRepair> measure_repair(const TriangleMesh& given, const TriangleMesh& solid,
                                      const std::vector<std::uint32_t>& recognised, double moved,
                                      std::span<const HoleCover> covers, const Monitor& monitor) {
  return RepairMeasure(given, solid, moved, monitor).run(recognised, covers);
}

}  // namespace algebra3d
