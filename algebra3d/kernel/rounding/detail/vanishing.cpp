#include "algebra3d/kernel/rounding/detail/vanishing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/bodies_apart.h"
#include "algebra3d/kernel/rounding/detail/cell_cover.h"
#include "algebra3d/kernel/rounding/detail/met_cells.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// In how many bodies a cell is looked for, and among how many cells at the boundary of each.
constexpr std::size_t kSearchedBodies = 16;
constexpr std::size_t kSearchedCells = 10'000;
/// Along the normals of how many triangles, the largest ones, a body is measured.
constexpr std::size_t kMeasuredDirections = 8;

/// The vertices of a body, in cells from one of them: differences of close points are accurate then, and products are
/// in range.
std::vector<Vec3> points_in_cells(const TriangleMesh& body, double edge) {
  std::vector<Vec3> points;
  points.reserve(body.vertex_count());
  const RationalVec3 origin = body.points()[0].rational();
  for (std::size_t v = 0; v < body.vertex_count(); ++v) {
    const RationalVec3 p = body.points()[v].rational() - origin;
    points.push_back({p.x.nearest_double() / edge, p.y.nearest_double() / edge, p.z.nearest_double() / edge});
  }
  return points;
}

/// How large a triangle is, in cells.
struct Extent {
  Vec3 normal;  // twice the area long
  double side;  // the longest one
  double area() const { return std::sqrt(dot(normal, normal)) / 2; }
};

/// The extents of all triangles, the largest first.
std::vector<Extent> extents_of(const TriangleMesh& body, const std::vector<Vec3>& points) {
  std::vector<Extent> extents;
  for (const FaceId face : faces(body)) {
    const auto [a, b, c] = body.triangle(face);
    const Vec3 ab = points[b] - points[a], ac = points[c] - points[a], bc = points[c] - points[b];
    extents.push_back({cross(ab, ac), std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)}))});
  }
  std::ranges::stable_sort(extents, std::greater(), &Extent::area);
  return extents;
}

/// At least so many cells with an edge in terms of the smallest ones meet the triangles, about: those under the shadow
/// of one of them, or along its side.
double fewest_cells(const std::vector<Extent>& extents, double edge) {
  double most = 0;
  for (const Extent& extent : extents) most = std::max({most, extent.side / edge, extent.area() / edge / edge});
  return most / std::sqrt(3);
}

/// True if the body is thinner in the direction of a triangle's normal than the smallest cell is.
bool is_thinner_than_a_cell(const std::vector<Vec3>& points, const std::vector<Extent>& extents) {
  for (std::size_t i = 0; i < std::min(extents.size(), kMeasuredDirections); ++i) {
    const Vec3 normal = extents[i].normal;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : points) {
      low = std::min(low, dot(p, normal));
      high = std::max(high, dot(p, normal));
    }
    const double width_of_cell = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    constexpr double kSafety = 0.99;  // for errors of rounding
    if (high - low < kSafety * width_of_cell) return true;
  }
  return false;
}

/// The largest edge of a lattice (met_cells.h) that is at most twice the depth; 0 if none is.
double largest_edge(double smallest, double depth) {
  if (!(smallest <= 2 * depth)) return 0;
  double edge = smallest;
  while (std::isfinite(2 * edge) && 2 * edge <= 2 * depth) edge *= 2;
  return edge;
}

/// Whether a single body holds a cell of the grid. `smallest`: the edge of the smallest cells.
Result<bool> has_inner_cell(const TriangleMesh& body, const CoordinateGrid& grid, double smallest, double depth,
                            const std::atomic<bool>* cancel) {
  const std::vector<Vec3> points = points_in_cells(body, smallest);
  const std::vector<Extent> extents = extents_of(body, points);
  const bool are_too_many = fewest_cells(extents, largest_edge(smallest, depth) / smallest) > kSearchedCells;
  if (are_too_many || is_thinner_than_a_cell(points, extents)) return false;
  A3D_ASSIGN(const std::optional<MetCells> met, finest_met_cells(body, grid, kSearchedCells, cancel));
  return met ? CellCover(body, *met).has_inner_cell(cancel) : Result<bool>(false);
}

}  // namespace

Result<bool> has_inner_cell(const TriangleMesh& solid, const CoordinateGrid& grid, double depth,
                            const std::atomic<bool>* cancel) {
  const std::vector<std::vector<FaceId>> bodies = bodies_apart(solid);
  for (std::size_t i = 0; i < std::min(bodies.size(), kSearchedBodies); ++i) {
    const TriangleMesh body = submesh(solid, bodies[i]);
    const double smallest = smallest_cell(body, grid);
    if (largest_edge(smallest, depth) == 0) continue;
    A3D_ASSIGN(const bool is_found, has_inner_cell(body, grid, smallest, depth, cancel));
    if (is_found) return true;
  }
  return false;
}

}  // namespace algebra3d
