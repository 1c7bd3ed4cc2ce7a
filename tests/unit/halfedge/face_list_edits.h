#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace algebra3d {

/// A manifold mesh as the lists of its faces' corners, with the edits of MeshEditor: an oracle without half-edges,
/// which asks all faces for everything. A face may have an edge on both sides, and so a vertex several times.
class FaceLists {
 public:
  using Vertex = std::uint32_t;
  using Face = std::vector<Vertex>;
  /// A corner of a face.
  struct Place {
    std::size_t face, corner;
  };

  explicit FaceLists(std::vector<Face> faces) : faces_(std::move(faces)) {}

  /// Each face from its least turn, ascending: the order of faces and of the corners' numbers does not count.
  std::vector<Face> canonical() const {
    std::vector<Face> result;
    for (const Face& face : faces_) {
      Face least = face, turned = face;
      for (std::size_t i = 1; i < face.size(); ++i) {
        std::ranges::rotate(turned, turned.begin() + 1);
        least = std::min(least, turned);
      }
      result.push_back(std::move(least));
    }
    std::ranges::sort(result);
    return result;
  }

  bool are_joined(Vertex a, Vertex b) const { return side(a, b) || side(b, a); }
  std::set<Vertex> neighbours(Vertex v) const {
    std::set<Vertex> found;
    for (const Face& face : faces_)
      for (std::size_t i = 0; i < face.size(); ++i)
        if (face[i] == v) found.insert({after(face, i), before(face, i)});
    return found;
  }

  bool flip(Vertex a, Vertex b) {
    const auto h = side(a, b), o = side(b, a);
    if (!h || !o || h->face == o->face) return false;
    const Vertex c = at(h->face, h->corner + 2), d = at(o->face, o->corner + 2);
    if (neighbours(a).size() <= 2 || neighbours(b).size() <= 2 || c == d || are_joined(c, d)) return false;
    at(h->face, h->corner + 1) = d;
    at(o->face, o->corner + 1) = c;
    return true;
  }

