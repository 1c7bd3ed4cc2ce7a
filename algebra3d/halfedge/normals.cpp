#include "algebra3d/halfedge/normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra3d/exact/plane.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/detail/angles.h"

namespace algebra3d {
namespace {

// ---- faces

/// The normal by doubles alone; nothing where that is not within 1e-9: relative to the sum of the products of the
/// edges' lengths the error is below 2^-50 per corner.
template <typename Layout>
std::optional<Vec3> quick_normal(const HalfedgeMesh<Layout>& mesh, FaceId f) {
  constexpr double kLeastShare = 0x1p-20;
  const auto corners = corner_indices(mesh, f);
  if (mesh.points().exact_count() != 0 &&
      !std::ranges::all_of(corners, [&](std::uint32_t corner) { return mesh.points()[corner].is_double(); }))
    return std::nullopt;
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3 origin = points[corners[0]];
  Vec3 sum, before = points[corners[1]] - origin;
  double products = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 next = points[corners[i]] - origin;
    sum = sum + cross(before, next);
    products += std::sqrt(dot(before, before) * dot(next, next));
    before = next;
  }
  const double size = std::sqrt(dot(sum, sum));
  if (!(size > kLeastShare * products) || !(size > 0x1p-400) || !(size < 0x1p400)) return std::nullopt;
  return 1 / size * sum;
}

// ---- edges

/// The sign of the angle at an edge: positive if it is convex. Exact.
template <typename Layout>
int turning_sign(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  const auto exact_normal = [&](FaceId f) { return exact_doubled_vector_area(mesh.points(), corner_indices(mesh, f)); };
  const RationalVec3 along = mesh.point(mesh.target(edge)).rational() - mesh.point(mesh.origin(edge)).rational();
  return dot(cross(exact_normal(mesh.face(edge)), exact_normal(mesh.face(mesh.opposite(edge)))), along).sign();
}

// ---- vertices

/// A vector of any size brought to the length 1; the zero vector stays.
Vec3 direction(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) return v;
  const Vec3 scaled{v.x / largest, v.y / largest, v.z / largest};
  const double size = std::sqrt(dot(scaled, scaled));
  return {scaled.x / size, scaled.y / size, scaled.z / size};
}

/// The angle of the corner that `h` leaves, in a face with this normal: more than pi at a reflex corner.
template <typename Layout>
double corner_angle(const HalfedgeMesh<Layout>& mesh, HalfedgeId h, const Vec3& normal) {
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3& corner = points[mesh.origin(h).index()];
  Vec3 u = points[mesh.target(h).index()] - corner;
  Vec3 v = points[mesh.origin(mesh.prev(h)).index()] - corner;
  Vec3 turn = cross(u, v);
  const double size = dot(turn, turn) + std::abs(dot(u, v));
  if (!(size > 0x1p-900) || !(size < 0x1p900)) {
    // Differences of the largest doubles are beyond their range.
    const double scale = size < 0x1p900 ? 1 : 0.25;
    u = direction(scale * points[mesh.target(h).index()] - scale * corner);
    v = direction(scale * points[mesh.origin(mesh.prev(h)).index()] - scale * corner);
    turn = cross(u, v);
  }
  const double angle = detail::angle_of_direction(std::sqrt(dot(turn, turn)), dot(u, v));
  return mesh.degree(mesh.face(h)) > 3 && dot(turn, normal) < 0 ? 2 * std::numbers::pi - angle : angle;
}

/// A sum of normals weighted by angles.
struct WeightedNormal {
  Vec3 sum;
  double angles = 0;

  void add(const Vec3& normal, double angle) {
    sum = sum + angle * normal;
    angles += angle;
  }
  /// The direction of the sum; zero if the normals cancel.
  Vec3 direction() const {
    const double size = std::sqrt(dot(sum, sum));
    return size > 0x1p-40 * angles ? 1 / size * sum : Vec3{};
  }
};

// ---- corners

/// Makes the normals of corners, fan by fan.
template <typename Layout>
class CornerNormalsMaker {
 public:
  CornerNormalsMaker(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals, double crease_angle_degrees)
      : mesh_(mesh), face_normals_(face_normals), crease_angle_degrees_(crease_angle_degrees) {
    result_.of_corner.resize(mesh.halfedge_count());
  }

  CornerNormals make() && {
    for (const VertexId v : vertices(mesh_))
      for (const HalfedgeId first : mesh_.fans(v)) add_fan(first);
    return std::move(result_);
  }

 private:
  Vec3 normal(HalfedgeId h) const { return face_normals_[mesh_.face(h).index()]; }
  HalfedgeId next_in_fan(HalfedgeId h) const { return mesh_.opposite(mesh_.prev(h)); }
  bool is_crease_before(HalfedgeId h) const {
    const HalfedgeId opposite = mesh_.opposite(h);
    if (!opposite.is_valid()) return true;
    const Vec3 a = normal(h), b = normal(opposite);
    return a != b && detail::angle_between(a, b) * detail::kDegreesPerRadian > crease_angle_degrees_;
  }

