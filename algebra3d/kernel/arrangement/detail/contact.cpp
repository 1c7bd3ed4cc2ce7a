#include "algebra3d/kernel/arrangement/detail/contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "algebra3d/kernel/exact/counters.h"

namespace algebra3d::arrangement {
namespace {

constexpr std::uint8_t kNoCorner = 3;

/// The corners that two triangles share, as far as that is seen without arithmetic: of each corner of one triangle, the
/// same corner of the other one, or kNoCorner.
struct SharedCorners {
  std::array<std::uint8_t, 3> of_first{kNoCorner, kNoCorner, kNoCorner};
  std::array<std::uint8_t, 3> of_second{kNoCorner, kNoCorner, kNoCorner};
  std::size_t count = 0;
};

/// Where both triangles see a corner in the plane of the other one, or nearly so.
SharedCorners shared_corners(const PlaneTriangle& first, const Signs& first_signs, const PlaneTriangle& second,
                             const Signs& second_signs) {
  SharedCorners shared;
  for (std::uint8_t i = 0; i < 3; ++i) {
    if (first_signs[i] != detail::kUndecided) continue;
    const PointRef& corner = first.corner(i);
    for (std::uint8_t j = 0; j < 3; ++j) {
      if (second_signs[j] != detail::kUndecided) continue;
      const PointRef& other = second.corner(j);
      if (corner.approx != other.approx || corner.exact != other.exact) continue;
      shared.of_first[i] = j;
      shared.of_second[j] = i;
      ++shared.count;
    }
  }
  return shared;
}

/// True if a line in which an edge of `triangle` is seen along an axis has all of `other` beyond it, as far as rounded
/// numbers decide.
bool separates(const TriangleRef& triangle, const TriangleRef& other, Projection projection) {
  const auto turn = [&](const PointRef& a, const PointRef& b, const PointRef& c) {
    return detail::filter_rounded_orient2d(projection, a.approx, b.approx, c.approx);
  };
  const int inside = turn(triangle[0], triangle[1], triangle[2]);
  if (inside == detail::kUndecided) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const PointRef &from = triangle[i], &to = triangle[(i + 1) % 3];
    if (std::ranges::all_of(other, [&](const PointRef& corner) { return turn(from, to, corner) == -inside; }))
      return true;
  }
  return false;
}

/// The projection along the longest coordinate of a normal that is not exact.
Projection rounded_projection(const TriangleRef& triangle) {
  const Vec3 normal = cross(triangle[1].approx - triangle[0].approx, triangle[2].approx - triangle[0].approx);
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  return x >= y && x >= z ? Projection::yz : y >= z ? Projection::zx : Projection::xy;
}

/// True if the triangles are clearly apart as seen along an axis: so are most that lie nearly in one plane.
bool are_seen_apart(const TriangleRef& first, const TriangleRef& second) {
  const Projection projection = rounded_projection(first);
  return separates(first, second, projection) || separates(second, first, projection);
}

/// Decides what rounded numbers left open. Shared corners lie in the plane.
void decide(Signs& signs, const PlaneTriangle& triangle, const std::array<std::uint8_t, 3>& shared,
            const PlaneTriangle& other) {
  for (std::size_t i = 0; i < 3; ++i)
    if (signs[i] == detail::kUndecided) signs[i] = shared[i] != kNoCorner ? 0 : other.exact_side(triangle.corner(i));
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
  // Rounded signs of all edges first: where one edge of a thin triangle needs exact arithmetic, another one often
  // shows without it that the point is outside.
  Signs sides{};
  for (std::size_t j = 0; j < 3; ++j) {
    sides[j] = EdgeSides::rounded_side(edge, target.edge(j));
    if (sides[j] == side) return std::nullopt;
  }
  Signs inside{};
  for (std::size_t j = 0; j < 3; ++j) {
    if (sides[j] == detail::kUndecided) sides[j] = edge_sides.side(edge, target.edge(j));
    inside[j] = -side * sides[j];
    if (inside[j] < 0) return std::nullopt;
  }
  return place_of(inside);
}

/// The ends of the part of `triangle` in the plane of `target`, as far as they lie in `target`. visit(end, place)
template <typename Visit>
void for_each_end(const PlaneTriangle& triangle, const Signs& signs, const std::array<std::uint8_t, 3>& shared,
                  const PlaneTriangle& target, EdgeSides& edge_sides, Visit visit) {
  std::optional<TriangleInPlane> in_plane;
  for (std::uint8_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    if (shared[i] != kNoCorner) {
      visit(Place{Place::Kind::corner, i}, Place{Place::Kind::corner, shared[i]});
    } else if (signs[i] == 0) {
      if (!in_plane) in_plane.emplace(target.corners());
      if (const auto place = in_plane->place(triangle.corner(i))) visit(Place{Place::Kind::corner, i}, *place);
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

/// True if the triangle touches the plane in one corner only.
bool touches_in_corner(const Signs& signs) {
  for (std::size_t i = 0; i < 3; ++i)
    if (signs[i] == 0 && signs[(i + 1) % 3] == signs[(i + 2) % 3]) return true;
  return false;
}

bool is_edge(const Place& place, std::uint8_t edge) {
  return place.kind == Place::Kind::edge && place.index == edge;
}

/// The common part of two triangles in different planes, in each of which the other one has corners on both sides or
/// in the plane.
TriangleContact common_part(const PlaneTriangle& first, const Signs& first_signs, const PlaneTriangle& second,
                            const Signs& second_signs, const SharedCorners& shared, EdgeSides& edge_sides) {
  TriangleContact contact;
  contact.first_edge = edge_in_plane(first_signs);
  contact.second_edge = edge_in_plane(second_signs);
  const auto add = [&](const Place& in_first, const Place& in_second) {
    for (std::size_t k = 0; k < contact.count; ++k)
      if (contact.points[k].first == in_first && contact.points[k].second == in_second) return;
    assert(contact.count < 2);
    contact.points[contact.count++] = {in_first, in_second, is_edge(in_first, contact.first_edge),
                                       is_edge(in_second, contact.second_edge)};
  };
  const auto add_turned = [&](const Place& end, const Place& place) { add(place, end); };
  // All that they have in common, if they share an edge, or a corner with which one of them only touches the other
  // plane.
  const bool is_known =
      shared.count == 2 || (shared.count == 1 && (touches_in_corner(first_signs) || touches_in_corner(second_signs)));
  if (is_known) {
    for (std::uint8_t i = 0; i < 3; ++i)
      if (shared.of_first[i] != kNoCorner) add({Place::Kind::corner, i}, {Place::Kind::corner, shared.of_first[i]});
    return contact;
  }
  for_each_end(first, first_signs, shared.of_first, second, edge_sides, add);
  for_each_end(second, second_signs, shared.of_second, first, edge_sides, add_turned);
  return contact;
}

}  // namespace

bool has_exact_corner(const TriangleRef& triangle) {
  return !std::ranges::all_of(triangle, &PointRef::is_double);
}

PlaneTriangle::PlaneTriangle(const TriangleRef& corners, const std::array<InputVertexId, 3>& vertices,
                             const IntegerPlane* plane)
    : corners_(corners), vertices_(vertices), plane_(plane) {
  if (plane_ != nullptr)
    rounded_ = plane_->rounded();
  else if (!has_exact_corner(corners_))
    filter_.emplace(corners_[0].approx, corners_[1].approx, corners_[2].approx);
}

Signs PlaneTriangle::rounded_sides(const TriangleRef& points) const {
  detail::count_calls(3);
  Signs signs{detail::kUndecided, detail::kUndecided, detail::kUndecided};
  if (plane_ != nullptr) {
    for (std::size_t i = 0; i < 3; ++i) signs[i] = detail::filter_rounded_side(rounded_, points[i].approx);
  } else if (filter_) {
    for (std::size_t i = 0; i < 3; ++i)
      if (points[i].is_double()) signs[i] = filter_->side(points[i].approx);
  }
  return signs;
}

int PlaneTriangle::exact_side(const PointRef& point) const {
  const auto& [a, b, c] = corners_;
  if (plane_ != nullptr) return plane_->side(point);
  return filter_ && point.is_double() ? detail::decide_orient3d(a.approx, b.approx, c.approx, point.approx)
                                      : orient3d(a, b, c, point);
}

int TriangleInPlane::side_of_edge(std::size_t i, const PointRef& point) const {
  return turn_.sign * orient2d(turn_.projection, triangle_[i], triangle_[(i + 1) % 3], point);
}

std::optional<Place> TriangleInPlane::place(const PointRef& point) const {
  Signs inside{};
  for (std::size_t j = 0; j < 3; ++j) {
    inside[j] = side_of_edge(j, point);
    if (inside[j] < 0) return std::nullopt;
  }
  return place_of(inside);
}

TriangleContact contact_of(const PlaneTriangle& first, const Signs& first_sides, const PlaneTriangle& second,
                           EdgeSides& edge_sides) {
  if (are_all_on_one_side(first_sides)) return {};
  Signs first_signs = first_sides;
  Signs second_signs = first.rounded_sides(second.corners());
  if (are_all_on_one_side(second_signs)) return {};

  const SharedCorners shared = shared_corners(first, first_signs, second, second_signs);
  const bool is_exact = has_exact_corner(first.corners()) || has_exact_corner(second.corners());
  if (is_exact && shared.count == 0 && are_seen_apart(first.corners(), second.corners())) return {};

  decide(first_signs, first, shared.of_first, second);
  if (are_all_on_one_side(first_signs)) return {};
  if (first_signs == Signs{}) {
    TriangleContact contact;
    contact.is_coplanar =
        shared.count > 0 || intersect_coplanar_triangles(first.corners(), second.corners()) != Contact::none;
    return contact;
  }
  decide(second_signs, second, shared.of_second, first);
  if (are_all_on_one_side(second_signs)) return {};
  return common_part(first, first_signs, second, second_signs, shared, edge_sides);
}

}  // namespace algebra3d::arrangement
