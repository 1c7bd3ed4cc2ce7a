#include "algebra3d/kernel/repair/detail/holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/thin_patches.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/soup/loop_triangulation.h"
#include "algebra3d/kernel/soup/rounding_noise.h"
#include "base/id_vector.h"
#include "base/propagate.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// The number of a HoleLoop among those of a mesh.
using HoleId = StrongId<struct HoleTag>;

/// A simple closed boundary loop with the data for triangulating a cover. In the direction in which new triangles run
/// along it.
struct HoleLoop {
  std::vector<VertexId> vertices;
  Loop loop;        ///< the same corners as points, and per edge the corner of the triangle beyond it
  FaceId triangle;  ///< any triangle at the loop: shows the connected component

  /// The box around the loop.
  Box3 box() const;
  /// The diagonal of its box, in coordinate units.
  double diameter() const;
};

using HalfedgePath = std::vector<HalfedgeId>;

/// The parts of a loop between visits of the same vertex, each a loop by itself.
std::vector<HalfedgePath> simple_loops(const TriangleMesh& mesh, const HalfedgePath& loop) {
  std::vector<HalfedgePath> result;
  HalfedgePath path;
  std::unordered_map<VertexId, std::size_t> places;  // in the path, of the origins
  for (const HalfedgeId h : loop) {
    places[mesh.origin(h)] = path.size();
    path.push_back(h);
    const auto known = places.find(mesh.target(h));
    if (known == places.end()) continue;
    const auto start = path.begin() + static_cast<std::ptrdiff_t>(known->second);
    for (auto g = start; g != path.end(); ++g) places.erase(mesh.origin(*g));
    result.emplace_back(start, path.end());
    path.erase(start, path.end());
  }
  return result;
}

/// New triangles run against the boundary.
HoleLoop hole_of(const TriangleMesh& mesh, const HalfedgePath& boundary) {
  HoleLoop hole;
  hole.triangle = TriangleMesh::face(boundary[0]);
  for (std::size_t i = boundary.size(); i-- > 0;) {
    const VertexId from = mesh.target(boundary[i]);
    hole.vertices.push_back(from);
    hole.loop.corners.push_back(mesh.point(from).approx);
    hole.loop.beyond.push_back(mesh.point(mesh.origin(TriangleMesh::prev(boundary[i]))).approx);
  }
  return hole;
}

Box3 HoleLoop::box() const {
  Box3 box;
  for (const Vec3& corner : loop.corners) box.extend(corner);
  return box;
}

double HoleLoop::diameter() const {
  const Box3 around = box();
  return length(around.max - around.min);
}

/// The simple boundary loops of a mesh; loops that visit a vertex more than once are cut there. Cost: linear.
IdVector<HoleId, HoleLoop> hole_loops(const TriangleMesh& mesh) {
  IdVector<HoleId, HoleLoop> result;
  for (const BoundaryLoop& boundary : boundary_loops(mesh))
    for (const HalfedgePath& loop : simple_loops(mesh, boundary.halfedges))
      if (loop.size() >= 3) result.push_back(hole_of(mesh, loop));
  return result;
}

/// Tests whether triangles that close a hole would cut the surface around it.
class CoverTest {
 public:
  /// Collects the triangles near the holes. The soup must outlive this; triangles added later are ignored.
  CoverTest(const IndexedSoup& soup, const IdVector<HoleId, HoleLoop>& holes);

  /// True if a triangle of the cover is degenerate, or meets a triangle of the soup in more than common corners and
  /// edges. At most 10,000 triangles are looked at, and 100 more per triangle of the cover; others count as not cut.
  bool cuts_surface(const std::vector<TriangleMesh::Triangle>& cover) const;

 private:
  bool cuts(const TriangleMesh::Triangle& triangle, FaceId other) const;

  const IndexedSoup& soup_;
  rtree::RTree<std::uint32_t> tree_;
};

TriangleRef corners_of(const IndexedSoup& soup, const TriangleMesh::Triangle& t) {
  return {soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]};
}

CoverTest::CoverTest(const IndexedSoup& soup, const IdVector<HoleId, HoleLoop>& holes) : soup_(soup) {
  std::vector<rtree::Entry<std::uint32_t>> hole_boxes, boxes;
  for (const HoleLoop& hole : holes) hole_boxes.push_back({hole.box(), 0});
  const auto hole_tree = rtree::RTree<std::uint32_t>::bulk_load(hole_boxes);
  const auto mesh = soup.mesh();
  for (const FaceId face : faces(*mesh)) {
    const Box3 box = box_of_triangle(mesh->corners(face));
    auto near = hole_tree.window(box);
    if (near.next()) boxes.push_back({box, face.index()});
  }
  tree_ = rtree::RTree<std::uint32_t>::bulk_load(boxes);
}

