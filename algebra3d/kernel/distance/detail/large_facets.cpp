#include "algebra3d/kernel/distance/detail/large_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/disjoint_ids.h"
#include "base/interruption_scope.h"

namespace algebra3d::distances {
namespace {

/// Facets of fewer triangles are treated triangle by triangle.
constexpr std::size_t kLeastTriangles = 16;
/// A bound of the roundings of coordinates, in units.
constexpr double kOfCoordinate = 0x1p-51;

Vec3 in_units(const Vec3& point, double half_scale) {
  return half_scale * (0.5 * point);
}

/// Two edges of a face from its first corner, and twice its area as a vector.
struct FaceVectors {
  WideVec3 first, second, normal;

  FaceVectors(const TriangleMesh& mesh, FaceId face, double half_scale) {
    const auto [a, b, c] = mesh.triangle(face);
    const std::vector<Vec3>& points = mesh.points().approx();
    const WideVec3 corner(in_units(points[a], half_scale));
    first = WideVec3(in_units(points[b], half_scale)) - corner;
    second = WideVec3(in_units(points[c], half_scale)) - corner;
    normal = cross(first, second);
  }
  /// A bound of the error of the normal.
  long double error() const {
    const long double a = length(first), b = length(second);
    return 4 * kOfCoordinate * (a + b + kOfCoordinate) + 0x1p-50L * a * b;
  }
};

}  // namespace

LargeFacets::LargeFacets(const TriangleMesh& mesh, double half_scale) {
  if (mesh.face_count() < kLeastTriangles) return;
  find_facets(mesh, half_scale);
  if (planes_.empty()) return;
  find_planes(mesh, half_scale);
  find_outlines(mesh);
}

void LargeFacets::find_facets(const TriangleMesh& mesh, double half_scale) {
  std::vector<WideVec3> normals(mesh.face_count());  // 0 of faces that may be degenerate
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const FaceVectors vectors(mesh, FaceId(f), half_scale);
    if (length(vectors.normal) > 4 * vectors.error()) normals[f] = vectors.normal;
  }
  DisjointIds<FaceId> joined(mesh.face_count());
  for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
    poll_interruption_at(h);
    const HalfedgeId edge(h), opposite = mesh.opposite(edge);
    if (!opposite.is_valid() || opposite.index() < h) continue;
    const FaceId own = TriangleMesh::face(edge), other = TriangleMesh::face(opposite);
    // Not where a facet is folded.
    if (!(dot(normals[own.index()], normals[other.index()]) > 0)) continue;
    const TriangleRef corners = mesh.corners(own);
    if (orient3d(corners[0], corners[1], corners[2], mesh.point(mesh.origin(TriangleMesh::prev(opposite)))) == 0)
      joined.unite(own, other);
  }
  std::vector<std::uint32_t> counts(mesh.face_count(), 0), numbers(mesh.face_count(), kNone);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) ++counts[joined.find(FaceId(f)).index()];
  std::uint32_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (counts[f] >= kLeastTriangles) numbers[f] = count++;
  if (count == 0) return;
  planes_.resize(count);
  facet_of_face_.resize(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) facet_of_face_[f] = numbers[joined.find(FaceId(f)).index()];
}

void LargeFacets::find_planes(const TriangleMesh& mesh, double half_scale) {
  std::vector<long double> errors(planes_.size(), 0);
  std::vector<std::uint32_t> counts(planes_.size(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const std::uint32_t facet = facet_of_face_[f];
    if (facet == kNone) continue;
    const FaceVectors vectors(mesh, FaceId(f), half_scale);
    Plane& plane = planes_[facet];
    plane.normal = plane.normal + vectors.normal;
    plane.point = WideVec3(in_units(mesh.points().approx()[mesh.triangle(FaceId(f))[0]], half_scale));
    errors[facet] += vectors.error();
    ++counts[facet];
  }
  std::vector<std::uint8_t> is_good(planes_.size());
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    Plane& plane = planes_[i];
    const long double size = length(plane.normal);
    const long double of_sum = std::numeric_limits<long double>::epsilon() * counts[i];
    plane.turn = 2 * (errors[i] / size + of_sum);
    plane.normal = 1 / size * plane.normal;
    is_good[i] = static_cast<std::uint8_t>(plane.turn < 0x1p-20L);
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    std::uint32_t& facet = facet_of_face_[f];
    if (facet == kNone) continue;
    Plane& plane = planes_[facet];
    for (const std::uint32_t corner : mesh.triangle(FaceId(f))) {
      const WideVec3 place(in_units(mesh.points().approx()[corner], half_scale));
      plane.deviation = std::max(plane.deviation, std::abs(dot(plane.normal, place - plane.point)) + 8 * kOfCoordinate);
    }
    if (is_good[facet] == 0) facet = kNone;
  }
}

void LargeFacets::find_outlines(const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> edges;
  for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
    poll_interruption_at(h);
    const HalfedgeId edge(h), opposite = mesh.opposite(edge);
    const std::uint32_t facet = facet_of(TriangleMesh::face(edge));
    if (facet == kNone) continue;
    if (opposite.is_valid() && facet_of(TriangleMesh::face(opposite)) == facet) continue;
    const auto first = static_cast<std::uint32_t>(points.size());
    points.push_back(mesh.points().approx()[mesh.origin(edge).index()]);
    points.push_back(mesh.points().approx()[mesh.target(edge).index()]);
    edges.push_back({first, first + 1, first + 1});
    facet_of_edge_.push_back(facet);
  }
  outlines_ = TriangleMesh(PointArray(std::move(points)), edges);
  hierarchy_.emplace(outlines_);
}

}  // namespace algebra3d::distances
