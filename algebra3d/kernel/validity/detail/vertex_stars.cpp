// A closed fan of triangles round v is a graph over a plane, and so free of intersections, if along some direction d
// (1) every triangle shows its front, and (2) the projected triangles go round the projection of v just once. Then the
// projections of different triangles have no common inner points, a line along d meets each triangle at most once, and
// a common point of two triangles lies over the common part of their projections, which is a shared edge or v.
//
// Any d will do, so d is made of small integers, and all rounding happens in the edge vectors and the products with
// them: a bound for it is all that has to be compared with. Coordinates that are not doubles are rounded first, by at
// most 2^-53 of their size. Whatever the bound leaves open (sharp creases, saddles that fold over every plane, slivers,
// boundaries, several fans) is left to the exact test of pairs.

#include "algebra3d/kernel/validity/detail/vertex_stars.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// The ring of one vertex; kept between vertices for its storage.
struct Star {
  std::vector<Vec3> edges;    // from the vertex to its neighbours, counter-clockwise, rounded differences
  std::vector<Vec3> normals;  // edges[i] x edges[i + 1], rounded
  double longest = 0;         // largest absolute coordinate of an edge
  double rounded = 0;         // largest absolute coordinate of a point that is not of doubles; 0 without such points

  void add_point(const PointRef& point) {
    if (!point.is_double()) rounded = std::max(rounded, detail::largest(point.approx));
  }
};

constexpr double kDirectionSize = 1024;
constexpr int kSearchRounds = 8;
constexpr std::size_t kVerticesPerTask = 4096;

/// Collects the closed fan of `v`; false if there is none.
bool collect_star(const TriangleMesh& mesh, VertexId v, Star& star) {
  star.edges.clear();
  star.longest = star.rounded = 0;
  const HalfedgeId first = mesh.outgoing(v);
  const PointRef centre = mesh.point(v);
  if (!first.is_valid() || mesh.is_nonmanifold(v)) return false;
  star.add_point(centre);
  HalfedgeId h = first;
  do {
    const PointRef end = mesh.point(mesh.target(h));
    const Vec3 edge = end.approx - centre.approx;
    star.edges.push_back(edge);
    star.longest = std::max(star.longest, detail::largest(edge));
    star.add_point(end);
    h = mesh.opposite(TriangleMesh::prev(h));
    if (!h.is_valid()) return false;
  } while (h != first);
  return star.edges.size() >= 3;
}

Vec3 sum_of_normals(Star& star) {
  star.normals.clear();
  Vec3 sum;
  for (std::size_t i = 0; i < star.edges.size(); ++i) {
    const std::size_t next = i + 1 == star.edges.size() ? 0 : i + 1;
    star.normals.push_back(cross(star.edges[i], star.edges[next]));
    sum = sum + star.normals.back();
  }
  return sum;
}

/// `v` with integer coordinates of at most kDirectionSize; the zero vector if it has no direction.
Vec3 to_integers(const Vec3& v) {
  const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0) || !std::isfinite(size)) return {};
  const double factor = kDirectionSize / size;
  return {std::trunc(v.x * factor), std::trunc(v.y * factor), std::trunc(v.z * factor)};
}

bool shows_front(const Star& star, const Vec3& direction, double bound) {
  return std::ranges::all_of(star.normals, [&](const Vec3& normal) { return dot(normal, direction) > bound; });
}

/// Finds an integer direction along which every triangle shows its front; the zero vector if the search fails.
/// The sum of the normals serves smooth surfaces. Where a triangle turns away from it, that one's unit normal is added,
/// one at a time: the perceptron rule, which ends if there is a solution with enough room.
Vec3 front_direction(const Star& star, const Vec3& sum_of_normals) {
  // Products of two edges and d: six terms of at most longest^2 * 1024, each with seven roundings. Where points are
  // rounded, the edges are wrong by 2^-52 * rounded, and so each term by 2 * 1024 * longest times that.
  const double square = star.longest * star.longest;
  const double bound = 1e-11 * (square + star.longest * star.rounded);
  // Outside this range underflow would break the bound, or overflow make it void.
  if (!(square > 1e-250 && square < 1e250)) return {};
  Vec3 direction = to_integers(sum_of_normals);
  if (shows_front(star, direction, bound)) return direction;
  Vec3 guess = (1 / kDirectionSize) * direction;
  for (int round = 0; round < kSearchRounds; ++round) {
    for (const Vec3& normal : star.normals) {
      const double length = std::sqrt(dot(normal, normal));
      if (!(length > 0)) return {};
      if (dot(normal, guess) <= 0.02 * length * std::sqrt(dot(guess, guess))) guess = guess + (1 / length) * normal;
    }
    direction = to_integers(guess);
    if (shows_front(star, direction, bound)) return direction;
  }
  return {};
}

