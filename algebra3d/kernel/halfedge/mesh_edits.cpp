// The edits of MeshEditor.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/mesh_editor.h"

namespace algebra3d {
namespace {

/// The weights of a polygon's corners for a point inside it, not negative, with the sum 1 up to rounding. At a corner
/// and on a side of the polygon only those there count.
std::vector<double> mean_value_coordinates(const Vec3& point, const std::vector<Vec3>& corners) {
  const std::size_t n = corners.size();
  std::vector<double> weights(n), distances, tangents;  // of half the angles at which the sides are seen
  for (const Vec3& corner : corners) distances.push_back(length(corner - point));
  if (const auto at = std::ranges::find(distances, 0.0); at != distances.end()) {
    weights[static_cast<std::size_t>(at - distances.begin())] = 1;
    return weights;
  }
  const auto next = [n](std::size_t i) { return i + 1 == n ? 0 : i + 1; };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = corners[i] - point, b = corners[next(i)] - point;
    const double sine = length(cross(a, b)), cosine = dot(a, b);
    if (sine == 0 && cosine < 0) {  // on the side
      weights[i] = distances[next(i)] / (distances[i] + distances[next(i)]);
      weights[next(i)] = 1 - weights[i];
      return weights;
    }
    tangents.push_back(sine / (distances[i] * distances[next(i)] + cosine));
  }
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    weights[i] = (tangents[i] + tangents[i == 0 ? n - 1 : i - 1]) / distances[i];
    sum += weights[i];
  }
  const bool is_usable = std::isfinite(sum) && sum > 0;
  for (double& weight : weights) weight = is_usable ? weight / sum : 1.0 / static_cast<double>(n);
  return weights;
}

}  // namespace

Maybe<HalfedgeId> MeshEditor::flip_edge(HalfedgeId h) {
  const HalfedgeId o = opposite(h);
  if (is_boundary(h) || is_boundary(o)) return Undefined{"the edge is on the boundary"};
  if (face(h) == face(o)) return Undefined{"the same face is on both sides of the edge"};
  const HalfedgeId n = next(h), on = next(o);
  const VertexId a = origin(h), b = origin(o), c = target(n), d = target(on);
  for (const VertexId end : {a, b})
    if (valence(end) <= 2) return Undefined{fmt::format("vertex {} would be left with one edge", end.index())};
  if (c == d) return Undefined{"the edge would lead from a vertex to itself"};
  if (find(c, d).is_valid())
    return Undefined{fmt::format("an edge joins vertices {} and {} already", c.index(), d.index())};
  const HalfedgeId p = prev(h), op = prev(o), nn = next(n), onn = next(on);
  // Corners that a face keeps keep their sources; at its new corner it takes over that of the other face.
  const std::uint32_t corner_a = halfedges_[h.index()].corner, corner_b = halfedges_[o.index()].corner;
  halfedges_[h.index()].corner = halfedges_[onn.index()].corner;
  halfedges_[o.index()].corner = halfedges_[nn.index()].corner;
  halfedges_[on.index()].corner = corner_a;
  halfedges_[n.index()].corner = corner_b;
  halfedges_[h.index()].origin = d;
  halfedges_[o.index()].origin = c;
  halfedges_[n.index()].face = face(o);
  halfedges_[on.index()].face = face(h);
  connect(p, on);
  connect(on, h);
  connect(h, nn);
  connect(op, n);
  connect(n, o);
  connect(o, onn);
  faces_[face(h).index()] = h;
  faces_[face(o).index()] = o;
  settle(a, on);
  settle(b, n);
  return h;
}

/// Joins the target of `h` to the corner after the next one, if the face is a triangle with one corner too many.
void MeshEditor::cut_triangle(HalfedgeId h) {
  if (is_boundary(h) || degree(face(h)) != 4) return;
  (void)split_face(face(h), target(h), target(next(next(h))));
}

std::uint32_t MeshEditor::corner_between(HalfedgeId h, double share) {
  if (is_boundary(h)) return kNone;
  return blends_.halfedges.add_between(halfedges_[h.index()].corner, halfedges_[next(h).index()].corner, share);
}

