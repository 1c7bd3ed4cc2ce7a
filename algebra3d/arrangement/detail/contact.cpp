#include "algebra3d/arrangement/detail/contact.h"

#include <cassert>
#include <optional>

namespace algebra3d::arrangement {
namespace {

using Signs = std::array<int, 3>;

/// On which side of the other one's plane the corners lie.
Signs sides_of(const TriangleRef& triangle, const PlaneTriangle& other) {
  return other.plane == nullptr ? sides_of_plane(other.corners, triangle) : other.plane->sides(triangle);
}

bool are_all_on_one_side(const Signs& signs) {
  return signs[0] != 0 && signs[0] == signs[1] && signs[0] == signs[2];
}

/// The place that three signs say, which are positive inside of the edges and zero on them.
std::optional<Place> place_of(const Signs& inside) {
  int zeros = 0;
  std::uint8_t last_zero = 0, other = 0;
  for (std::uint8_t j = 0; j < 3; ++j) {
    if (inside[j] < 0) return std::nullopt;
    if (inside[j] == 0) {
      ++zeros;
      last_zero = j;
    } else {
      other = j;
    }
  }
  if (zeros == 0) return Place{};
  if (zeros == 1) return Place{Place::Kind::edge, last_zero};
  return Place{Place::Kind::corner, static_cast<std::uint8_t>((other + 2) % 3)};  // opposite to edge `other`
}

/// Place in `target` of the point in which an edge crosses its plane, coming from the side `side` of it.
std::optional<Place> locate_crossing(const InputEdgeEnds& edge, int side, const PlaneTriangle& target,
                                     EdgeSides& edge_sides) {
  Signs inside{};
  for (std::size_t j = 0; j < 3; ++j) {
    inside[j] = -side * edge_sides.side(edge, target.edge(j));
    if (inside[j] < 0) return std::nullopt;
  }
  return place_of(inside);
}

/// The ends of the part of `triangle` in the plane of `target`, as far as they lie in `target`. visit(end, place)
template <typename Visit>
void for_each_end(const PlaneTriangle& triangle, const Signs& signs, const PlaneTriangle& target, EdgeSides& edge_sides,
                  Visit visit) {
  std::optional<TriangleInPlane> in_plane;
  for (std::uint8_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    if (signs[i] == 0) {
      if (!in_plane) in_plane.emplace(target.corners);
      if (const auto place = in_plane->place(triangle.corners[i])) visit(Place{Place::Kind::corner, i}, *place);
    } else if (signs[i] * signs[j] < 0) {
      if (const auto place = locate_crossing(triangle.edge(i), signs[i], target, edge_sides))
        visit(Place{Place::Kind::edge, i}, *place);
    }
  }
}

/// The edge whose ends both lie in the plane; the third corner does not.
std::uint8_t edge_in_plane(const Signs& signs) {
  for (std::uint8_t i = 0; i < 3; ++i)
    if (signs[i] == 0 && signs[(i + 1) % 3] == 0) return i;
  return TriangleContact::kNoEdge;
}

bool is_edge(const Place& place, std::uint8_t edge) {
  return place.kind == Place::Kind::edge && place.index == edge;
}

}  // namespace

std::optional<Place> TriangleInPlane::place(const PointRef& point) const {
  Signs inside{};
  for (std::size_t j = 0; j < 3; ++j) {
    inside[j] = turn_.sign * orient2d(turn_.projection, triangle_[j], triangle_[(j + 1) % 3], point);
    if (inside[j] < 0) return std::nullopt;
  }
  return place_of(inside);
}

TriangleContact contact_of(const PlaneTriangle& first, const PlaneTriangle& second, EdgeSides& edge_sides) {
  TriangleContact contact;
  const Signs first_signs = sides_of(first.corners, second);
  if (are_all_on_one_side(first_signs)) return contact;
  if (first_signs == Signs{}) {
    contact.is_coplanar = true;
    return contact;
  }
  const Signs second_signs = sides_of(second.corners, first);
  if (are_all_on_one_side(second_signs)) return contact;

  contact.first_edge = edge_in_plane(first_signs);
  contact.second_edge = edge_in_plane(second_signs);
  const auto add = [&](const Place& in_first, const Place& in_second) {
    for (std::size_t k = 0; k < contact.count; ++k)
      if (contact.points[k].first == in_first && contact.points[k].second == in_second) return;
    assert(contact.count < 2);
    contact.points[contact.count++] = {in_first, in_second, is_edge(in_first, contact.first_edge),
                                       is_edge(in_second, contact.second_edge)};
  };
  for_each_end(first, first_signs, second, edge_sides, add);
  for_each_end(second, second_signs, first, edge_sides, [&](const Place& end, const Place& place) { add(place, end); });
  return contact;
}

}  // namespace algebra3d::arrangement
