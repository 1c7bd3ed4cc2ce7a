#include "algebra3d/kernel/rounding/detail/snapped_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "algebra3d/kernel/distance/distance_bound.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

bool repeats_a_corner(const std::array<PointId, 3>& corners) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

bool has_corner(const std::array<PointId, 3>& corners, PointId p) {
  return std::ranges::find(corners, p) != corners.end();
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
    const Corners corners = {points[VertexId(a)], points[VertexId(b)], points[VertexId(c)]};
    if (!repeats_a_corner(corners)) faces_.push_back({corners, {}, 0, true, true});
  }
  drop_folded_given();
  ties_ = DisjointIds<PointId>(table_.size());
  faces_at_.resize(table_.size());
  size_ = given_count_ = faces_.size();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    faces_[f].given = f;
    open_.push_back(f);
    list_at_corners(f);
  }
}

std::vector<std::size_t> SnappedFaces::faces() const {
  std::vector<std::size_t> there;
  there.reserve(size_);
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (faces_[f].is_there) there.push_back(f);
  return there;
}

PointId SnappedFaces::add_point(const Vec3& place) {
  const PointId point(table_.intern(PointRef(place)));
  if (point.index() == ties_.size()) {
    ties_.add();
    faces_at_.push_back({});
  }
  return point;
}

TriangleRef SnappedFaces::triangle(std::size_t face) const {
  const auto& [a, b, c] = faces_[face].corners;
  return {point(a), point(b), point(c)};
}

void SnappedFaces::close_all_but(std::vector<std::size_t> faces) {
  for (const std::size_t face : open_) faces_[face].is_open = false;
  for (const std::size_t face : faces) faces_[face].is_open = true;
  open_ = std::move(faces);
  tidy_lists();
}

/// The faces at a point.
std::vector<std::size_t>& SnappedFaces::faces_at(PointId point) {
  std::vector<std::size_t>& faces = faces_at_[point];
  std::erase_if(faces, [&](std::size_t f) { return !faces_[f].is_there; });
  return faces;
}

/// The faces with an edge.
std::vector<std::size_t> SnappedFaces::faces_along(const PointPair& edge) {
  std::vector<std::size_t> faces = faces_at(edge.first);
  std::erase_if(faces, [&](std::size_t f) { return !has_corner(faces_[f].corners, edge.second); });
  return faces;
}

void SnappedFaces::list_at_corners(std::size_t face) {
  for (const PointId corner : faces_[face].corners) faces_at_[corner].push_back(face);
}

/// Adds a part of a given face, unless it repeats a corner.
void SnappedFaces::add(const Face& face) {
  tie_to_given(face);
  if (repeats_a_corner(face.corners)) return;
  const std::size_t number = faces_.size();
  faces_.push_back(face);
  open_.push_back(number);
  changed_.push_back(number);
  list_at_corners(number);
  ++size_;
  fold(number);
}

/// Puts a given face back that is not there.
void SnappedFaces::put_back(std::size_t given) {
  for (const PointId corner : faces_[given].corners) faces_at(corner);  // it is listed at none of them any more
  faces_[given].is_there = faces_[given].is_open = true;
  open_.push_back(given);
  list_at_corners(given);
  ++size_;
  fold(given);
}

void SnappedFaces::take_away(std::size_t face) {
  faces_[face].is_there = false;
  --size_;
  if (is_given(face)) gone_.push_back(face);
}

/// The rule for a face, and those that are there already with the same corners.
void SnappedFaces::fold(std::size_t face) {
  const auto [corners, is_odd] = sorted(faces_[face].corners);
  const PointId corner = std::ranges::min(corners, {}, [&](PointId p) { return faces_at_[p].size(); });
  for (const std::size_t other : faces_at(corner)) {
    if (other == face) continue;
    const auto [other_corners, other_is_odd] = sorted(faces_[other].corners);
    if (other_corners != corners || (folded_ == Folded::vanishes && other_is_odd == is_odd)) continue;
    for (const std::size_t f : {face, other}) tie_to_given(faces_[f]);
    take_away(face);
    if (folded_ == Folded::vanishes) take_away(other);
    return;
  }
}

