#include "algebra3d/values/constructions/value_images.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/soup/weld.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr const char* kFlattened = "a zero factor would flatten the shape";

/// A value that holds a coordinate which is not a double keeps its exact image where the map is as exact: rounding
/// would separate it from other values made from the same operands. A value of doubles is rounded once.
bool keeps_exact_image(const AffineMap& map, bool has_fractions) {
  return has_fractions && map.has_dyadic_matrix();
}

Maybe<ExactPoint> image_of_point(const AffineMap& map, const ExactPoint& point) {
  const Vec3 rounded = map.apply_rounded(point);
  if (!is_finite(rounded)) return Undefined{kImageOutOfRange};
  if (!keeps_exact_image(map, !point.is_double())) return ExactPoint(rounded);
  auto exact = map.apply(point);
  if (!exact) return Undefined{kImageOutOfRange};
  return *std::move(exact);
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
    if (i % 8192 == 0) A3D_TRY(context.check_cancelled());
    result.points.push_back(map.apply_rounded(points[i]));
    result.are_exact =
        result.are_exact && is_finite(result.points.back()) && map.image_is_double(points[i], result.points.back());
  }
  return result;
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
Result<Maybe<T>> exact_image_of_mesh(Context& context, const AffineMap& map, const T& geometry) {
  if (map.orientation() == 0) return Maybe<T>(Undefined{kFlattened});
  A3D_ASSIGN(auto image, exact_image(map, geometry.mesh(), context.cancel));
  if (!image) return Maybe<T>(Undefined{image.reason()});
  return Maybe<T>(T::trusted(*std::move(image)));
}

/// Nothing if rounding makes it invalid.
template <typename T>
Result<Maybe<std::optional<T>>> rounded_image_of_mesh(Context& context, const AffineMap& map, const T& geometry) {
  using Image = Maybe<std::optional<T>>;
  if (map.orientation() == 0) return Image(Undefined{kFlattened});
  const TriangleMesh& mesh = geometry.mesh();
  A3D_ASSIGN(RoundedPoints rounded, round_points(context, map, mesh.points()));
  if (!std::ranges::all_of(rounded.points, is_finite)) return Image(Undefined{kImageOutOfRange});
  const std::vector<TriangleMesh::Triangle> triangles = image_triangles(map, mesh);
  // Only rounding can break an image.
  if (rounded.are_exact)
    return Image(std::optional(T::trusted(TriangleMesh(PointArray(std::move(rounded.points)), triangles))));
  const ProofOptions options{.thoroughness = Thoroughness::first_defect,
                             .cancel = context.cancel,
                             .preimage = preimage_of(map, mesh, rounded.points)};
  A3D_ASSIGN(auto proved, T::prove(rounded_mesh(rounded.points, triangles), options));
  return Image(proved ? std::optional(*std::move(proved)) : std::nullopt);
}

template <typename T>
Result<Maybe<T>> image_of_mesh(Context& context, const AffineMap& map, const T& geometry) {
  if (!keeps_exact_image(map, geometry.mesh().points().exact_count() > 0)) {
    A3D_ASSIGN(auto rounded, rounded_image_of_mesh(context, map, geometry));
    if (!rounded) return Maybe<T>(Undefined{rounded.reason()});
    if (*rounded) return Maybe<T>(**std::move(rounded));
    report_unrounded(context);
  }
  return exact_image_of_mesh(context, map, geometry);
}

/// The vertices of a mesh: all exact, or all rounded once.
Result<Maybe<PointArray>> image_of_points(Context& context, const AffineMap& map, const PointArray& points) {
  if (keeps_exact_image(map, points.exact_count() > 0)) return exact_images(map, points, context.cancel);
  A3D_ASSIGN(RoundedPoints rounded, round_points(context, map, points));
  if (!std::ranges::all_of(rounded.points, is_finite)) return Maybe<PointArray>(Undefined{kImageOutOfRange});
  return Maybe<PointArray>(PointArray(std::move(rounded.points)));
}

LargeVector<std::uint32_t> image_corners(const AffineMap& map, const PolygonMesh& mesh) {
  LargeVector<std::uint32_t> corners = mesh.origins();
  if (map.orientation() >= 0) return corners;
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    std::uint32_t* const first = corners.data() + mesh.halfedge(f).index();
    std::reverse(first + 1, first + mesh.degree(f));
  }
  return corners;
}