VertexId MeshEditor::split_edge(HalfedgeId h, const ExactPoint& point) {
  const Vec3 from = points_[origin(h).index()].approx(), along = points_[target(h).index()].approx() - from;
  const double share = dot(point.approx() - from, along) / dot(along, along);
  // No number where the ends are one point.
  return split_edge(h, point, std::isnan(share) ? 0.5 : std::clamp(share, 0.0, 1.0));
}

VertexId MeshEditor::split_edge(HalfedgeId h, const ExactPoint& point, double share) {
  const std::uint32_t corner = corner_between(h, share), other_corner = corner_between(opposite(h), 1 - share);
  const HalfedgeId o = opposite(h), k = new_edge(), ko = opposite(k);
  const VertexId b = origin(o);
  const VertexId m = new_vertex(
      point, blends_.vertices.add_between(vertices_[origin(h).index()].source, vertices_[b.index()].source, share));
  const HalfedgeId after = next(h), before = prev(o);
  const bool is_triangle = !is_boundary(h) && degree(face(h)) == 3;
  const bool is_other_triangle = !is_boundary(o) && degree(face(o)) == 3;
  halfedges_[k.index()].origin = m;
  halfedges_[k.index()].face = face(h);
  halfedges_[k.index()].corner = corner;
  halfedges_[k.index()].along = halfedges_[h.index()].along;
  halfedges_[ko.index()].origin = b;
  halfedges_[ko.index()].face = face(o);
  halfedges_[ko.index()].corner = halfedges_[o.index()].corner;
  halfedges_[ko.index()].along = halfedges_[o.index()].along;
  halfedges_[o.index()].origin = m;
  halfedges_[o.index()].corner = other_corner;
  connect(h, k);
  if (after == o) {  // the edge ends in a face: both parts run round that end
    connect(k, ko);
  } else {
    connect(k, after);
    connect(before, ko);
  }
  connect(ko, o);
  settle(m, k);
  settle(b, ko);
  if (is_triangle) cut_triangle(h);
  if (is_other_triangle) cut_triangle(ko);
  return m;
}

Maybe<FaceId> MeshEditor::split_face(FaceId f, VertexId from, VertexId to) {
  HalfedgeId first, second;
  HalfedgeId h = halfedge(f);
  do {
    if (origin(h) == from && !first.is_valid()) first = h;
    if (origin(h) == to && !second.is_valid()) second = h;
    h = next(h);
  } while (h != halfedge(f));
  if (!first.is_valid() || !second.is_valid())
    return Undefined{
        fmt::format("vertex {} is not a corner of face {}", (first.is_valid() ? to : from).index(), f.index())};
  if (first == second) return Undefined{"both corners are the same"};
  if (next(first) == second || next(second) == first)
    return Undefined{fmt::format("vertices {} and {} are neighbours in the face", from.index(), to.index())};
  if (find(from, to).is_valid())
    return Undefined{fmt::format("an edge joins vertices {} and {} already", from.index(), to.index())};
  const HalfedgeId closing = new_edge(), other = opposite(closing);
  halfedges_[closing.index()].origin = to;
  halfedges_[closing.index()].corner = halfedges_[second.index()].corner;
  halfedges_[other.index()].origin = from;
  halfedges_[other.index()].corner = halfedges_[first.index()].corner;
  connect(prev(first), other);
  connect(prev(second), closing);
  connect(other, second);
  connect(closing, first);
  const FaceId added = new_face(second, f);
  for (h = second; !(face(h) == added); h = next(h)) halfedges_[h.index()].face = added;
  halfedges_[closing.index()].face = f;
  faces_[f.index()] = first;
  return added;
}

std::vector<HalfedgeId> MeshEditor::halfedges_around(FaceId f) const {
  std::vector<HalfedgeId> around{halfedge(f)};
  for (HalfedgeId h = next(around.front()); h != around.front(); h = next(h)) around.push_back(h);
  return around;
}

