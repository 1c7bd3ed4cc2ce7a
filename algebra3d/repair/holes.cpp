#include "algebra3d/repair/holes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <unordered_map>

#include "algebra3d/arrangement/contact.h"
#include "algebra3d/base/box3.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/halfedge/boxes.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/loop_triangulation.h"
#include "algebra3d/repair/scaled_triangles.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

using FacetTree = rtree::RTree<std::uint32_t>;

/// A hole's corners in the order in which new facets run along them, and the third corners of the facets there.
struct Hole {
  std::vector<std::uint32_t> vertices;
  Loop loop;
  std::uint32_t facet;  ///< at its edge
};

/// Parts of a loop between visits of the same vertex, each a loop by itself.
std::vector<std::vector<HalfedgeId>> simple_loops(const TriangleMesh& mesh, const std::vector<HalfedgeId>& loop) {
  std::vector<std::vector<HalfedgeId>> result;
  std::vector<HalfedgeId> path;
  std::unordered_map<std::uint32_t, std::size_t> places;  // in the path, of the origins
  for (const HalfedgeId h : loop) {
    places[mesh.origin(h).index()] = path.size();
    path.push_back(h);
    const auto known = places.find(mesh.target(h).index());
    if (known == places.end()) continue;
    const auto start = path.begin() + static_cast<std::ptrdiff_t>(known->second);
    for (auto g = start; g != path.end(); ++g) places.erase(mesh.origin(*g).index());
    result.emplace_back(start, path.end());
    path.erase(start, path.end());
  }
  return result;
}

Hole hole_of(const TriangleMesh& mesh, const std::vector<HalfedgeId>& boundary) {
  Hole hole;
  hole.facet = TriangleMesh::face(boundary[0]).index();
  // New facets run against the boundary.
  for (std::size_t i = boundary.size(); i-- > 0;) {
    const VertexId from = mesh.target(boundary[i]);
    hole.vertices.push_back(from.index());
    hole.loop.corners.push_back(mesh.point(from).approx);
    hole.loop.beyond.push_back(mesh.point(mesh.origin(TriangleMesh::prev(boundary[i]))).approx);
  }
  return hole;
}

Box3 box_of(const Hole& hole) {
  Box3 box;
  for (const Vec3& corner : hole.loop.corners) box.extend(corner);
  return box;
}

double diameter(const Hole& hole) {
  const Box3 box = box_of(hole);
  return length(box.max - box.min);
}

/// No point of the triangle is farther from its corners.
double reach(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  // Of that size, so that products neither overflow nor vanish.
  const Vec3 first = (1 / longest) * (b - a), second = (1 / longest) * (c - a);
  const double x = length(first), y = length(second - first), z = length(second);
  const double doubled_area = length(cross(first, second));
  // No circle around a triangle with such sides need be larger.
  if (!(doubled_area > 0)) return longest / std::numbers::sqrt3;
  // That of an acute triangle is the middle of the circle through its corners.
  if (2 >= x * x + y * y + z * z) return longest / 2;
  return x * y * z / (2 * doubled_area) * longest;
}

class HoleCloser {
 public:
  HoleCloser(FacetList& facets, const HoleLimits& limits, RepairReport& report)
      : facets_(facets),
        limits_(limits),
        report_(report),
        linked_(facets.mesh()),
        mesh_(*linked_),
        scale_(largest_coordinate(mesh_)) {}

  Status run(const Monitor& monitor);

 private:
  /// A hole and what covers it; nothing if it is too large.
  struct Covered {
    Hole hole;
    std::vector<TriangleMesh::Triangle> cover;
    bool cuts_surface;
  };

  Covered cover(Hole hole);
  bool cuts_surface(const std::vector<TriangleMesh::Triangle>& cover);
  bool cut_each_other(const TriangleMesh::Triangle& triangle, std::uint32_t facet) const;
  double area(const TriangleMesh::Triangle& t) const {
    return area_of({scale_.scaled(facets_.points[t[0]]), scale_.scaled(facets_.points[t[1]]),
                    scale_.scaled(facets_.points[t[2]])});
  }
  std::vector<bool> are_sheets(const FaceComponents& parts, const std::vector<Covered>& holes) const;
  void close(const Covered& covered);
  void drop(const std::vector<bool>& are_sheets, const FaceComponents& parts);
  FacetTree tree_around(const std::vector<Hole>& holes) const;

  FacetList& facets_;
  HoleLimits limits_;
  RepairReport& report_;
  std::shared_ptr<const TriangleMesh> linked_;  // the facets as given
  const TriangleMesh& mesh_;
  BinaryScale scale_;  // of areas
  FacetTree tree_;
};

/// Of the facets near the holes.
FacetTree HoleCloser::tree_around(const std::vector<Hole>& holes) const {
  std::vector<rtree::Entry<std::uint32_t>> hole_boxes, boxes;
  for (const Hole& hole : holes) hole_boxes.push_back({box_of(hole), 0});
  const FacetTree hole_tree = FacetTree::bulk_load(hole_boxes);
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
    const Box3 box = box_of_triangle(mesh_.corners(FaceId(f)));
    auto near = hole_tree.window(box);
    if (near.next()) boxes.push_back({box, f});
  }
  return FacetTree::bulk_load(boxes);
}