bool CoverTest::cuts(const TriangleMesh::Triangle& triangle, FaceId other) const {
  const TriangleMesh::Triangle& corners = soup_.triangles[other];
  const auto is_common = [&](std::uint32_t corner) { return std::ranges::find(corners, corner) != corners.end(); };
  const auto common = std::ranges::count_if(triangle, is_common);
  const Contact contact = intersect_triangles(corners_of(soup_, triangle), corners_of(soup_, corners));
  if (common == 0) return contact != Contact::none;
  return common == 1 ? contact > Contact::point : contact > Contact::segment;
}

bool CoverTest::cuts_surface(const std::vector<TriangleMesh::Triangle>& cover) const {
  std::size_t looks_left = 10'000 + 100 * cover.size();
  for (const TriangleMesh::Triangle& triangle : cover) {
    const TriangleRef corners = corners_of(soup_, triangle);
    if (collinear(corners[0], corners[1], corners[2])) return true;
    for (const std::uint32_t other : tree_.window(box_of_triangle(corners))) {
      if (looks_left-- == 0) return false;
      if (cuts(triangle, FaceId(other))) return true;
    }
  }
  return false;
}

/// A bound of the distance between a point of the triangle and the nearest of its corners.
double reach_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  // Scaled by the longest side, so that products neither overflow nor vanish.
  const Vec3 first = (1 / longest) * (b - a), second = (1 / longest) * (c - a);
  const double x = length(first), y = length(second - first), z = length(second);
  const double doubled_area = length(cross(first, second));
  // No circle around a triangle with such sides need be larger.
  if (!(doubled_area > 0)) return longest / std::numbers::sqrt3;
  // The point of an acute triangle that is farthest from its corners is the centre of its circumcircle.
  if (2 >= x * x + y * y + z * z) return longest / 2;
  return x * y * z / (2 * doubled_area) * longest;
}

/// The cover of a hole; no triangles if the hole is too large.
struct CoveredHole {
  HoleLoop hole;
  std::vector<TriangleMesh::Triangle> cover;
  bool cuts_surface = false;
};

class HoleCloser {
 public:
  HoleCloser(IndexedSoup& soup, const HoleLimits& limits, RepairReport& report)
      : soup_(soup),
        limits_(limits),
        report_(report),
        mesh_(soup.mesh()),
        components_(connected_components(*mesh_)),
        scale_(largest_coordinate(*mesh_)),
        noise_(mesh_->points().approx()) {}

  Result<std::vector<Triangle3>> run(const Monitor& monitor);

 private:
  CoveredHole cover(HoleLoop hole, const CoverTest& test) const;
  std::vector<bool> are_open_patches(const std::vector<CoveredHole>& holes);
  std::size_t component(FaceId triangle) const { return components_.of_face[triangle.index()]; }
  bool is_open_patch(std::span<const FaceId> patch, std::span<const CoveredHole* const> holes);
  double tolerance_of(std::span<const Triangle3> patch) const;
  Triangle3 scaled(const TriangleMesh::Triangle& t) const;
  void close(const CoveredHole& covered);
  void drop(const std::vector<bool>& are_open_patches);

  IndexedSoup& soup_;
  HoleLimits limits_;
  RepairReport& report_;
  std::shared_ptr<const TriangleMesh> mesh_;  // of the soup as given
  FaceComponents components_;
  BinaryScale scale_;  // of areas
  RoundingNoise noise_;
  std::vector<Triangle3> thin_;  // the triangles of thin patches
};

Triangle3 HoleCloser::scaled(const TriangleMesh::Triangle& t) const {
  return {scale_.scaled(soup_.points[t[0]]), scale_.scaled(soup_.points[t[1]]), scale_.scaled(soup_.points[t[2]])};
}

CoveredHole HoleCloser::cover(HoleLoop hole, const CoverTest& test) const {
  if (hole.diameter() > limits_.largest) return {std::move(hole), {}, false};
  std::vector<TriangleMesh::Triangle> first;
  for (const LoopMeasure measure : {LoopMeasure::bend, LoopMeasure::area}) {
    std::vector<TriangleMesh::Triangle> triangles = triangulate_loop(hole.loop, measure);
    for (TriangleMesh::Triangle& triangle : triangles)
      for (std::uint32_t& corner : triangle) corner = hole.vertices[corner].index();
    if (!test.cuts_surface(triangles)) return {std::move(hole), std::move(triangles), false};
    if (first.empty()) first = std::move(triangles);
  }
  return {std::move(hole), std::move(first), true};
}