Maybe<VertexId> MeshEditor::split_face(FaceId f, const ExactPoint& point) {
  const std::vector<HalfedgeId> around = halfedges_around(f);
  std::vector<VertexId> corners;
  std::vector<Vec3> places;
  for (const HalfedgeId h : around) {
    corners.push_back(origin(h));
    places.push_back(points_[origin(h).index()].approx());
  }
  std::ranges::sort(corners);
  if (const auto twice = std::ranges::adjacent_find(corners); twice != corners.end())
    return Undefined{fmt::format("vertex {} is two corners of face {}", twice->index(), f.index())};
  const std::vector<double> weights = mean_value_coordinates(point.approx(), places);
  std::vector<ValueBlends::Term> of_vertices, of_corners;
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    of_vertices.push_back({vertices_[origin(around[i]).index()].source, weights[i]});
    of_corners.push_back({halfedges_[around[i].index()].corner, weights[i]});
  }
  const VertexId added = new_vertex(point, blends_.vertices.add(of_vertices));
  const std::uint32_t corner = blends_.halfedges.add(of_corners);
  // From each corner to the new vertex.
  std::vector<HalfedgeId> spokes;
  for (const HalfedgeId h : around) {
    const HalfedgeId spoke = spokes.emplace_back(new_edge()), back = opposite(spoke);
    halfedges_[spoke.index()].origin = origin(h);
    halfedges_[spoke.index()].corner = halfedges_[h.index()].corner;
    halfedges_[back.index()].origin = added;
    halfedges_[back.index()].corner = corner;
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    const HalfedgeId h = around[i], leaving = spokes[i + 1 == around.size() ? 0 : i + 1], back = opposite(spokes[i]);
    connect(h, leaving);
    connect(leaving, back);
    connect(back, h);
    const FaceId part = i == 0 ? f : new_face(h, f);
    for (const HalfedgeId side : {h, leaving, back}) halfedges_[side.index()].face = part;
    faces_[part.index()] = h;
  }
  vertices_[added.index()].outgoing = opposite(spokes.front());
  return added;
}

Maybe<VertexId> MeshEditor::split_vertex(VertexId v, HalfedgeId first, HalfedgeId last, const ExactPoint& point) {
  for (const HalfedgeId h : {first, last})
    if (origin(h) != v) return Undefined{fmt::format("an edge does not begin at vertex {}", v.index())};
  if (first == last) return Undefined{"both edges are the same"};
  const VertexId added = new_vertex(point, vertices_[v.index()].source);
  const HalfedgeId out = new_edge(), back = opposite(out);  // v -> added, added -> v
  const HalfedgeId to_first = opposite(first), to_last = opposite(last);
  const HalfedgeId after_first = next(to_first), after_last = next(to_last);
  const auto is_triangle = [&](HalfedgeId h) { return !is_boundary(h) && degree(face(h)) == 3; };
  const bool divides_first = is_triangle(to_first), divides_last = is_triangle(to_last);
  for (HalfedgeId h = first; h != last; h = opposite(prev(h))) halfedges_[h.index()].origin = added;
  halfedges_[out.index()].origin = v;
  halfedges_[out.index()].face = face(to_last);
  halfedges_[out.index()].corner = halfedges_[after_last.index()].corner;
  halfedges_[back.index()].origin = added;
  halfedges_[back.index()].face = face(to_first);
  halfedges_[back.index()].corner = halfedges_[after_first.index()].corner;
  connect(to_first, back);
  connect(back, after_first);
  connect(to_last, out);
  connect(out, after_last);
  settle(v, last);
  settle(added, first);
  if (divides_first) (void)split_face(face(to_first), origin(to_first), v);
  if (divides_last) (void)split_face(face(to_last), origin(to_last), added);
  return added;
}

/// The reason why the triangle of `h` must not vanish; empty if it may, or if there is no triangle.
std::string MeshEditor::wing_violation(HalfedgeId h) const {
  if (is_boundary(h) || degree(face(h)) != 3) return {};
  const HalfedgeId n = next(h), p = prev(h);
  const VertexId c = origin(p);
  if (valence(c) <= 2) return fmt::format("vertex {} would be left with one edge", c.index());
  const HalfedgeId left = opposite(p), right = opposite(n);
  const bool are_triangles =
      !is_boundary(left) && !is_boundary(right) && degree(face(left)) == 3 && degree(face(right)) == 3;
  if (are_triangles && valence(c) == 3 && opposite(next(left)) == prev(right))
    return "two triangles with the same corners would be left";
  return {};
}

