#include "algebra3d/rounding/detail/snapped_faces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "algebra3d/base/disjoint_ids.h"
#include "algebra3d/base/id_vector.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"

namespace algebra3d {
namespace {

bool repeats_a_corner(const std::array<PointId, 3>& corners) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

/// The corners in ascending order, and whether that is an odd permutation of them.
std::pair<std::array<PointId, 3>, bool> sorted(std::array<PointId, 3> corners) {
  bool is_odd = false;
  const auto order = [&](PointId& a, PointId& b) {
    if (a < b) return;
    std::swap(a, b);
    is_odd = !is_odd;
  };
  order(corners[0], corners[1]);
  order(corners[1], corners[2]);
  order(corners[0], corners[1]);
  return {corners, is_odd};
}

}  // namespace

PointPair ordered(PointId a, PointId b) {
  return a < b ? PointPair(a, b) : PointPair(b, a);
}

SnappedFaces::SnappedFaces(const TriangleMesh& mesh, Folded folded) : folded_(folded), table_(mesh.vertex_count()) {
  IdVector<VertexId, PointId> points(mesh.vertex_count());
  for (const VertexId vertex : points.ids()) points[vertex] = PointId(table_.intern(mesh.point(vertex)));
  faces_.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.triangle(FaceId(f));
    faces_.push_back({{points[VertexId(a)], points[VertexId(b)], points[VertexId(c)]}, {}, 0, true, true});
  }
  ties_ = DisjointIds<PointId>(table_.size());
  drop_empty_faces();
  given_.reserve(faces_.size());
  for (Face& face : faces_) {
    face.given = given_.size();
    given_.push_back(face.corners);
  }
}

PointId SnappedFaces::add_point(const Vec3& place) {
  const PointId point(table_.intern(PointRef(place)));
  if (point.index() == ties_.size()) ties_.add();
  return point;
}

TriangleRef SnappedFaces::triangle(std::size_t face) const {
  const auto& [a, b, c] = faces_[face].corners;
  return {point(a), point(b), point(c)};
}

void SnappedFaces::close_all_but(std::span<const std::size_t> faces) {
  for (Face& face : faces_) face.is_open = false;
  for (const std::size_t face : faces) faces_[face].is_open = true;
}

SnappedFaces::Face SnappedFaces::part_of(std::size_t given, const Corner& a, const Corner& b, const Corner& c) {
  return {{a.point, b.point, c.point}, {a.displacement, b.displacement, c.displacement}, given, true, false};
}

void SnappedFaces::tie_to_given(const Face& face) {
  for (const PointId corner : given_[face.given]) ties_.unite(corner, face.corners[0]);
  for (const PointId corner : face.corners) ties_.unite(corner, face.corners[0]);
}

void SnappedFaces::merge(FeatureJoins& joins) {
  DisjointIds<PointId> sets(table_.size());
  for (const auto& [a, b] : joins.merged) sets.unite(a, b);
  for (Face& face : faces_)
    for (std::size_t i = 0; i < 3; ++i) {
      const PointId old = face.corners[i], merged = sets.find(old);
      if (merged == old) continue;
      face.displacements[i] = face.displacements[i] + (place(merged) - place(old)).rounded();
      face.corners[i] = merged;
      face.is_open = true;
      face.is_given = false;
      tie_to_given(face);
    }
  std::map<PointPair, std::vector<PointId>> led;
  for (const auto& [edge, points] : joins.led)
    for (const PointId p : points) led[ordered(sets.find(edge.first), sets.find(edge.second))].push_back(sets.find(p));
  joins.led = std::move(led);
  for (auto& [face, p] : joins.divided) p = sets.find(p);
}