/// The elements of a mesh of which the corners of all faces were reversed.
ElementSources sources_of_reversed(const PolygonMesh& image, const PolygonMesh& mesh) {
  ElementSources sources;
  sources.vertices.resize(mesh.vertex_count());
  std::iota(sources.vertices.begin(), sources.vertices.end(), 0U);
  sources.faces.resize(mesh.face_count());
  std::iota(sources.faces.begin(), sources.faces.end(), 0U);
  std::vector<std::uint32_t> along;
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    const std::uint32_t first = mesh.halfedge(f).index(), degree = mesh.degree(f);
    for (std::uint32_t i = 0; i < degree; ++i) {
      sources.halfedges.push_back(first + (degree - i) % degree);
      along.push_back(first + degree - 1 - i);
    }
  }
  sources.edges = edge_sources(image, mesh, along);
  return sources;
}

/// The matrix of cofactors with the sign of the determinant, times a positive factor, rounded.
std::array<Vec3, 3> rounded_cofactors(const AffineMap& map) {
  const std::array<RationalVec3, 3>& rows = map.rows();
  std::array<RationalVec3, 3> cofactors;
  Rational largest(0);
  for (std::size_t i = 0; i < 3; ++i) {
    cofactors[i] = cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Rational& entry = cofactors[i][axis];
      largest = std::max(largest, entry.sign() < 0 ? -entry : entry);
    }
  }
  std::array<Vec3, 3> rounded;
  if (largest.sign() == 0) return rounded;
  const Rational factor = Rational(map.orientation() < 0 ? -1 : 1) / largest;
  for (std::size_t i = 0; i < 3; ++i) rounded[i] = ExactPoint(factor * cofactors[i]).approx();
  return rounded;
}

/// Normals of the image, as long as they were: by the matrix of cofactors of the map, rounded.
AttributeValues image_normals(const AffineMap& map, const AttributeValues& normals) {
  const std::array<Vec3, 3> cofactors = rounded_cofactors(map);
  AttributeValues images(AttributeKind::vector, normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!normals.is_defined(i)) continue;
    const std::span<const double> n = normals.numbers(i);
    const Vec3 given{n[0], n[1], n[2]};
    const Vec3 turned{dot(cofactors[0], given), dot(cofactors[1], given), dot(cofactors[2], given)};
    const double factor = length(given) / length(turned);
    images.set(i, std::array{turned.x * factor, turned.y * factor, turned.z * factor});
  }
  return images;
}

/// The attributes of the image of a mesh: the same, except that vectors called Normal turn with the faces.
MeshAttributes image_attributes(const AffineMap& map, const Mesh3d& mesh, const PolygonMesh& image) {
  MeshAttributes attributes = mesh.attributes();
  if (map.orientation() < 0) attributes = taken_over(attributes, sources_of_reversed(image, mesh.mesh()));
  for (const MeshElement element : kMeshElements)
    if (const MeshAttribute* const normals = attributes.find(element, kNormalAttribute);
        normals != nullptr && normals->values->kind() == AttributeKind::vector)
      attributes = attributes.with(element, kNormalAttribute, image_normals(map, *normals->values));
  return attributes;
}

Result<Maybe<Region>> exact_image_of(Context& context, const AffineMap& map, const Region& region) {
  Polygons image = region.polygons();
  A3D_ASSIGN(auto corners, exact_images(map, image.corners, context.cancel));
  if (!corners) return Maybe<Region>(Undefined{corners.reason()});
  image.corners = *std::move(corners);
  return Maybe<Region>(Region::trusted(std::move(image)));
}

Result<Maybe<RegionUnit>> exact_image_of(Context& context, const AffineMap& map, const RegionUnit& unit) {
  MovingPolygons image = unit.polygons();
  for (PointArray* corners : {&image.start.corners, &image.end.corners}) {
    A3D_ASSIGN(auto images, exact_images(map, *corners, context.cancel));
    if (!images) return Maybe<RegionUnit>(Undefined{images.reason()});
    *corners = *std::move(images);
  }
  return Maybe<RegionUnit>(RegionUnit::trusted(unit.interval(), std::move(image)));
}

Result<Maybe<RegionUnit>> image_of_unit(Context& context, const AffineMap& map, const RegionUnit& unit) {
  MovingPolygons image = unit.polygons();
  bool are_exact = true;
  for (PointArray* corners : {&image.start.corners, &image.end.corners}) {
    A3D_ASSIGN(RoundedPoints rounded, round_points(context, map, *corners));
    if (!std::ranges::all_of(rounded.points, is_finite)) return Maybe<RegionUnit>(Undefined{kImageOutOfRange});
    *corners = PointArray(std::move(rounded.points));
    are_exact = are_exact && rounded.are_exact;
  }
  if (are_exact) return Maybe<RegionUnit>(RegionUnit::trusted(unit.interval(), std::move(image)));
  A3D_ASSIGN(auto proved, RegionUnit::prove(unit.interval(), image, context.monitor()));
  if (proved) return proved;
  A3D_ASSIGN(auto exact, exact_image_of(context, map, unit));
  if (exact) report_unrounded(context);
  return exact;
}