/// True if they have more in common than common corners and edges.
bool HoleCloser::cut_each_other(const TriangleMesh::Triangle& triangle, std::uint32_t facet) const {
  const TriangleMesh::Triangle& other = facets_.triangles[facet];
  const auto common =
      std::ranges::count_if(triangle, [&](std::uint32_t c) { return std::ranges::find(other, c) != other.end(); });
  const auto corners = [&](const TriangleMesh::Triangle& t) {
    return TriangleRef{facets_.points[t[0]], facets_.points[t[1]], facets_.points[t[2]]};
  };
  const Contact contact = intersect_triangles(corners(triangle), corners(other));
  if (common == 0) return contact != Contact::none;
  return common == 1 ? contact > Contact::point : contact > Contact::segment;
}

/// Covers of many corners may be near to many facets; what is not looked at is taken for no cut.
bool HoleCloser::cuts_surface(const std::vector<TriangleMesh::Triangle>& cover) {
  std::size_t looks_left = 10'000 + 100 * cover.size();
  for (const TriangleMesh::Triangle& triangle : cover) {
    const TriangleRef corners{facets_.points[triangle[0]], facets_.points[triangle[1]], facets_.points[triangle[2]]};
    if (collinear(corners[0], corners[1], corners[2])) return true;
    for (const std::uint32_t facet : tree_.window(box_of_triangle(corners))) {
      if (looks_left-- == 0) return false;
      if (cut_each_other(triangle, facet)) return true;
    }
  }
  return false;
}

HoleCloser::Covered HoleCloser::cover(Hole hole) {
  std::vector<TriangleMesh::Triangle> first;
  if (diameter(hole) > limits_.largest) return {std::move(hole), {}, false};
  for (const LoopMeasure measure : {LoopMeasure::bend, LoopMeasure::area}) {
    std::vector<TriangleMesh::Triangle> triangles = triangulate_loop(hole.loop, measure);
    for (TriangleMesh::Triangle& triangle : triangles)
      for (std::uint32_t& corner : triangle) corner = hole.vertices[corner];
    if (!cuts_surface(triangles)) return {std::move(hole), std::move(triangles), false};
    if (first.empty()) first = std::move(triangles);
  }
  return {std::move(hole), std::move(first), true};
}

/// Per connected part: it has one hole, whose cover cuts it and is too large for it.
std::vector<bool> HoleCloser::are_sheets(const FaceComponents& parts, const std::vector<Covered>& holes) const {
  constexpr double kMostOfArea = 0.75;
  std::vector<double> own(parts.count), added(parts.count);
  std::vector<std::uint32_t> hole_count(parts.count);
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) own[parts.of_face[f]] += area(facets_.triangles[f]);
  for (const Covered& covered : holes) {
    const std::uint32_t part = parts.of_face[covered.hole.facet];
    ++hole_count[part];
    if (!covered.cuts_surface) continue;
    for (const TriangleMesh::Triangle& triangle : covered.cover) added[part] += area(triangle);
  }
  std::vector<bool> result;
  for (std::size_t part = 0; part < parts.count; ++part)
    result.push_back(hole_count[part] == 1 && added[part] > kMostOfArea * own[part]);
  return result;
}

void HoleCloser::close(const Covered& covered) {
  HoleCover report{covered.hole.loop.corners[0], 0, {}};
  for (const auto& [a, b, c] : covered.cover) {
    report.triangles.push_back({facets_.points[a], facets_.points[b], facets_.points[c]});
    report.farthest = std::max(report.farthest, reach(facets_.points[a], facets_.points[b], facets_.points[c]));
    facets_.triangles.push_back({a, b, c});
  }
  facets_.changed();
  report_.add(std::move(report));
}

/// The sheets, if they are to go and there is something else.
void HoleCloser::drop(const std::vector<bool>& are_sheets, const FaceComponents& parts) {
  if (std::ranges::count(are_sheets, true) == 0) return;
  if (!limits_.drops_sheets || std::ranges::count(are_sheets, false) == 0) {
    report_.has_kept_sheets = true;
    return;
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < facets_.triangles.size(); ++f)
    if (f >= mesh_.face_count() || !are_sheets[parts.of_face[f]]) facets_.triangles[kept++] = facets_.triangles[f];
  facets_.triangles.resize(kept);
  facets_.changed();
}

Status HoleCloser::run(const Monitor& monitor) {
  std::vector<Hole> found;
  for (const BoundaryLoop& boundary : boundary_loops(mesh_))
    for (const auto& loop : simple_loops(mesh_, boundary.halfedges))
      if (loop.size() >= 3) found.push_back(hole_of(mesh_, loop));
  tree_ = tree_around(found);
  std::vector<Covered> holes;
  for (Hole& hole : found) {
    RETURN_IF_ERROR(monitor.check());
    holes.push_back(cover(std::move(hole)));
  }
  const FaceComponents parts = connected_components(mesh_);
  const std::vector<bool> are_left_open = are_sheets(parts, holes);
  for (const Covered& covered : holes) {
    if (covered.cover.empty())
      report_.add(RepairStep::open_holes, covered.hole.loop.corners[0]);
    else if (are_left_open[parts.of_face[covered.hole.facet]])
      report_.add(RepairStep::sheets, covered.hole.loop.corners[0]);
    else
      close(covered);
  }
  drop(are_left_open, parts);
  return {};
}

}  // namespace

Status close_holes(FacetList& facets, const HoleLimits& limits, RepairReport& report, const Monitor& monitor) {
  return HoleCloser(facets, limits, report).run(monitor);
}

}  // namespace algebra3d
