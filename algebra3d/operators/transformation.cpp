// rotate, mirror, translate, scale, scaleDir.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/exact/affine_map.h"
#include "algebra3d/halfedge/mesh_triangles.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/sample_values.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/repair/weld.h"
#include "algebra3d/types/moving_region.h"
#include "algebra3d/types/planar.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {
namespace {

constexpr const char* kOutOfRange = "a coordinate of the image is beyond the range of doubles";

Result<Maybe<Point3d>> image_of(Context& /*context*/, const AffineMap& map, const Point3d& point) {
  const Vec3 image = map.apply_rounded(point.position);
  if (!is_finite(image)) return Maybe<Point3d>(Undefined{kOutOfRange});
  return Maybe<Point3d>(Point3d{ExactPoint(image)});
}

Result<Maybe<Points3d>> image_of(Context& context, const AffineMap& map, const Points3d& points) {
  std::vector<ExactPoint> images;
  images.reserve(points.points().size());
  for (const ExactPoint& point : points.points()) {
    if (images.size() % 8192 == 0) RETURN_IF_ERROR(context.check_cancelled());
    const Vec3 image = map.apply_rounded(point);
    if (!is_finite(image)) return Maybe<Points3d>(Undefined{kOutOfRange});
    images.emplace_back(image);
  }
  return Maybe<Points3d>(Points3d(std::move(images)));
}

/// The vertices of an image, each coordinate rounded once.
struct RoundedPoints {
  std::vector<Vec3> points;
  bool are_exact = true;
};

Result<RoundedPoints> round_points(Context& context, const AffineMap& map, const PointArray& points) {
  RoundedPoints result;
  result.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 8192 == 0) RETURN_IF_ERROR(context.check_cancelled());
    result.points.push_back(map.apply_rounded(points[i]));
    result.are_exact =
        result.are_exact && is_finite(result.points.back()) && map.image_is_double(points[i], result.points.back());
  }
  return result;
}

/// The triangles of an image: turned over where the map mirrors, so that the outside stays outside.
std::vector<TriangleMesh::Triangle> image_triangles(const AffineMap& map, const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> triangles = triangles_of(mesh);
  if (map.orientation() < 0)
    for (auto& [a, b, c] : triangles) std::swap(b, c);
  return triangles;
}

std::optional<PointArray> exact_images(const AffineMap& map, const PointArray& points) {
  PointArray images;
  images.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto image = map.apply(points.point(i));
    if (!image) return std::nullopt;
    images.push_back(*image);
  }
  return images;
}

void report_unrounded(Context& context) {
  context.diagnostics.report("rounding the image to doubles would break it; its coordinates are kept as fractions");
}

/// Rounding may have made points equal; welded, such an image can still be valid (bodies may touch in points).
TriangleMesh rounded_mesh(const std::vector<Vec3>& points, const std::vector<TriangleMesh::Triangle>& triangles) {
  WeldedTriangles welded = weld(points, triangles);
  return {std::move(welded.points), welded.triangles};
}

template <typename T>
Result<Maybe<T>> image_of(Context& context, const AffineMap& map, const T& geometry) {
  if (map.orientation() == 0) return Maybe<T>(Undefined{"a zero factor would flatten the shape"});
  const TriangleMesh& mesh = geometry.mesh();
  ASSIGN_OR_RETURN(RoundedPoints rounded, round_points(context, map, mesh.points()));
  if (!std::ranges::all_of(rounded.points, is_finite)) return Maybe<T>(Undefined{kOutOfRange});
  const std::vector<TriangleMesh::Triangle> triangles = image_triangles(map, mesh);
  // An exact affine map that does not flatten keeps all that makes a value valid: common points stay common, distinct
  // ones distinct, and inside stays inside. Only rounding can break it.
  if (rounded.are_exact) return Maybe<T>(T::trusted(TriangleMesh(PointArray(std::move(rounded.points)), triangles)));
  const ProofOptions options{.thoroughness = Thoroughness::first_defect, .cancel = context.cancel};
  ASSIGN_OR_RETURN(auto proved, T::prove(rounded_mesh(rounded.points, triangles), options));
  if (proved) return proved;
  auto exact = exact_images(map, mesh.points());
  if (!exact) return Maybe<T>(Undefined{kOutOfRange});
  report_unrounded(context);
  return Maybe<T>(T::trusted(TriangleMesh(std::move(*exact), triangles)));
}

Result<Maybe<Region>> translated_region(Context& context, const Region& region, const Vector3d& by) {
  if (by.components.rational().z.sign() != 0) return Maybe<Region>(Undefined{"the vector leaves the plane"});
  const AffineMap map = AffineMap::translation(by.components.rational());
  Polygons image = region.polygons();
  ASSIGN_OR_RETURN(RoundedPoints rounded, round_points(context, map, image.corners));
  if (!std::ranges::all_of(rounded.points, is_finite)) return Maybe<Region>(Undefined{kOutOfRange});
  image.corners = PointArray(std::move(rounded.points));
  if (rounded.are_exact) return Maybe<Region>(Region::trusted(std::move(image)));
  ASSIGN_OR_RETURN(auto proved, Region::prove(image, context.monitor()));
  if (proved) return proved;
  auto exact = exact_images(map, region.polygons().corners);
  if (!exact) return Maybe<Region>(Undefined{kOutOfRange});
  report_unrounded(context);
  image.corners = std::move(*exact);
  return Maybe<Region>(Region::trusted(std::move(image)));
}

