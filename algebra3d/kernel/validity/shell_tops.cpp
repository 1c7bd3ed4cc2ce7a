// Why what lies right above the highest vertex v of a shell S says where S lies.
//
// Let L be the vertical line through v, moved by (e, e^2, 0) for an e > 0 smaller than any number. No face of S is
// higher than v. If no face of another shell contains v, then near v there is nothing but S, so a point x on L right
// above the height of v can be joined to S without passing another shell: x lies in the same shells as S does, and not
// in S itself. Going up from x, nothing changes before the first face g that L meets.

#include "algebra3d/kernel/validity/shell_tops.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/intersection_point.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// Where the vertical line through the point meets the plane of the triangle.
ExactPoint place_above(const PointRef& point, const TriangleRef& triangle) {
  const RationalVec3 from = point.rational();
  const ExactPoint up(RationalVec3(from.x, from.y, from.z + 1));
  return intersect_line_plane(point, up, triangle);
}

/// True if the projection of p lies in the closed projected triangle.
bool covers(const TriangleRef& triangle, const PointRef& p, bool& is_vertical) {
  const auto& [a, b, c] = triangle;
  const int s = orient2d(Projection::xy, a, b, p), t = orient2d(Projection::xy, b, c, p);
  if (s * t < 0) return false;
  const int u = orient2d(Projection::xy, c, a, p);
  // The three sum to the projected area: of a vertical triangle they have different signs, or all are 0.
  is_vertical = s == 0 && t == 0 && u == 0;
  return s * u >= 0 && t * u >= 0;
}

/// True if the height of p is one of those of the triangle.
bool spans_height(const TriangleRef& triangle, const PointRef& p) {
  const auto is_lower = [&](const PointRef& corner) { return compare(2, corner, p) < 0; };
  const auto is_higher = [&](const PointRef& corner) { return compare(2, corner, p) > 0; };
  return !std::ranges::all_of(triangle, is_lower) && !std::ranges::all_of(triangle, is_higher);
}

/// An estimate of a sum of determinants, and a bound of its error.
struct EstimatedSum {
  double value = 0, error = 0, size = 0;
  std::uint32_t count = 0;

  /// Adds six times the volume of the tetrahedron from `origin`; the error is that of filter_rounded_orient3d.
  void add(const TriangleRef& triangle, const PointRef& origin) {
    const auto& [a, b, c] = triangle;
    const Vec3 u = a.approx - origin.approx, v = b.approx - origin.approx, w = c.approx - origin.approx;
    const bool are_doubles = a.is_double() && b.is_double() && c.is_double() && origin.is_double();
    const double largest = std::max({detail::largest(a.approx), detail::largest(b.approx), detail::largest(c.approx),
                                     detail::largest(origin.approx)});
    const double off = are_doubles ? 0 : 0x1p-51 * largest;
    const double determinant = dot(u, cross(v, w));
    error += detail::error_of_rounded_volume(detail::largest(u) + off, detail::largest(v) + off,
                                             detail::largest(w) + off, off);
    value += determinant;
    size += std::abs(determinant);
    ++count;
  }
  int sign() const {
    const double off = (error + size * count * std::numeric_limits<double>::epsilon()) * (1 + 0x1p-20);
    return value > off ? 1 : value < -off ? -1 : detail::kUndecided;
  }
};

/// Triangles with points of their own: an exact volume looks at all points that it is given.
struct LooseTriangles {
  PointArray points;
  std::vector<TriangleMesh::Triangle> triangles;

  void add(const TriangleRef& corners) {
    const auto first = static_cast<std::uint32_t>(points.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const PointRef& corner : corners) points.push_back(corner);
  }
};

}  // namespace