bool has_fractions(const RegionUnit& unit) {
  return unit.polygons().start.corners.exact_count() > 0 || unit.polygons().end.corners.exact_count() > 0;
}

}  // namespace

Result<Maybe<std::optional<Volume3d>>> rounded_image_of(Context& context, const AffineMap& map, const Volume3d& solid) {
  return rounded_image_of_mesh(context, map, solid);
}

Result<Maybe<Volume3d>> exact_image_of(Context& context, const AffineMap& map, const Volume3d& solid) {
  return exact_image_of_mesh(context, map, solid);
}

Result<Maybe<Point3d>> image_of(Context& /*context*/, const AffineMap& map, const Point3d& point) {
  auto image = image_of_point(map, point.position);
  if (!image) return Maybe<Point3d>(Undefined{image.reason()});
  return Maybe<Point3d>(Point3d{*std::move(image)});
}

Result<Maybe<Points3d>> image_of(Context& context, const AffineMap& map, const Points3d& points) {
  std::vector<ExactPoint> images;
  images.reserve(points.points().size());
  for (const ExactPoint& point : points.points()) {
    if (images.size() % 8192 == 0) A3D_TRY(context.check_cancelled());
    auto image = image_of_point(map, point);
    if (!image) return Maybe<Points3d>(Undefined{image.reason()});
    images.push_back(*std::move(image));
  }
  return Maybe<Points3d>(Points3d(std::move(images)));
}

Result<Maybe<Surface3d>> image_of(Context& context, const AffineMap& map, const Surface3d& surface) {
  return image_of_mesh(context, map, surface);
}

Result<Maybe<Volume3d>> image_of(Context& context, const AffineMap& map, const Volume3d& solid) {
  return image_of_mesh(context, map, solid);
}

Result<Maybe<Mesh3d>> image_of(Context& context, const AffineMap& map, const Mesh3d& mesh) {
  A3D_ASSIGN(auto points, image_of_points(context, map, mesh.mesh().points()));
  if (!points) return Maybe<Mesh3d>(Undefined{points.reason()});
  PolygonMesh image(*std::move(points), mesh.mesh().layout(), image_corners(map, mesh.mesh()));
  if (mesh.attributes().is_empty()) return Maybe<Mesh3d>(Mesh3d(std::move(image)));
  MeshAttributes attributes = image_attributes(map, mesh, image);
  return Maybe<Mesh3d>(Mesh3d(std::move(image), std::move(attributes)));
}

Result<Maybe<Region>> image_of(Context& context, const AffineMap& map, const Region& region) {
  Polygons image = region.polygons();
  if (keeps_exact_image(map, image.corners.exact_count() > 0)) return exact_image_of(context, map, region);
  A3D_ASSIGN(RoundedPoints rounded, round_points(context, map, image.corners));
  if (!std::ranges::all_of(rounded.points, is_finite)) return Maybe<Region>(Undefined{kImageOutOfRange});
  image.corners = PointArray(std::move(rounded.points));
  if (rounded.are_exact) return Maybe<Region>(Region::trusted(std::move(image)));
  A3D_ASSIGN(auto proved, Region::prove(image, context.monitor()));
  if (proved) return proved;
  A3D_ASSIGN(auto exact, exact_image_of(context, map, region));
  if (exact) report_unrounded(context);
  return exact;
}

// Units are treated alike, so that those which meet go on meeting.
Result<Maybe<MovingRegion>> image_of(Context& context, const AffineMap& map, const MovingRegion& moving) {
  const bool is_exact = keeps_exact_image(map, std::ranges::any_of(moving.units(), has_fractions));
  std::vector<RegionUnit> images;
  for (const RegionUnit& unit : moving.units()) {
    A3D_ASSIGN(auto image, is_exact ? exact_image_of(context, map, unit) : image_of_unit(context, map, unit));
    if (!image) return Maybe<MovingRegion>(Undefined{image.reason()});
    images.push_back(*std::move(image));
  }
  return MovingRegion::make(std::move(images));
}

}  // namespace algebra3d