Result<Maybe<RegionUnit>> image_of_unit(Context& context, const AffineMap& map, const RegionUnit& unit) {
  MovingPolygons image = unit.polygons();
  bool are_exact = true;
  for (PointArray* corners : {&image.start.corners, &image.end.corners}) {
    ASSIGN_OR_RETURN(RoundedPoints rounded, round_points(context, map, *corners));
    if (!std::ranges::all_of(rounded.points, is_finite)) return Maybe<RegionUnit>(Undefined{kOutOfRange});
    *corners = PointArray(std::move(rounded.points));
    are_exact = are_exact && rounded.are_exact;
  }
  if (are_exact) return Maybe<RegionUnit>(RegionUnit::trusted(unit.interval(), std::move(image)));
  ASSIGN_OR_RETURN(auto proved, RegionUnit::prove(unit.interval(), image, context.monitor()));
  if (proved) return proved;
  auto start = exact_images(map, unit.polygons().start.corners);
  auto end = exact_images(map, unit.polygons().end.corners);
  if (!start || !end) return Maybe<RegionUnit>(Undefined{kOutOfRange});
  report_unrounded(context);
  image.start.corners = std::move(*start);
  image.end.corners = std::move(*end);
  return Maybe<RegionUnit>(RegionUnit::trusted(unit.interval(), std::move(image)));
}

Result<Maybe<MovingRegion>> translated_motion(Context& context, const MovingRegion& moving, const Vector3d& by) {
  if (by.components.rational().z.sign() != 0) return Maybe<MovingRegion>(Undefined{"the vector leaves the plane"});
  const AffineMap map = AffineMap::translation(by.components.rational());
  std::vector<RegionUnit> images;
  for (const RegionUnit& unit : moving.units()) {
    ASSIGN_OR_RETURN(auto image, image_of_unit(context, map, unit));
    if (!image) return Maybe<MovingRegion>(Undefined{image.reason()});
    images.push_back(*std::move(image));
  }
  return MovingRegion::make(std::move(images));
}

template <typename T>
Result<Maybe<T>> rotated(Context& context, const T& geometry, const Point3d& centre, const Vector3d& axis,
                         double angle_degrees) {
  const auto map = AffineMap::rotation(centre.position.rational(), axis.components.rational(), angle_degrees);
  if (!map) return Maybe<T>(Undefined{"the axis is the zero vector"});
  return image_of(context, *map, geometry);
}

template <typename T>
Result<Maybe<T>> mirrored(Context& context, const T& geometry, const Plane3d& plane) {
  return image_of(context, AffineMap::reflection(plane.plane), geometry);
}

template <typename T>
Result<Maybe<T>> translated(Context& context, const T& geometry, const Vector3d& by) {
  return image_of(context, AffineMap::translation(by.components.rational()), geometry);
}

template <typename T>
Result<Maybe<T>> scaled(Context& context, const T& geometry, const Point3d& centre, double factor) {
  const Rational f(factor);
  return image_of(context, AffineMap::scaling(centre.position.rational(), RationalVec3(f, f, f)), geometry);
}

template <typename T>
Result<Maybe<T>> scaled_by_axis(Context& context, const T& geometry, const Point3d& centre, const Vector3d& factors) {
  return image_of(context, AffineMap::scaling(centre.position.rational(), factors.components.rational()), geometry);
}

const std::string kCuboid = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 2, 3))";
const std::string kPoint = "makePoint3D(1, 2, 3)";
const std::string kRounding =
    "Each coordinate is rounded once; where that would break a surface or solid, its exact image is kept and a "
    "diagnostic says so. Triangles keep their order.";