void SnappedFaces::sort_along(const PointPair& edge, std::vector<PointId>& points) const {
  const WideVec3 from = place(edge.first), direction = place(edge.second) - from;
  std::erase_if(points, [&](PointId p) { return p == edge.first || p == edge.second; });
  std::ranges::sort(points, {}, [&](PointId p) { return std::pair(dot(place(p) - from, direction), p); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

SnappedFaces::Corner SnappedFaces::corner_on_edge(PointId point, const Corner& from, const Corner& to) const {
  const WideVec3 start = place(from.point), direction = place(to.point) - start;
  const long double share = std::clamp(dot(place(point) - start, direction) / dot(direction, direction), 0.0L, 1.0L);
  const WideVec3 stands_for = (1 - share) * origin(from) + share * origin(to);
  return {point, (place(point) - stands_for).rounded()};
}

SnappedFaces::Corner SnappedFaces::corner_in_face(PointId point, const Face& face) const {
  const WideVec3 a = place(face.corners[0]), ab = place(face.corners[1]) - a, ac = place(face.corners[2]) - a;
  const WideVec3 normal = cross(ab, ac), p = place(point) - a;
  const long double b_share = std::clamp(dot(cross(p, ac), normal) / dot(normal, normal), 0.0L, 1.0L);
  const long double c_share = std::clamp(dot(cross(ab, p), normal) / dot(normal, normal), 0.0L, 1 - b_share);
  const WideVec3 stands_for = (1 - b_share - c_share) * origin(corner(face, 0)) + b_share * origin(corner(face, 1)) +
                              c_share * origin(corner(face, 2));
  return {point, (place(point) - stands_for).rounded()};
}

SnappedFaces::Chain SnappedFaces::chain(const Corner& from, const Corner& to, const FeatureJoins& joins) const {
  Chain chain = {from};
  if (const auto found = joins.led.find(ordered(from.point, to.point)); found != joins.led.end()) {
    for (const PointId p : found->second) chain.push_back(corner_on_edge(p, from, to));
    if (to.point < from.point) std::reverse(chain.begin() + 1, chain.end());
  }
  chain.push_back(to);
  return chain;
}

// Halves the longest side, again and again.
void SnappedFaces::triangulate(std::size_t given, const Chain& ab, const Chain& bc, const Chain& ca,
                               std::vector<Face>& faces) {
  if (ab.size() < std::max(bc.size(), ca.size())) return triangulate(given, bc, ca, ab, faces);
  if (ab.size() == 2) {
    faces.push_back(part_of(given, ab[0], bc[0], ca[0]));
    return;
  }
  const auto middle = ab.begin() + static_cast<std::ptrdiff_t>(ab.size() / 2);
  triangulate(given, {ab.begin(), middle + 1}, {*middle, ca[0]}, ca, faces);
  triangulate(given, {middle, ab.end()}, bc, {ca[0], *middle}, faces);
}

void SnappedFaces::apply(FeatureJoins joins) {
  if (!joins.merged.empty()) merge(joins);
  IdVector<PointId, bool> is_end(table_.size());  // of an edge that is led through points
  for (auto& [edge, points] : joins.led) {
    sort_along(edge, points);
    is_end[edge.first] = is_end[edge.second] = true;
  }
  std::vector<Face> result;
  result.reserve(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    if (repeats_a_corner(face.corners)) continue;
    const Corner a = corner(face, 0), b = corner(face, 1), c = corner(face, 2);
    if (is_end[a.point] + is_end[b.point] + is_end[c.point] >= 2) {
      triangulate(face.given, chain(a, b, joins), chain(b, c, joins), chain(c, a, joins), result);
      const bool is_as_before = result.back().corners == face.corners;
      if (!is_as_before) continue;
      result.pop_back();
    }
    if (const auto divided = joins.divided.find(f); divided != joins.divided.end()) {
      const Corner inner = corner_in_face(divided->second, face);
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        result.push_back(part_of(face.given, from, to, inner));
    } else {
      result.push_back(face);
    }
  }
  faces_ = std::move(result);
  for (const Face& face : faces_)
    if (face.is_open && !face.is_given) tie_to_given(face);
  drop_empty_faces();
}

/// Per given face: whether it is not there any more as it was.
std::vector<bool> SnappedFaces::changed_given() const {
  std::vector<bool> are_changed(given_.size(), true);
  for (const Face& face : faces_)
    if (face.is_given) are_changed[face.given] = false;
  return are_changed;
}

void SnappedFaces::restore(std::span<const PointId> clusters) {
  std::vector<bool> is_restored = changed_given();
  for (std::size_t given = 0; given < given_.size(); ++given)
    if (is_restored[given]) is_restored[given] = std::ranges::binary_search(clusters, cluster_of(given_[given][0]));
  std::erase_if(faces_, [&](const Face& face) { return is_restored[face.given]; });
  for (std::size_t given = 0; given < given_.size(); ++given)
    if (is_restored[given]) faces_.push_back({given_[given], {}, given, true, true});
  drop_empty_faces();
}

/// Drops triangles that repeat a corner, and of pairs with the same corners both or the second, as `folded` says.
void SnappedFaces::drop_empty_faces() {
  std::erase_if(faces_, [](const Face& face) { return repeats_a_corner(face.corners); });
  struct Key {
    std::array<PointId, 3> corners;
    std::size_t face;
    bool is_odd;
  };
  // Faces that are not open are no pairs with each other.
  IdVector<PointId, bool> is_open_corner(table_.size());
  for (const Face& face : faces_)
    if (face.is_open)
      for (const PointId corner : face.corners) is_open_corner[corner] = true;
  std::vector<Key> keys;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!std::ranges::all_of(faces_[f].corners, [&](PointId corner) { return is_open_corner[corner]; })) continue;
    const auto [corners, is_odd] = sorted(faces_[f].corners);
    keys.push_back({corners, f, is_odd});
  }
  std::ranges::sort(keys, {}, [](const Key& key) { return std::tuple(key.corners, key.face); });
  std::vector<bool> is_dropped(faces_.size());
  std::vector<const Key*> unpaired;  // with the same corners
  for (const Key& key : keys) {
    if (!unpaired.empty() && unpaired.back()->corners != key.corners) unpaired.clear();
    const bool is_pair = !unpaired.empty() && (folded_ == Folded::stays || unpaired.back()->is_odd != key.is_odd);
    if (!is_pair) {
      unpaired.push_back(&key);
      continue;
    }
    for (const std::size_t face : {key.face, unpaired.back()->face})
      if (!given_.empty()) tie_to_given(faces_[face]);
    is_dropped[key.face] = true;
    if (folded_ == Folded::stays) continue;
    is_dropped[unpaired.back()->face] = true;
    unpaired.pop_back();
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (!is_dropped[f]) faces_[kept++] = faces_[f];
  faces_.resize(kept);
}

TriangleMesh SnappedFaces::mesh_of_corners(std::span<const std::array<PointId, 3>> faces) const {
  PointArray points;
  IdVector<PointId, std::uint32_t> numbers(table_.size(), kNone);
  std::vector<IndexTriangle> triangles;
  triangles.reserve(faces.size());
  for (const std::array<PointId, 3>& corners : faces) {
    IndexTriangle& triangle = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& number = numbers[corners[i]];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(points.size());
        points.push_back(point(corners[i]));
      }
      triangle[i] = number;
    }
  }
  return {std::move(points), triangles};
}

TriangleMesh SnappedFaces::mesh() const {
  std::vector<std::array<PointId, 3>> corners;
  corners.reserve(faces_.size());
  for (const Face& face : faces_) corners.push_back(face.corners);
  return mesh_of_corners(corners);
}

TriangleMesh SnappedFaces::mesh_of(std::span<const std::size_t> faces) const {
  std::vector<std::array<PointId, 3>> corners;
  corners.reserve(faces.size());
  for (const std::size_t face : faces) corners.push_back(faces_[face].corners);
  return mesh_of_corners(corners);
}

double SnappedFaces::largest_displacement() const {
  double largest = 0;
  for (const Face& face : faces_)
    for (const Vec3& displacement : face.displacements) largest = std::max(largest, length(displacement));
  return rounded_up(largest);
}

}  // namespace algebra3d