/// Leaves out what is not so any more.
void SnappedFaces::tidy_lists() {
  std::erase_if(open_, [&](std::size_t f) { return !faces_[f].is_there || !faces_[f].is_open; });
  std::erase_if(changed_, [&](std::size_t f) { return !faces_[f].is_there; });
  std::erase_if(gone_, [&](std::size_t f) { return faces_[f].is_there; });
  for (std::vector<std::size_t>* faces : {&open_, &gone_}) {
    std::ranges::sort(*faces);
    faces->erase(std::unique(faces->begin(), faces->end()), faces->end());
  }
}

SnappedFaces::Face SnappedFaces::part_of(std::size_t given, const Corner& a, const Corner& b, const Corner& c) {
  return {{a.point, b.point, c.point}, {a.displacement, b.displacement, c.displacement}, given, true, true};
}

void SnappedFaces::tie_to_given(const Face& face) {
  for (const PointId corner : faces_[face.given].corners) ties_.unite(corner, face.corners[0]);
  for (const PointId corner : face.corners) ties_.unite(corner, face.corners[0]);
}

Status SnappedFaces::merge(FeatureJoins& joins, const Monitor& monitor) {
  DisjointIds<PointId> sets(table_.size());
  for (const auto& [a, b] : joins.merged) sets.unite(a, b);
  std::vector<std::size_t> changing;
  for (const auto& [a, b] : joins.merged)
    for (const PointId point : {a, b}) {
      if (sets.find(point) == point) continue;
      const std::vector<std::size_t>& at_point = faces_at(point);
      changing.insert(changing.end(), at_point.begin(), at_point.end());
    }
  std::ranges::sort(changing);
  changing.erase(std::unique(changing.begin(), changing.end()), changing.end());
  for (const std::size_t f : changing) {
    A3D_TRY(monitor.check());
    Face face = faces_[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const PointId old = face.corners[i], merged = sets.find(old);
      face.displacements[i] = face.displacements[i] + (place(merged) - place(old)).rounded();
      face.corners[i] = merged;
    }
    face.is_open = true;
    take_away(f);
    add(face);
  }
  std::map<PointPair, std::vector<PointId>> led;
  for (const auto& [edge, points] : joins.led)
    for (const PointId p : points) led[ordered(sets.find(edge.first), sets.find(edge.second))].push_back(sets.find(p));
  joins.led = std::move(led);
  for (auto& [face, p] : joins.divided) p = sets.find(p);
  return {};
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

/// The corners of a face and those through which its edges are led, in order, also as an outline.
SnappedFaces::Chain SnappedFaces::outline(const Face& face, const FeatureJoins& joins,
                                          std::vector<OutlineCorner>& outline) const {
  Chain corners;
  for (unsigned side = 0; side < 3; ++side) {
    const Chain along = chain(corner(face, side), corner(face, (side + 1) % 3), joins);
    for (std::size_t i = 0; i + 1 < along.size(); ++i) {
      const unsigned sides = (1U << side) | (i == 0 ? 1U << ((side + 2) % 3) : 0U);
      outline.push_back({along[i].point, place(along[i].point), static_cast<std::uint8_t>(sides)});
      corners.push_back(along[i]);
    }
  }
  return corners;
}

/// The chords of an outline that are edges of faces already, or links of edges that are led; ascending by their points.
std::vector<OutlineChord> SnappedFaces::edges_across(std::span<const OutlineCorner> outline, const FeatureJoins& joins,
                                                     const std::vector<PointPair>& links) {
  std::vector<std::pair<PointId, std::uint32_t>> positions;
  for (std::uint32_t i = 0; i < outline.size(); ++i) positions.emplace_back(outline[i].point, i);
  std::ranges::sort(positions);
  std::vector<std::pair<PointPair, OutlineChord>> found;
  const auto add = [&](std::uint32_t from, PointId to) {
    const PointId point = outline[from].point;
    if (to < point) return;  // found from there
    for (auto at = std::ranges::lower_bound(positions, std::pair(to, 0U)); at != positions.end() && at->first == to;
         ++at)
      if ((outline[from].sides & outline[at->second].sides) == 0) found.push_back({{point, to}, {from, at->second}});
  };
  for (std::uint32_t i = 0; i < outline.size(); ++i) {
    const PointId p = outline[i].point;
    for (auto link = std::ranges::lower_bound(links, PointPair(p, PointId(0))); link != links.end() && link->first == p;
         ++link)
      add(i, link->second);
    for (const std::size_t face : faces_at(p))
      for (const PointId q : faces_[face].corners)
        if (q != p && !joins.led.contains(ordered(p, q))) add(i, q);
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<OutlineChord> chords;
  chords.reserve(found.size());
  for (const auto& [points, chord] : found) chords.push_back(chord);
  return chords;
}

/// Divides a face with the points through which its edges are led.
void SnappedFaces::divide_along_sides(std::size_t face, const FeatureJoins& joins, const std::vector<PointPair>& links,
                                      std::vector<Face>& parts) {
  std::vector<OutlineCorner> outline;
  const Chain corners = this->outline(faces_[face], joins, outline);
  const std::size_t given = faces_[face].given;
  for (const Corner& corner : corners) ties_.unite(corner.point, faces_[given].corners[0]);  // even if no part is left
  for (const auto& [a, b, c] : divided_outline(outline, edges_across(outline, joins, links)))
    parts.push_back(part_of(given, corners[a], corners[b], corners[c]));
}

/// Leads edges, in all faces along them.
Status SnappedFaces::lead(FeatureJoins& joins, const Monitor& monitor) {
  for (auto& [edge, points] : joins.led) sort_along(edge, points);
  std::erase_if(joins.led, [](const auto& led) { return led.second.empty() || led.first.first == led.first.second; });
  std::vector<std::size_t> changing;
  std::vector<PointPair> links;  // in both directions
  for (const auto& [edge, points] : joins.led) {
    A3D_TRY(monitor.check());
    const std::vector<std::size_t> along = faces_along(edge);
    changing.insert(changing.end(), along.begin(), along.end());
    PointId from = edge.first;
    const auto add_link = [&](PointId to) {
      links.insert(links.end(), {{from, to}, {to, from}});
      from = to;
    };
    for (const PointId point : points) add_link(point);
    add_link(edge.second);
  }
  std::ranges::sort(links);
  std::ranges::sort(changing);
  changing.erase(std::unique(changing.begin(), changing.end()), changing.end());
  std::vector<Face> parts;
  for (const std::size_t face : changing) {
    A3D_TRY(monitor.check());
    divide_along_sides(face, joins, links, parts);
  }
  for (const std::size_t face : changing) take_away(face);
  for (const Face& part : parts) {
    A3D_TRY(monitor.check());
    add(part);
  }
  return {};
}

/// Divides a face in three.
void SnappedFaces::divide(std::size_t face, PointId point) {
  const Face old = faces_[face];
  const Corner inner = corner_in_face(point, old);
  take_away(face);
  for (std::size_t i = 0; i < 3; ++i) add(part_of(old.given, corner(old, i), corner(old, (i + 1) % 3), inner));
}

Status SnappedFaces::apply(FeatureJoins joins, const Monitor& monitor) {
  if (!joins.merged.empty()) A3D_TRY(merge(joins, monitor));
  A3D_TRY(lead(joins, monitor));
  for (const auto& [face, point] : joins.divided) {
    A3D_TRY(monitor.check());
    if (faces_[face].is_there) divide(face, point);
  }
  tidy_lists();
  return {};
}

void SnappedFaces::restore(std::span<const PointId> clusters) {
  if (clusters.empty()) return;
  const auto is_restored = [&](std::size_t given) {
    return std::ranges::binary_search(clusters, cluster_of(faces_[given].corners[0]));
  };
  std::vector<std::size_t> restored = gone_;
  std::erase_if(restored, [&](std::size_t given) { return !is_restored(given); });
  for (const std::size_t face : changed_)
    if (is_restored(faces_[face].given)) take_away(face);
  for (const std::size_t given : restored) put_back(given);
  tidy_lists();
}

void SnappedFaces::untie(std::span<const PointId> clusters) {
  DisjointIds<PointId> ties(table_.size());
  for (std::size_t p = 0; p < table_.size(); ++p)
    if (const PointId cluster = cluster_of(PointId(p)); !std::ranges::binary_search(clusters, cluster))
      ties.unite(PointId(p), cluster);
  ties_ = std::move(ties);
}

/// Removes given faces that lie upon each other; called before any face is listed.
void SnappedFaces::drop_folded_given() {
  struct Key {
    Corners corners;
    std::size_t face;
    bool is_odd;
  };
  std::vector<Key> keys;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto [corners, is_odd] = sorted(faces_[f].corners);
    keys.push_back({corners, f, is_odd});
  }
  std::ranges::sort(keys, {}, [](const Key& key) { return std::tuple(key.corners, key.face); });
  std::vector<const Key*> unpaired;  // with the same corners
  for (const Key& key : keys) {
    if (!unpaired.empty() && unpaired.back()->corners != key.corners) unpaired.clear();
    const bool is_pair = !unpaired.empty() && (folded_ == Folded::stays || unpaired.back()->is_odd != key.is_odd);
    if (!is_pair) {
      unpaired.push_back(&key);
      continue;
    }
    faces_[key.face].is_there = false;
    if (folded_ == Folded::stays) continue;
    faces_[unpaired.back()->face].is_there = false;
    unpaired.pop_back();
  }
  std::erase_if(faces_, [](const Face& face) { return !face.is_there; });
}

TriangleMesh SnappedFaces::mesh_of(std::span<const std::size_t> faces) const {
  PointArray points;
  IdVector<PointId, std::uint32_t> numbers(table_.size(), kNone);
  std::vector<IndexTriangle> triangles;
  triangles.reserve(faces.size());
  for (const std::size_t face : faces) {
    IndexTriangle& triangle = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const PointId corner = faces_[face].corners[i];
      std::uint32_t& number = numbers[corner];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(points.size());
        points.push_back(point(corner));
      }
      triangle[i] = number;
    }
  }
  return {std::move(points), triangles};
}

TriangleMesh SnappedFaces::given_mesh() const {
  std::vector<std::size_t> given(given_count_);
  std::iota(given.begin(), given.end(), std::size_t{0});
  return mesh_of(given);
}

double SnappedFaces::largest_displacement(const Face& face) {
  double largest = 0;
  for (const Vec3& displacement : face.displacements) largest = std::max(largest, length(displacement));
  return rounded_up(largest);
}

double SnappedFaces::largest_displacement() const {
  double largest = 0;
  for (const std::size_t face : changed_) largest = std::max(largest, largest_displacement(faces_[face]));
  return largest;
}

Result<double> SnappedFaces::largest_distance(double enough, const Monitor& monitor) const {
  const double displacement = largest_displacement();
  if (displacement <= enough) return displacement;
  std::vector<BoundedFace> faces;
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const Face& face = faces_[changed_[i]];
    faces.push_back({FaceId(i), largest_displacement(face), FaceId(face.given)});
  }
  const TriangleMesh given = given_mesh();
  const BoxHierarchy hierarchy(given);
  return bounded_distance(mesh_of(changed_), faces, {&given, &hierarchy}, enough, monitor);
}

}  // namespace algebra3d