/// An integer vector at right angles to `d`, exactly, and in no simple relation to it: a combination of three obvious
/// ones with factors too large for an integer direction to cancel.
Vec3 across(const Vec3& d) {
  return 401 * Vec3{d.y, -d.x, 0} + 613 * Vec3{d.z, 0, -d.x} + 1031 * Vec3{0, d.z, -d.y};
}

/// For a star that shows its front along `d`: whether its edges go round just once. Each step turns counter-clockwise
/// by less than 180 degrees, so a turn of 360 degrees steps from the right of a line to its left exactly once.
bool goes_round_once(const Star& star, const Vec3& d) {
  const Vec3 line = across(d);
  // Three terms of at most longest * 2.1 million, each with four roundings, and with edges of rounded points.
  const double bound = 1e-8 * (star.longest + star.rounded);
  const double last = dot(star.edges.back(), line);
  int turns = 0;
  bool was_right = last < 0;
  for (const Vec3& edge : star.edges) {
    const double side = dot(edge, line);
    if (!(std::abs(side) > bound)) return false;
    const bool is_right = side < 0;
    turns += static_cast<int>(was_right && !is_right);
    was_right = is_right;
  }
  return turns == 1;
}

bool is_embedded_star(const TriangleMesh& mesh, VertexId v, Star& star) {
  if (!collect_star(mesh, v, star)) return false;
  const Vec3 direction = front_direction(star, sum_of_normals(star));
  return direction != Vec3{} && goes_round_once(star, direction);
}

/// Per vertex: whether it is a corner of a face that is not known. Empty if nothing is known.
std::vector<bool> corners_of_unknown(const TriangleMesh& mesh, const FaceSet& known) {
  if (known.is_empty()) return {};
  std::vector<bool> are_corners(mesh.vertex_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    if (!known.contains(f))
      for (const std::uint32_t corner : mesh.triangle(FaceId(f))) are_corners[corner] = true;
  return are_corners;
}

}  // namespace

EmbeddedStars::EmbeddedStars(const TriangleMesh& mesh) : is_embedded_(mesh.vertex_count(), 0) {
  test(mesh, [](std::size_t /*vertex*/) { return true; });
}

EmbeddedStars::EmbeddedStars(const TriangleMesh& mesh, const HeightFields& fields, const FaceSet& known)
    : is_embedded_(fields.are_inside()) {
  const std::vector<bool> is_asked = corners_of_unknown(mesh, known);
  test(mesh, [&](std::size_t vertex) { return is_embedded_[vertex] == 0 && (is_asked.empty() || is_asked[vertex]); });
}

template <typename IsAsked>
void EmbeddedStars::test(const TriangleMesh& mesh, const IsAsked& is_asked) {
  const std::size_t count = mesh.vertex_count();
  parallel_for((count + kVerticesPerTask - 1) / kVerticesPerTask, 1, [&](std::size_t task) {
    Star star;
    for (std::size_t i = task * kVerticesPerTask; i < std::min(count, (task + 1) * kVerticesPerTask); ++i)
      if (is_asked(i)) is_embedded_[i] = static_cast<std::uint8_t>(is_embedded_star(mesh, VertexId(i), star));
  });
}

bool EmbeddedStars::is_at_embedded(const TriangleMesh& mesh, FaceId face) const {
  const TriangleMesh::Triangle corners = mesh.triangle(face);
  return (is_embedded_[corners[0]] | is_embedded_[corners[1]] | is_embedded_[corners[2]]) != 0;
}

}  // namespace algebra3d
