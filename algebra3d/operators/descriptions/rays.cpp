// rayHits, thickness, facetThickness.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/measures/ray_hits.h"
#include "algebra3d/values/measures/thickness.h"
#include "algebra3d/values/spatial_relations/box_meshes.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using RayRows =
    Rows<std::optional<double>, std::optional<double>, Point3d, Point3d, std::string, std::optional<std::int64_t>>;

std::optional<double> if_finite(double number) {
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::int64_t row_number(FaceId face) {
  return std::int64_t{face.index()};
}

Maybe<RayRows> ray_rows(const std::vector<RayHit>& hits, bool has_triangles) {
  std::vector<RayRows::Cells> rows;
  rows.reserve(hits.size());
  for (const RayHit& hit : hits)
    rows.emplace_back(if_finite(hit.first.nearest_double()), if_finite(hit.last.nearest_double()),
                      Point3d{hit.first_point}, Point3d{hit.last_point}, std::string(name_of(hit.kind)),
                      has_triangles ? std::optional(row_number(hit.face)) : std::nullopt);
  return RayRows(std::move(rows));
}

const Undefined kNoDirection{"the direction is the zero vector"};

template <typename T>
Maybe<RayRows> hits_of(const T& set, const Point3d& from, const Vector3d& direction) {
  const RationalVec3 components = direction.components.rational();
  if (is_zero(components)) return kNoDirection;
  return ray_rows(ray_hits(set, from.position.rational(), components), true);
}

Maybe<RayRows> hits_of_box(const Box3& box, const Point3d& from, const Vector3d& direction) {
  const RationalVec3 components = direction.components.rational();
  if (is_zero(components)) return kNoDirection;
  const RationalVec3 origin = from.position.rational();
  if (dimension_of(box) == 3) return ray_rows(ray_hits(solid_of_box(box), origin, components), false);
  if (dimension_of(box) == 2) return ray_rows(ray_hits(surface_of_box(box), origin, components), false);
  return Undefined{"the box is a point or a segment"};
}

Result<Maybe<double>> thickness_of(Context& context, const Volume3d& solid) {
  A3D_ASSIGN(const std::vector<FacetThickness> all, facet_thicknesses(solid, context.monitor()));
  if (all.empty()) return Maybe<double>(Undefined{"the empty solid has no thickness"});
  const auto least = std::ranges::min_element(all, {}, &FacetThickness::thickness);
  return Maybe<double>(least->thickness);
}

using ThicknessRows = Rows<std::int64_t, Point3d, std::optional<double>, std::int64_t>;

Result<ThicknessRows> thickness_rows(Context& context, const Volume3d& solid) {
  A3D_ASSIGN(const std::vector<FacetThickness> all, facet_thicknesses(solid, context.monitor()));
  std::vector<ThicknessRows::Cells> rows;
  rows.reserve(all.size());
  for (const FacetThickness& facet : all)
    rows.emplace_back(row_number(facet.face), Point3d{centroid_of(solid.mesh().corners(facet.face))},
                      if_finite(facet.thickness), row_number(facet.opposite));
  return ThicknessRows(std::move(rows));
}

const std::string kUpwards = "(makeVector3D 0 0 1)";
const std::string kBelow = "(makePoint3D 0.5 0.25 -2)";

constexpr const char* kMeaningOfThickness =
    "The thickness behind a triangle is the length of the ray from its centroid, at right angles inwards, to the "
    "boundary. So it depends on the triangles; small ones give a fine picture.";

void register_ray_hits(OperatorGroup& group) {
  group.add({
      .name = "rayHits",
      .syntax = "rayHits(_, _, _)",
      .doc =
          "Where a ray meets a surface or the boundary of a solid or box, a row for each hit in ascending order (From: "
          "real, To: real, First: point3d, Last: point3d, Kind: string, Triangle: int).",
      .detail =
          "The ray begins at the point, with the parameter 0, and has the point plus the vector at the parameter 1. A "
          "hit is a point, or a run along faces or edges: From and To are the parameters of its ends, rounded once, "
          "First and Last the exact ends. A hit in an edge or a vertex is one hit. Kind, for a solid: entering, "
          "leaving, or touching if "
          "the ray stays on the same side; a ray that begins on the boundary enters or leaves by how it goes on. For a "
          "surface: entering through the front of all triangles there, leaving through their backs, or else touching. "
          "Triangle is the lowest number of those that hold the first point, as by faces, from 0; undefined for boxes. "
          "Undefined "
          "for "
          "the zero vector, and for boxes that are segments or points.",
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::none,
      .overloads = {table<&hits_of<Volume3d>>({"From", "To", "First", "Last", "Kind", "Triangle"}, "solid", "from",
                                              "direction"),
                    table<&hits_of<Surface3d>>({"From", "To", "First", "Last", "Kind", "Triangle"}, "surface", "from",
                                               "direction"),
                    table<&hits_of_box>({"From", "To", "First", "Last", "Kind", "Triangle"}, "box", "from",
                                        "direction")},
      .examples = {{{"(rectangle3 0 1 0 1 0 1)", kBelow, kUpwards},
                    R"(((2.0 2.0 (0.5 0.25 0.0) (0.5 0.25 0.0) "entering" undefined) )"
                    R"((3.0 3.0 (0.5 0.25 1.0) (0.5 0.25 1.0) "leaving" undefined)))"},
                   {{"(rectangle3 0 1 0 1 0 1)", "(makePoint3D -1 0 0.5)", "(makeVector3D 0.5 0 0)"},
                    R"(((2.0 4.0 (0.0 0.0 0.5) (1.0 0.0 0.5) "touching" undefined)))"},
                   {{"(surface3d (((0 0 0) (3 0 0) (0 3 0))))", kBelow, kUpwards},
                    R"(((2.0 2.0 (0.5 0.25 0.0) (0.5 0.25 0.0) "leaving" 0)))"},
                   {{kUnitCube, kBelow, kUpwards}, "2", "(count _)"},
                   {{kUnitCube, kBelow, "(makeVector3D 0 0 0)"}, "()"},
                   {{kUndefinedSolid, kBelow, kUpwards}, "()"}},
      .errors = {{{kUnitCube, kBelow}, "rayHits: expected (volume3d point3d vector3d)"}},
  });
}

void register_thickness(OperatorGroup& group) {
  group.add({
      .name = "thickness",
      .syntax = "thickness(_)",
      .doc = "The smallest thickness of a solid behind any of its triangles, in coordinate units.",
      .detail = std::string(kMeaningOfThickness) + " Undefined for the empty solid.",
      .exactness = Exactness::rounded_once,
      .cost = Cost::sorting,
      .sources = {"inui2016"},
      .overloads = {overload<&thickness_of>("solid")},
      .examples = {{{kCubeOfTwo}, "2.0"},
                   {{"(createCube (makePoint3D 0 0 0) (makePoint3D 3 4 0.25))"}, "0.25"},
                   {{"(volume3d ())"}, "undefined"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"1"}, "thickness: expected (volume3d), got (int)"}},
  });
  group.add({
      .name = "facetThickness",
      .syntax = "facetThickness(_)",
      .doc = "The thickness of a solid behind each of its triangles, a row for each (Triangle: int, Point: point3d, "
             "Thickness: real, Opposite: int).",
      .detail =
          std::string(kMeaningOfThickness) +
          " Triangle is its number as by faces, from 0, Point its centroid, Opposite the triangle that the ray meets.",
      .exactness = Exactness::rounded_once,
      .cost = Cost::sorting,
      .sources = {"inui2016"},
      .overloads = {table<&thickness_rows>({"Triangle", "Point", "Thickness", "Opposite"}, "solid")},
      .examples = {{{kCubeOfTwo}, "12", "(count _)"}, {{"(volume3d ())"}, "()"}, {{kUndefinedSolid}, "()"}},
      .errors = {{{"1"}, "facetThickness: expected (volume3d), got (int)"}},
  });
}

}  // namespace

void register_rays(OperatorGroup& group) {
  register_ray_hits(group);
  register_thickness(group);
}

}  // namespace algebra3d