ShellTops::ShellTops(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                     std::span<const std::uint32_t> shell_of_face, std::size_t shell_count)
    : mesh_(mesh), hierarchy_(hierarchy), shell_of_face_(shell_of_face), tops_(shell_count) {
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    poll_interruption_at(face);
    VertexId& top = tops_[shell_of_face[face]];
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const VertexId vertex = mesh.origin(TriangleMesh::halfedge(FaceId(face), corner));
      if (!top.is_valid() || compare(2, mesh.point(vertex), mesh.point(top)) > 0) top = vertex;
    }
  }
}

std::vector<std::uint32_t> ShellTops::from_highest() const {
  std::vector<std::uint32_t> shells(tops_.size());
  for (std::uint32_t shell = 0; shell < shells.size(); ++shell) shells[shell] = shell;
  std::ranges::stable_sort(shells, [&](std::uint32_t a, std::uint32_t b) {
    return compare(2, mesh_.point(tops_[a]), mesh_.point(tops_[b])) > 0;
  });
  return shells;
}

struct ShellTops::Search {
  const TriangleMesh& mesh;
  PointRef point;
  FaceOverhead found = {};
  bool is_tied = false;
  ExactPoint place = {};                                   // of the face found
  double bound = std::numeric_limits<double>::infinity();  // no face wholly above it matters

  /// Gives the bound.
  double look_at(std::uint32_t face) {
    const TriangleRef corners = mesh.corners(FaceId(face));
    bool is_vertical = false;
    if (!covers(corners, point, is_vertical)) return bound;
    if (is_vertical) {
      if (spans_height(corners, point)) found.is_known = false;
      return bound;
    }
    const LineCrossing crossing = cross_vertical_line(point, corners);
    if (crossing.sign == 0 ? orient3d(corners[0], corners[1], corners[2], point) == 0 : crossing.side == 0)
      found.is_known = false;
    if (crossing.side == -1) take(face, crossing.sign, place_above(point, corners));
    return bound;
  }

  void take(std::uint32_t face, int sign, ExactPoint where) {
    const auto order = found.face.is_valid() ? compare(2, where, place) : std::strong_ordering::less;
    if (order > 0) return;
    is_tied = order == 0;
    found.face = FaceId(face);
    found.sign = sign;
    place = std::move(where);
    bound = std::nextafter(place.approx().z, std::numeric_limits<double>::infinity());
  }
};

FaceOverhead ShellTops::overhead(std::uint32_t shell) const {
  Search search{.mesh = mesh_, .point = mesh_.point(tops_[shell])};
  hierarchy_.for_each_above(box_of(search.point), [&](std::uint32_t face) {
    return shell_of_face_[face] == shell ? search.bound : search.look_at(face);
  });
  search.found.is_known = search.found.is_known && !search.is_tied;
  return search.found;
}

std::vector<int> shell_orientations(const TriangleMesh& mesh, std::span<const std::uint32_t> shell_of_face,
                                    std::size_t shell_count) {
  std::vector<EstimatedSum> sums(shell_count);
  std::vector<VertexId> origins(shell_count);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    poll_interruption_at(face);
    const std::uint32_t shell = shell_of_face[face];
    if (!origins[shell].is_valid()) origins[shell] = mesh.origin(TriangleMesh::halfedge(FaceId(face), 0));
    sums[shell].add(mesh.corners(FaceId(face)), mesh.point(origins[shell]));
  }
  std::vector<int> signs;
  signs.reserve(shell_count);
  for (const EstimatedSum& sum : sums) signs.push_back(sum.sign());
  if (std::ranges::find(signs, detail::kUndecided) == signs.end()) return signs;
  std::vector<LooseTriangles> undecided(shell_count);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    poll_interruption_at(face);
    if (const std::uint32_t shell = shell_of_face[face]; signs[shell] == detail::kUndecided)
      undecided[shell].add(mesh.corners(FaceId(face)));
  }
  for (std::size_t shell = 0; shell < shell_count; ++shell)
    if (signs[shell] == detail::kUndecided)
      signs[shell] = exact_volume(undecided[shell].points, undecided[shell].triangles)->sign();
  return signs;
}

}  // namespace algebra3d