/// Scaled.
double HoleCloser::tolerance_of(std::span<const Triangle3> patch) const {
  if (limits_.tolerance) return scale_.scaled(*limits_.tolerance);
  Box3 box;
  for (const Triangle3& triangle : patch)
    for (const Vec3& corner : triangle) box.extend(corner);
  return noise_.within(box);
}

/// True if a component encloses nothing when its holes are closed: it has one hole, whose cover cuts it and is too
/// large for it, or it is thin.
bool HoleCloser::is_open_patch(std::span<const FaceId> patch, std::span<const CoveredHole* const> holes) {
  constexpr double kMostOfArea = 0.75;
  std::vector<Triangle3> own, covers;
  for (const FaceId f : patch) own.push_back(scaled(soup_.triangles[f]));
  for (const CoveredHole* hole : holes)
    for (const TriangleMesh::Triangle& triangle : hole->cover) covers.push_back(scaled(triangle));
  const auto sum = [](const std::vector<Triangle3>& triangles) {
    double area = 0;
    for (const Triangle3& triangle : triangles) area += area_of(triangle);
    return area;
  };
  const bool are_large = sum(covers) > kMostOfArea * sum(own);
  if (are_large && holes.size() == 1 && holes[0]->cuts_surface) return true;
  if (!is_thin(own, are_large ? covers : std::vector<Triangle3>(), tolerance_of(own))) return false;
  for (const FaceId f : patch) thin_.push_back({soup_.corner(f, 0), soup_.corner(f, 1), soup_.corner(f, 2)});
  return true;
}

/// Per connected component: whether it has holes and is an open patch.
std::vector<bool> HoleCloser::are_open_patches(const std::vector<CoveredHole>& holes) {
  std::vector<std::vector<const CoveredHole*>> holes_of(components_.count);
  for (const CoveredHole& covered : holes) holes_of[component(covered.hole.triangle)].push_back(&covered);
  std::vector<std::vector<FaceId>> faces_of(components_.count);
  for (const FaceId f : faces(*mesh_))
    if (const std::size_t c = component(f); !holes_of[c].empty()) faces_of[c].push_back(f);
  std::vector<bool> result;
  for (std::size_t c = 0; c < components_.count; ++c)
    result.push_back(!holes_of[c].empty() && is_open_patch(faces_of[c], holes_of[c]));
  return result;
}

void HoleCloser::close(const CoveredHole& covered) {
  HoleCover report{covered.hole.loop.corners[0], 0, {}};
  for (const auto& [a, b, c] : covered.cover) {
    const std::array<Vec3, 3> corners{soup_.points[a], soup_.points[b], soup_.points[c]};
    report.triangles.push_back(corners);
    report.farthest = std::max(report.farthest, reach_of(corners[0], corners[1], corners[2]));
  }
  soup_.add(covered.cover);
  report_.add(std::move(report));
}

/// Drops open patches, if they are to go and there is anything else.
void HoleCloser::drop(const std::vector<bool>& are_open_patches) {
  if (std::ranges::count(are_open_patches, true) == 0) return;
  if (!limits_.drops_open_patches || std::ranges::count(are_open_patches, false) == 0) {
    report_.has_kept_open_patches = true;
    return;
  }
  IdVector<FaceId, bool> is_dropped(mesh_->face_count());
  for (const FaceId f : faces(*mesh_)) is_dropped[f] = are_open_patches[component(f)];
  soup_.drop(is_dropped);
}

Result<std::vector<Triangle3>> HoleCloser::run(const Monitor& monitor) {
  IdVector<HoleId, HoleLoop> loops = hole_loops(*mesh_);
  const CoverTest test(soup_, loops);
  std::vector<CoveredHole> holes;
  for (HoleLoop& loop : loops) {
    A3D_TRY(monitor.check());
    holes.push_back(cover(std::move(loop), test));
  }
  const std::vector<bool> are_left_open = are_open_patches(holes);
  std::vector<std::uint8_t> is_reported(components_.count);  // per component
  for (const CoveredHole& covered : holes) {
    const std::size_t patch = component(covered.hole.triangle);
    if (covered.cover.empty())
      report_.add(RepairStep::open_holes, covered.hole.loop.corners[0]);
    else if (!are_left_open[patch])
      close(covered);
    else if (std::exchange(is_reported[patch], 1) == 0)
      report_.add(RepairStep::open_patches, covered.hole.loop.corners[0]);
  }
  drop(are_left_open);
  return std::move(thin_);
}

}  // namespace

Result<std::vector<Triangle3>> close_holes(IndexedSoup& soup, const HoleLimits& limits, RepairReport& report,
                                           const Monitor& monitor) {
  return HoleCloser(soup, limits, report).run(monitor);
}

}  // namespace algebra3d