  void add_fan(HalfedgeId first) {
    fan_.clear();
    HalfedgeId h = first;
    do {
      fan_.push_back(h);
      h = next_in_fan(h);
    } while (h.is_valid() && h != first);
    const auto begin = std::ranges::find_if(fan_, [&](HalfedgeId corner) { return is_crease_before(corner); });
    if (begin != fan_.end()) std::rotate(fan_.begin(), begin, fan_.end());
    for (std::size_t part = 0; part < fan_.size();) {
      std::size_t end = part + 1;
      while (end < fan_.size() && !is_crease_before(fan_[end])) ++end;
      add_part(std::span(fan_).subspan(part, end - part));
      part = end;
    }
  }

  void add_part(std::span<const HalfedgeId> corners) {
    WeightedNormal sum;
    for (const HalfedgeId h : corners) {
      sum.add(normal(h), corner_angle(mesh_, h, normal(h)));
      result_.of_corner[h.index()] = static_cast<std::uint32_t>(result_.normals.size());
    }
    const Vec3 direction = sum.direction();
    result_.normals.push_back(direction == Vec3{} ? normal(corners.front()) : direction);
  }

  const HalfedgeMesh<Layout>& mesh_;
  std::span<const Vec3> face_normals_;
  double crease_angle_degrees_;
  CornerNormals result_;
  std::vector<HalfedgeId> fan_;
};

}  // namespace

template <typename Layout>
std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<Layout>& mesh, HalfedgeId edge) {
  const HalfedgeId opposite = mesh.opposite(edge);
  if (!opposite.is_valid()) return std::nullopt;
  const VectorArea left = vector_area(mesh, mesh.face(edge)), right = vector_area(mesh, mesh.face(opposite));
  if (!left.has_normal() || !right.has_normal()) return std::nullopt;
  const double angle = detail::angle_between(left.normal, right.normal) * detail::kDegreesPerRadian;
  if (angle == 0) return 0;
  // Where the faces nearly lie upon each other rounding could turn 180 degrees round.
  constexpr double kNearlyFolded = 179.99;
  if (angle > kNearlyFolded) return turning_sign(mesh, edge) < 0 ? -angle : angle;
  const Vec3 along = mesh.point(mesh.target(edge)).approx - mesh.point(mesh.origin(edge)).approx;
  return dot(cross(left.normal, right.normal), along) < 0 ? -angle : angle;
}

template <typename Layout>
std::vector<Vec3> face_normals(const HalfedgeMesh<Layout>& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.face_count());
  for (const FaceId f : faces(mesh)) {
    const std::optional<Vec3> quick = quick_normal(mesh, f);
    normals.push_back(quick ? *quick : vector_area(mesh, f).normal);
  }
  return normals;
}

template <typename Layout>
Vec3 vertex_normal(const HalfedgeMesh<Layout>& mesh, VertexId v) {
  WeightedNormal sum;
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    const Vec3 normal = vector_area(mesh, mesh.face(h)).normal;
    sum.add(normal, corner_angle(mesh, h, normal));
  }
  return sum.direction();
}

template <typename Layout>
std::vector<Vec3> vertex_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals) {
  std::vector<WeightedNormal> sums(mesh.vertex_count());
  for (const FaceId f : faces(mesh)) {
    const Vec3& normal = face_normals[f.index()];
    for (const HalfedgeId h : halfedges_of(mesh, f))
      sums[mesh.origin(h).index()].add(normal, corner_angle(mesh, h, normal));
  }
  std::vector<Vec3> normals(sums.size());
  std::ranges::transform(sums, normals.begin(), &WeightedNormal::direction);
  return normals;
}

template <typename Layout>
CornerNormals corner_normals(const HalfedgeMesh<Layout>& mesh, std::span<const Vec3> face_normals,
                             double crease_angle_degrees) {
  return CornerNormalsMaker<Layout>(mesh, face_normals, crease_angle_degrees).make();
}

template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<TriangleLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<TriangleLayout>&);
template Vec3 vertex_normal(const HalfedgeMesh<TriangleLayout>&, VertexId);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>);
template CornerNormals corner_normals(const HalfedgeMesh<TriangleLayout>&, std::span<const Vec3>, double);
template std::optional<double> dihedral_angle_degrees(const HalfedgeMesh<PolygonLayout>&, HalfedgeId);
template std::vector<Vec3> face_normals(const HalfedgeMesh<PolygonLayout>&);
template Vec3 vertex_normal(const HalfedgeMesh<PolygonLayout>&, VertexId);
template std::vector<Vec3> vertex_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>);
template CornerNormals corner_normals(const HalfedgeMesh<PolygonLayout>&, std::span<const Vec3>, double);

}  // namespace algebra3d
