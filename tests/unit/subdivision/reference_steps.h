#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"

/// One step of each scheme with rational numbers, straight from the papers' masks: lists of faces, maps and searches,
/// nothing of the code under test.
namespace algebra3d::reference {

inline RationalVec3 plus(const RationalVec3& a, const RationalVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline RationalVec3 times(const Rational& f, const RationalVec3& a) {
  return {f * a.x, f * a.y, f * a.z};
}

/// A sum of points with weights.
class Mask {
 public:
  Mask& add(const Rational& weight, const RationalVec3& point) {
    sum_ = plus(sum_, times(weight, point));
    return *this;
  }
  const RationalVec3& sum() const { return sum_; }

 private:
  RationalVec3 sum_;
};

struct Polygons {
  std::vector<RationalVec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
};

class Reference {
 public:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // of creases: the lower vertex first

  /// Sharpness above 0, infinite from 10 on.
  struct Creases {
    std::map<Edge, Rational> edges;
    std::map<std::uint32_t, Rational> vertices;
  };

  explicit Reference(const PolygonMesh& mesh) {
    for (const VertexId v : vertices(mesh)) in_.points.push_back(mesh.point(v).rational());
    for (const FaceId f : faces(mesh)) {
      auto& face = in_.faces.emplace_back();
      for (const VertexId v : vertices_of(mesh, f)) face.push_back(v.index());
    }
    for (std::uint32_t f = 0; f < in_.faces.size(); ++f) {
      const auto& face = in_.faces[f];
      for (std::uint32_t i = 0; i < face.size(); ++i) {
        const Edge directed{face[i], face[(i + 1) % face.size()]};
        left_[directed] = f;
        const Edge edge = std::minmax(directed.first, directed.second);
        if (numbers_.emplace(edge, edges_.size()).second) edges_.push_back(directed);
      }
    }
  }

  Polygons catmull_clark(const Creases& creases = {}) const {
    Polygons out;
    for (std::uint32_t v = 0; v < in_.points.size(); ++v)
      out.points.push_back(creased_vertex(v, creases, [&] { return catmull_clark_vertex(v); }));
    for (const Edge& e : edges_)
      out.points.push_back(creased_edge(e, creases, [&] {
        return Mask()
            .add({1, 4}, point(e.first))
            .add({1, 4}, point(e.second))
            .add({1, 4}, centre(left_.at(e)))
            .add({1, 4}, centre(left_.at(reversed(e))))
            .sum();
      }));
    for (std::uint32_t f = 0; f < in_.faces.size(); ++f) out.points.push_back(centre(f));
    for (std::uint32_t f = 0; f < in_.faces.size(); ++f) {
      const auto& face = in_.faces[f];
      for (std::size_t i = 0; i < face.size(); ++i)
        out.faces.push_back({face[i], edge_vertex(f, i),
                             static_cast<std::uint32_t>(in_.points.size() + edges_.size() + f),
                             edge_vertex(f, i + face.size() - 1)});
    }
    return out;
  }

  /// `weight(n)` is that of each of n neighbours.
  template <typename Weight>
  Polygons loop(const Weight& weight, const Creases& creases = {}) const {
    Polygons out;
    for (std::uint32_t v = 0; v < in_.points.size(); ++v)
      out.points.push_back(creased_vertex(v, creases, [&] {
        const auto around = neighbours(v);
        if (around.empty()) return point(v);
        const Rational w = weight(static_cast<std::int64_t>(around.size()));
        Mask mask;
        mask.add(Rational(1) - Rational(around.size()) * w, point(v));
        for (const std::uint32_t u : around) mask.add(w, point(u));
        return mask.sum();
      }));
    for (const Edge& e : edges_)
      out.points.push_back(creased_edge(e, creases, [&] {
        return Mask().add({3, 4}, middle(e)).add({1, 8}, point(third(e))).add({1, 8}, point(third(reversed(e)))).sum();
      }));
    split(out);
    return out;
  }

  Polygons butterfly(bool is_modified) const {
    Polygons out;
    out.points = in_.points;
    for (const Edge& e : edges_) {
      if (is_boundary(e)) {
        out.points.push_back(four_points(e));
        continue;
      }
      const bool first = is_modified && is_extraordinary(e.first), second = is_modified && is_extraordinary(e.second);
      if (first && second) {
        out.points.push_back(times({1, 2}, plus(extraordinary(e.first, e.second), extraordinary(e.second, e.first))));
      } else if (first) {
        out.points.push_back(extraordinary(e.first, e.second));
      } else if (second) {
        out.points.push_back(extraordinary(e.second, e.first));
      } else if (is_modified) {
        out.points.push_back(regular(e));
      } else {
        out.points.push_back(eight_points(e));
      }
    }
    split(out);
    return out;
  }

  /// A new corner is the mean of the corner, the middles of the edges beside it and that of the face.
  static Rational mean_weight(std::int64_t i, std::int64_t n) {
    return Rational(1, 4 * n) + (i == 0 ? Rational(1, 2) : i == 1 || i == n - 1 ? Rational(1, 8) : Rational(0));
  }
  /// Of faces with three, four or six corners, whose weights are rational.
  static Rational doo_weight(std::int64_t i, std::int64_t n) {
    return (i == 0 ? Rational(n + 5) : Rational(3) + Rational(2) * cosine(i, n)) / Rational(4 * n);
  }

  /// `weight(i, n)` is that of the corner i places on, of n.
  template <typename Weight>
  Polygons doo_sabin(const Weight& weight, bool has_boundary) const {
    Polygons out;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> corner_of;  // of face and vertex
    for (std::uint32_t f = 0; f < in_.faces.size(); ++f) {
      const auto& face = in_.faces[f];
      const auto n = static_cast<std::int64_t>(face.size());
      auto& corners = out.faces.emplace_back();
      for (std::int64_t i = 0; i < n; ++i) {
        Mask mask;
        for (std::int64_t j = 0; j < n; ++j)
          mask.add(weight((j - i + n) % n, n), point(face[static_cast<std::size_t>(j)]));
        corner_of[{f, face[static_cast<std::size_t>(i)]}] = static_cast<std::uint32_t>(out.points.size());
        corners.push_back(static_cast<std::uint32_t>(out.points.size()));
        out.points.push_back(mask.sum());
      }
    }
    std::map<Edge, std::uint32_t> on_edge;  // of a boundary edge, the new vertex near its first end
    if (has_boundary)
      for (const auto& face : in_.faces)
        for (std::size_t i = 0; i < face.size(); ++i) {
          const Edge e{face[i], face[(i + 1) % face.size()]};
          if (!is_boundary(e)) continue;
          for (const Edge& from : {e, reversed(e)}) {
            on_edge[from] = static_cast<std::uint32_t>(out.points.size());
            out.points.push_back(Mask().add({3, 4}, point(from.first)).add({1, 4}, point(from.second)).sum());
          }
        }
    for (const Edge& e : edges_) {
      const std::uint32_t f = left_.at(e);
      if (!is_boundary(e)) {
        const std::uint32_t g = left_.at(reversed(e));
        out.faces.push_back({corner_of.at({f, e.second}), corner_of.at({f, e.first}), corner_of.at({g, e.first}),
                             corner_of.at({g, e.second})});
      } else if (has_boundary) {
        out.faces.push_back(
            {corner_of.at({f, e.second}), corner_of.at({f, e.first}), on_edge.at(e), on_edge.at(reversed(e))});
      }
    }
    for (std::uint32_t v = 0; v < in_.points.size(); ++v) {
      const auto ends = boundary_neighbours(v);
      if (neighbours(v).empty() || (!ends.empty() && !has_boundary)) continue;
      auto& face = out.faces.emplace_back();
      if (ends.empty()) {
        for (const std::uint32_t u : ring(v, first_target(v))) face.push_back(corner_of.at({left_.at({v, u}), v}));
        continue;
      }
      const bool is_first_right = left_.contains({v, ends[0]});
      const std::uint32_t first = ends[is_first_right ? 0 : 1], last = ends[is_first_right ? 1 : 0];
      for (const std::uint32_t u : ring(v, first))
        if (left_.contains({v, u})) face.push_back(corner_of.at({left_.at({v, u}), v}));
      face.push_back(on_edge.at({v, last}));
      face.push_back(on_edge.at({v, first}));
    }
    return out;
  }

  /// cos(2 pi i / n) where it is rational.
  static Rational cosine(std::int64_t i, std::int64_t n) {
    switch (12 * i / n) {
      case 0:
        return 1;
      case 2:
      case 10:
        return {1, 2};
      case 3:
      case 9:
        return 0;
      case 4:
      case 8:
        return {-1, 2};
      default:
        return -1;
    }
  }

 private:
  static Edge reversed(const Edge& e) { return {e.second, e.first}; }
  const RationalVec3& point(std::uint32_t v) const { return in_.points[v]; }
  bool is_boundary(const Edge& e) const { return !left_.contains(e) || !left_.contains(reversed(e)); }
  RationalVec3 middle(const Edge& e) const { return times({1, 2}, plus(point(e.first), point(e.second))); }
  RationalVec3 centre(std::uint32_t f) const {
    Mask mask;
    for (const std::uint32_t v : in_.faces[f]) mask.add({1, static_cast<std::int64_t>(in_.faces[f].size())}, point(v));
    return mask.sum();
  }
  std::uint32_t edge_vertex(std::uint32_t f, std::size_t i) const {
    const auto& face = in_.faces[f];
    const Edge e = std::minmax(face[i % face.size()], face[(i + 1) % face.size()]);
    return static_cast<std::uint32_t>(in_.points.size() + numbers_.at(e));
  }
  std::set<std::uint32_t> neighbours(std::uint32_t v) const {
    std::set<std::uint32_t> result;
    for (const auto& [a, b] : edges_) {
      if (a == v) result.insert(b);
      if (b == v) result.insert(a);
    }
    return result;
  }
  std::vector<std::uint32_t> boundary_neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t u : neighbours(v))
      if (is_boundary({u, v})) result.push_back(u);
    return result;
  }
  /// The third corner of the triangle to the left of an edge.
  std::uint32_t third(const Edge& e) const {
    for (const std::uint32_t v : in_.faces[left_.at(e)])
      if (v != e.first && v != e.second) return v;
    return 0;
  }
  /// The target of the first half-edge that leaves v.
  std::uint32_t first_target(std::uint32_t v) const {
    for (const auto& face : in_.faces)
      for (std::size_t i = 0; i < face.size(); ++i)
        if (face[i] == v) return face[(i + 1) % face.size()];
    return 0;
  }
  /// The corner before v in the face to the left of v -> u.
  std::uint32_t before(std::uint32_t v, std::uint32_t u) const {
    const auto& face = in_.faces[left_.at({v, u})];
    const auto at = static_cast<std::size_t>(std::ranges::find(face, v) - face.begin());
    return face[(at + face.size() - 1) % face.size()];
  }
  /// The neighbours of v counter-clockwise from u, until there is no face or the circle closes.
  std::vector<std::uint32_t> ring(std::uint32_t v, std::uint32_t u) const {
    std::vector<std::uint32_t> result{u};
    while (left_.contains({v, result.back()})) {
      const std::uint32_t next = before(v, result.back());
      if (next == u) break;
      result.push_back(next);
    }
    return result;
  }