std::vector<VertexId> MeshEditor::neighbours(VertexId v) const {
  std::vector<VertexId> found;
  HalfedgeId h = outgoing(v);
  do {
    found.push_back(target(h));
    h = opposite(prev(h));
  } while (h != outgoing(v));
  std::ranges::sort(found);
  return found;
}

std::string MeshEditor::link_violation(HalfedgeId h) const {
  const HalfedgeId o = opposite(h);
  const VertexId a = origin(h), b = origin(o);
  const bool is_inside = !is_boundary(h) && !is_boundary(o);
  if (is_inside && is_boundary(outgoing(a)) && is_boundary(outgoing(b)))
    return "the edge is inside, and both ends are on the boundary";
  if (face(h) == face(o)) return "the same face is on both sides of the edge";
  std::vector<VertexId> thirds;  // corners of triangles along the edge
  for (const HalfedgeId side : {h, o}) {
    if (std::string found = wing_violation(side); !found.empty()) return found;
    if (!is_boundary(side) && degree(face(side)) == 3) thirds.push_back(origin(prev(side)));
  }
  const std::vector<VertexId> of_a = neighbours(a), of_b = neighbours(b);
  if (of_a.size() + of_b.size() < 4 + thirds.size())
    return fmt::format("vertex {} would be left with one edge", a.index());
  std::vector<VertexId> common;
  std::ranges::set_intersection(of_a, of_b, std::back_inserter(common));
  for (const VertexId v : common)
    if (std::ranges::find(thirds, v) == thirds.end())
      return fmt::format("vertex {} is joined to both ends, and not by a triangle along the edge", v.index());
  return {};
}

/// Removes the face of `h`, which has two edges: the one of `h` goes, the other one stays.
void MeshEditor::remove_digon(HalfedgeId h) {
  const HalfedgeId stays = next(h), o = opposite(h);
  const VertexId a = origin(h), c = origin(stays);
  free_faces_.push_back(face(h));
  faces_[face(h).index()] = {};
  // In place of the other half-edge of the edge that goes.
  connect(prev(o), stays);
  connect(stays, next(o));
  halfedges_[stays.index()].face = face(o);
  halfedges_[stays.index()].corner = halfedges_[o.index()].corner;
  if (face(o).is_valid() && faces_[face(o).index()] == o) faces_[face(o).index()] = stays;
  free_edge(h);
  settle(a, opposite(stays));
  settle(c, stays);
}

Maybe<VertexId> MeshEditor::collapse_edge(HalfedgeId h) {
  if (std::string reason = link_violation(h); !reason.empty()) return Undefined{std::move(reason)};
  const HalfedgeId o = opposite(h), n = next(h), on = next(o);
  const VertexId a = origin(h), b = origin(o);
  const bool is_triangle = !is_boundary(h) && degree(face(h)) == 3;
  const bool is_other_triangle = !is_boundary(o) && degree(face(o)) == 3;
  for (HalfedgeId g = opposite(prev(o)); g != o; g = opposite(prev(g))) halfedges_[g.index()].origin = a;
  for (const HalfedgeId side : {h, o}) {
    connect(prev(side), next(side));
    if (face(side).is_valid() && faces_[face(side).index()] == side) faces_[face(side).index()] = next(side);
  }
  free_edge(h);
  vertices_[b.index()] = {{}, false};
  free_vertices_.push_back(b);
  settle(a, n);
  if (is_triangle) remove_digon(n);
  if (is_other_triangle) {
    // The edge of `a` goes here, that of `b` stays; their attributes the other way round.
    const HalfedgeId stays = next(on);
    halfedges_[stays.index()].along = halfedges_[opposite(stays).index()].along = halfedges_[on.index()].along;
    remove_digon(on);
  }
  return a;
}

}  // namespace algebra3d