void register_motions(Registry& registry) {
  registry.add({
      .name = "rotate",
      .syntax = "_ rotate[_, _, _]",
      .doc = "Turned about the axis through a point with a direction, right-handed, by an angle in degrees.",
      .detail = "Exact for quarter turns about coordinate axes and half turns about any; other angles are met within "
                "2^-50 rad. Undefined for a zero axis. " +
                kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&rotated<Point3d>>("point", "centre", "axis", "degrees"),
                    overload<&rotated<Points3d>>("points", "centre", "axis", "degrees"),
                    overload<&rotated<Surface3d>>("surface", "centre", "axis", "degrees"),
                    overload<&rotated<Volume3d>>("solid", "centre", "axis", "degrees")},
      .examples = {{kPoint + " rotate[" + kOrigin + ", makeVector3D(0, 0, 1), 90]", "(-2.0 1.0 3.0)"},
                   {"bbox(" + kCuboid + " rotate[" + kOrigin + ", makeVector3D(1, 0, 0), 180])",
                    "(0.0 1.0 -2.0 0.0 -3.0 0.0)"},
                   {kPoint + " rotate[" + kOrigin + ", makeVector3D(0, 0, 0), 90]", "undefined"},
                   {kUndefinedPoint + " rotate[" + kOrigin + ", makeVector3D(0, 0, 1), 90]", "undefined"}},
      .errors = {{"query " + kPoint + " rotate[" + kOrigin + ", 90]",
                  "rotate: expected (point3d point3d vector3d real)"}},
  });
  registry.add({
      .name = "mirror",
      .syntax = "_ mirror[_]",
      .doc = "The mirror image behind a plane; the outside of a solid stays outside.",
      .detail = kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&mirrored<Point3d>>("point", "plane"), overload<&mirrored<Points3d>>("points", "plane"),
                    overload<&mirrored<Surface3d>>("surface", "plane"),
                    overload<&mirrored<Volume3d>>("solid", "plane")},
      .examples = {{kPoint + " mirror[[const plane3d value (2 0 0 1)]]", "(1.0 2.0 1.0)"},
                   {"volume(" + kCuboid + " mirror[[const plane3d value (0 1 1 0)]])", "6.0"},
                   {kUndefinedPoint + " mirror[[const plane3d value (2 0 0 1)]]", "undefined"}},
      .errors = {{"query " + kPoint + " mirror[1]", "mirror: expected (point3d plane3d)"}},
  });
  registry.add({
      .name = "translate",
      .syntax = "_ translate[_]",
      .doc = "Moved by a vector.",
      .detail = kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&translated<Point3d>>("point", "by"), overload<&translated<Points3d>>("points", "by"),
                    overload<&translated<Surface3d>>("surface", "by"), overload<&translated<Volume3d>>("solid", "by"),
                    overload<&translated_region>("region", "by"), overload<&translated_motion>("moving", "by")},
      .examples = {{kPoint + " translate[makeVector3D(1, 0, -3)]", "(2.0 2.0 0.0)"},
                   {"bbox(" + kCuboid + " translate[[const vector3d value (10 0 0)]])", "(10.0 11.0 0.0 2.0 0.0 3.0)"},
                   {"[const region value ((((0 0) (3 0) (0 4))))] translate[makeVector3D(1, -1, 0)]",
                    "((((1.0 -1.0) (4.0 -1.0) (1.0 3.0))))"},
                   {kUndefinedPoint + " translate[makeVector3D(1, 0, -3)]", "undefined"}},
      .errors = {{"query " + kPoint + " translate[1]", "translate: expected (point3d vector3d)"}},
  });
}

}  // namespace

void register_transformation(Registry& registry) {
  register_motions(registry);
  registry.add({
      .name = "scale",
      .syntax = "_ scale[_, _]",
      .doc = "Stretched from a point by a factor: p + f(x - p).",
      .detail = "A factor of zero gives undefined for surfaces and solids; the outside of a solid stays outside for a "
                "negative one. " +
                kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&scaled<Point3d>>("point", "centre", "factor"),
                    overload<&scaled<Points3d>>("points", "centre", "factor"),
                    overload<&scaled<Surface3d>>("surface", "centre", "factor"),
                    overload<&scaled<Volume3d>>("solid", "centre", "factor")},
      .examples = {{kPoint + " scale[makePoint3D(1, 1, 1), 2]", "(1.0 3.0 5.0)"},
                   {"volume(" + kCuboid + " scale[" + kOrigin + ", -2])", "48.0"},
                   {kCuboid + " scale[" + kOrigin + ", 0]", "undefined"},
                   {kUndefinedPoint + " scale[" + kOrigin + ", 2]", "undefined"}},
      .errors = {{"query " + kPoint + " scale[2]", "scale: expected (point3d point3d real)"}},
  });
  registry.add({
      .name = "scaleDir",
      .syntax = "_ scaleDir[_, _]",
      .doc = "Stretched from a point by a factor for each axis: p + v(x - p), componentwise.",
      .detail = "A zero factor gives undefined for surfaces and solids; the outside of a solid stays outside where the "
                "factors mirror it. " +
                kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&scaled_by_axis<Point3d>>("point", "centre", "factors"),
                    overload<&scaled_by_axis<Points3d>>("points", "centre", "factors"),
                    overload<&scaled_by_axis<Surface3d>>("surface", "centre", "factors"),
                    overload<&scaled_by_axis<Volume3d>>("solid", "centre", "factors")},
      .examples = {{kPoint + " scaleDir[" + kOrigin + ", makeVector3D(1, 0, -1)]", "(1.0 0.0 -3.0)"},
                   {"bbox(" + kCuboid + " scaleDir[" + kOrigin + ", makeVector3D(2, 1, -1)])",
                    "(0.0 2.0 0.0 2.0 -3.0 0.0)"},
                   {kCuboid + " scaleDir[" + kOrigin + ", makeVector3D(2, 0, 1)]", "undefined"},
                   {kUndefinedPoint + " scaleDir[" + kOrigin + ", makeVector3D(1, 1, 1)]", "undefined"}},
      .errors = {{"query " + kPoint + " scaleDir[2]", "scaleDir: expected (point3d point3d vector3d)"}},
  });
}

}  // namespace algebra3d