  void split(Polygons& out) const {
    for (std::uint32_t f = 0; f < in_.faces.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i)
        out.faces.push_back({in_.faces[f][i], edge_vertex(f, i), edge_vertex(f, i + 2)});
      out.faces.push_back({edge_vertex(f, 0), edge_vertex(f, 1), edge_vertex(f, 2)});
    }
  }

  Rational sharpness(const Edge& e, const Creases& creases) const {
    if (is_boundary(e)) return 10;
    const auto found = creases.edges.find(std::minmax(e.first, e.second));
    return found == creases.edges.end() ? Rational(0) : found->second;
  }
  template <typename Smooth>
  RationalVec3 creased_edge(const Edge& e, const Creases& creases, const Smooth& smooth) const {
    const Rational sharp = sharpness(e, creases);
    if (sharp >= Rational(1)) return middle(e);
    return plus(times(Rational(1) - sharp, smooth()), times(sharp, middle(e)));
  }
  /// By the rule for what is sharper than 0; if that for what is sharper than 1 is another one, between both, by the
  /// mean of the sharpnesses from 0 to 1.
  template <typename Smooth>
  RationalVec3 creased_vertex(std::uint32_t v, const Creases& creases, const Smooth& smooth) const {
    const Rational own = creases.vertices.contains(v) ? creases.vertices.at(v) : Rational(0);
    const auto count = [&](const Rational& limit) {
      std::vector<std::uint32_t> ends;
      for (const std::uint32_t u : neighbours(v))
        if (sharpness({v, u}, creases) > limit) ends.push_back(u);
      return ends;
    };
    const auto rule = [&](const Rational& limit) -> std::size_t {
      return own > limit ? 3 : std::min<std::size_t>(3, std::max<std::size_t>(1, count(limit).size()));
    };
    const auto by = [&](const Rational& limit) {
      const auto ends = count(limit);
      if (rule(limit) == 1) return smooth();
      if (rule(limit) == 3) return point(v);
      return Mask().add({3, 4}, point(v)).add({1, 8}, point(ends[0])).add({1, 8}, point(ends[1])).sum();
    };
    if (rule(0) == rule(1)) return by(0);
    std::vector<Rational> ending;
    for (const std::uint32_t u : neighbours(v)) ending.push_back(sharpness({v, u}, creases));
    ending.push_back(own);
    std::erase_if(ending, [](const Rational& s) { return s <= Rational(0) || s > Rational(1); });
    Rational sum = 0;
    for (const Rational& s : ending) sum = sum + s;
    const Rational share = sum / Rational(ending.size());
    return plus(times(share, by(0)), times(Rational(1) - share, by(1)));
  }

  RationalVec3 catmull_clark_vertex(std::uint32_t v) const {
    const auto around = neighbours(v);
    if (around.empty()) return point(v);
    Mask mask;
    const auto n = static_cast<std::int64_t>(around.size());
    for (const std::uint32_t u : around) {
      mask.add({1, n * n}, centre(left_.at({v, u})));
      mask.add({2, n * n}, middle({v, u}));
    }
    return mask.add({n - 3, n}, point(v)).sum();
  }

  RationalVec3 four_points(const Edge& e) const {
    Mask mask;
    mask.add({9, 8}, middle(e));
    for (const auto& [at, other] : {e, reversed(e)}) {
      // A triangle alone has one vertex beyond both ends.
      for (const std::uint32_t u : boundary_neighbours(at))
        if (u != other) mask.add({-1, 16}, point(u));
    }
    return mask.sum();
  }
  RationalVec3 across(const Edge& e) const {
    const Edge back = reversed(e);
    if (left_.contains(back)) return point(third(back));
    return plus(plus(point(e.first), point(e.second)), times(-1, point(third(e))));
  }
  RationalVec3 eight_points(const Edge& e) const {
    Mask mask;
    mask.add(1, middle(e));
    for (const Edge& side : {e, reversed(e)}) {
      const std::uint32_t c = third(side);
      mask.add({1, 8}, point(c));
      mask.add({-1, 16}, across({side.second, c})).add({-1, 16}, across({c, side.first}));
    }
    return mask.sum();
  }
  /// The four neighbours of a regular boundary vertex, counter-clockwise; empty inside.
  std::vector<std::uint32_t> half_ring(std::uint32_t v) const {
    for (const std::uint32_t u : boundary_neighbours(v))
      if (left_.contains({v, u})) return ring(v, u);
    return {};
  }
  /// The third corner of the triangle with corners a and b that has not c.
  std::uint32_t beyond(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return third({a, b}) == c ? third({b, a}) : third({a, b});
  }
  /// Modified Butterfly between regular vertices, by the table of [zorin2000], chapter 4.
  RationalVec3 regular(const Edge& e) const {
    auto [v, u] = e;
    if (half_ring(v).empty()) std::swap(u, v);
    const auto around = half_ring(v), other = half_ring(u);
    if (around.empty()) return eight_points(e);
    const bool is_first = around[1] == u;
    const std::uint32_t near = around[is_first ? 0 : 3], far = around[is_first ? 3 : 0],
                        inner = around[is_first ? 2 : 1];
    Mask mask;
    if (other.empty())
      return mask.add({3, 8}, point(v))
          .add({5, 8}, point(u))
          .add({1, 16}, point(near))
          .add({-1, 16}, point(far))
          .add({3, 16}, point(inner))
          .add({-1, 8}, point(beyond(u, inner, v)))
          .add({-1, 16}, point(beyond(u, near, v)))
          .sum();
    const bool is_first_of_other = other[1] == v;
    mask.add(1, middle(e));
    if (is_first == is_first_of_other) return mask.sum();
    return mask.add({1, 4}, point(inner))
        .add({-1, 8}, point(far))
        .add({-1, 8}, point(other[is_first_of_other ? 3 : 0]))
        .sum();
  }
  bool is_extraordinary(std::uint32_t v) const {
    return neighbours(v).size() != (boundary_neighbours(v).empty() ? 6U : 4U);
  }
  /// The mask of v on its edge to u. With three and four neighbours inside; with one and two triangles at the boundary.
  RationalVec3 extraordinary(std::uint32_t v, std::uint32_t u) const {
    Mask mask;
    if (!boundary_neighbours(v).empty()) return mask.add(1, middle({v, u})).sum();
    const auto around = ring(v, u);
    mask.add({3, 4}, point(v));
    std::vector<Rational> weights = {{5, 12}, {-1, 12}, {-1, 12}};
    if (around.size() == 4) weights = {{3, 8}, 0, {-1, 8}, 0};
    for (std::size_t i = 0; i < around.size(); ++i) mask.add(weights[i], point(around[i]));
    return mask.sum();
  }

  Polygons in_;
  std::map<Edge, std::uint32_t> left_;  // the face to the left of a directed edge
  std::map<Edge, std::size_t> numbers_;
  std::vector<Edge> edges_;  // as directed by the first face
};

}  // namespace algebra3d::reference