  void split_edge(Vertex a, Vertex b, Vertex added) {
    std::vector<std::pair<std::size_t, Vertex>> triangles;  // along the edge, with the third corners
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const auto h = side(from, to);
      if (!h) continue;
      Face& face = faces_[h->face];
      if (face.size() == 3) triangles.emplace_back(h->face, at(h->face, h->corner + 2));
      face.insert(face.begin() + static_cast<std::ptrdiff_t>(h->corner) + 1, added);
    }
    for (const auto& [face, third] : triangles)
      if (!are_joined(added, third)) (void)split_face(face, added, third);
  }

  bool split_face(std::size_t f, Vertex from, Vertex to) {
    const Face face = faces_[f];
    const auto first = std::ranges::find(face, from), second = std::ranges::find(face, to);
    if (first == face.end() || second == face.end() || first == second || are_joined(from, to)) return false;
    const auto part = [&](auto begin, auto end) {  // with both ends
      Face result;
      for (auto i = begin;; i = i + 1 == face.end() ? face.begin() : i + 1) {
        result.push_back(*i);
        if (i == end) return result;
      }
    };
    faces_[f] = part(first, second);
    faces_.push_back(part(second, first));
    return true;
  }

  bool split_vertex(Vertex v, Vertex first, Vertex last, Vertex added) {
    if (first == last) return false;
    std::set<Vertex> moved;
    for (Vertex at = first; at != last; at = following(v, at)) moved.insert(at);
    bool divides_first = false, divides_last = false;  // the face to the right of that edge was a triangle
    for (Face& face : faces_) {
      Face changed;
      for (std::size_t i = 0; i < face.size(); ++i) {
        const bool is_moved = face[i] == v && moved.contains(after(face, i));
        if (face[i] == v && before(face, i) == first) {
          changed.insert(changed.end(), {added, v});
          divides_first = face.size() == 3;
        } else if (face[i] == v && before(face, i) == last) {
          changed.insert(changed.end(), {v, added});
          divides_last = face.size() == 3;
        } else {
          changed.push_back(is_moved ? added : face[i]);
        }
      }
      face = std::move(changed);
    }
    if (divides_first) (void)split_face(face_along(added, v), first, v);
    if (divides_last) (void)split_face(face_along(v, added), last, added);
    return true;
  }

  bool collapse(Vertex a, Vertex b) {
    if (!may_collapse(a, b)) return false;
    for (Face& face : faces_) {
      Face changed;
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Vertex next = after(face, i);
        const bool is_edge = (face[i] == a && next == b) || (face[i] == b && next == a);
        if (!is_edge) changed.push_back(face[i] == b ? a : face[i]);
      }
      face = std::move(changed);
    }
    std::erase_if(faces_, [](const Face& face) { return face.size() < 3; });
    return true;
  }

  const std::vector<Face>& faces() const { return faces_; }

 private:
  /// The face that has an edge from one vertex to another.
  std::size_t face_along(Vertex from, Vertex to) const {
    const auto has_edge = [&](const Face& face) {
      for (std::size_t i = 0; i < face.size(); ++i)
        if (face[i] == from && after(face, i) == to) return true;
      return false;
    };
    return static_cast<std::size_t>(std::ranges::find_if(faces_, has_edge) - faces_.begin());
  }
  static Vertex after(const Face& face, std::size_t i) { return face[(i + 1) % face.size()]; }
  static Vertex before(const Face& face, std::size_t i) { return face[(i + face.size() - 1) % face.size()]; }
  Vertex& at(std::size_t face, std::size_t corner) { return faces_[face][corner % faces_[face].size()]; }

  /// The corner from which a face goes from one vertex to another.
  std::optional<Place> side(Vertex from, Vertex to) const {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t i = 0; i < faces_[f].size(); ++i)
        if (faces_[f][i] == from && after(faces_[f], i) == to) return Place{f, i};
    return std::nullopt;
  }
  bool is_on_boundary(Vertex v) const {
    return std::ranges::any_of(neighbours(v), [&](Vertex other) { return !side(v, other) || !side(other, v); });
  }

  /// The neighbour of v that follows one counter-clockwise; across the gap if v is on the boundary.
  Vertex following(Vertex v, Vertex neighbour) const {
    if (const auto place = side(v, neighbour)) return before(faces_[place->face], place->corner);
    for (const Vertex other : neighbours(v))
      if (!side(other, v)) return other;
    return v;
  }

  /// The link condition, and that no vertex is left with one edge.
  bool may_collapse(Vertex a, Vertex b) const {
    const auto h = side(a, b), o = side(b, a);
    if (h && o && (h->face == o->face || (is_on_boundary(a) && is_on_boundary(b)))) return false;
    std::set<Vertex> thirds;
    std::size_t triangles = 0;
    for (const auto& place : {h, o}) {
      if (!place || faces_[place->face].size() != 3) continue;
      const Face& face = faces_[place->face];
      thirds.insert(face[(place->corner + 2) % 3]);
      ++triangles;
    }
    const std::set<Vertex> of_a = neighbours(a), of_b = neighbours(b);
    for (const Vertex v : of_a)
      if (of_b.contains(v) && !thirds.contains(v)) return false;
    for (const Vertex v : thirds)
      if (neighbours(v).size() <= 2 || is_shared_triangle(a, b, v)) return false;
    return of_a.size() + of_b.size() >= 4 + triangles;
  }

  /// True if the triangle with the third corner has two triangles beside it that would have the same corners.
  bool is_shared_triangle(Vertex a, Vertex b, Vertex third) const {
    if (neighbours(third).size() != 3) return false;
    std::vector<Face> beside;
    for (const Face& face : faces_) {
      const auto has = [&](Vertex v) { return std::ranges::find(face, v) != face.end(); };
      if (face.size() == 3 && has(third) && has(a) != has(b)) beside.push_back(face);
    }
    return beside.size() == 2;
  }

  std::vector<Face> faces_;
};

}  // namespace algebra3d
