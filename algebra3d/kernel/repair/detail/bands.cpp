#include "algebra3d/kernel/repair/detail/bands.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/id_vector.h"
#include "base/propagate.h"
#include "rtree/rtree.h"

namespace algebra3d {
namespace {

/// A BandLoop.
using LoopId = StrongId<struct LoopTag>;

/// A simple closed boundary loop with the data for joining it to another one by a band. In the direction in which new
/// triangles run along it.
struct BandLoop {
  std::vector<VertexId> vertices;
  std::vector<Vec3> normals;    ///< per vertex: the unit normal of the triangle at the edge to the next one
  std::uint32_t component = 0;  ///< of the surface; see FaceComponents
  Box3 box;                     ///< scaled, like the area
  double area = 0;              ///< lower bound of the area of any cover of the loop, scaled

  double diameter() const { return length(box.max - box.min); }
};

/// Triangles between two loops.
struct Band {
  LoopId first, second;
  bool flips_one = false;  ///< the two components have opposite orientations
  std::vector<TriangleMesh::Triangle> triangles;
  double area = 0;
  double bend = 0;  ///< mean cosine of the angles between its triangles and those beyond the loops; -1: folded back
};

bool visits_a_vertex_twice(std::vector<VertexId> vertices) {
  std::ranges::sort(vertices);
  return std::ranges::adjacent_find(vertices) != vertices.end();
}

/// The box, and the area of the flattest cover: that of the vector area.
void measure(BandLoop& loop, const TriangleMesh& mesh, const BinaryScale& scale) {
  const auto point = [&](VertexId v) { return scale.scaled(mesh.point(v).approx); };
  const Vec3 first = point(loop.vertices[0]);
  Vec3 doubled;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Vec3 from = point(loop.vertices[i]), to = point(loop.vertices[(i + 1) % loop.vertices.size()]);
    loop.box.extend(from);
    doubled = doubled + cross(from - first, to - first);
  }
  loop.area = length(doubled) / 2;
}

std::optional<BandLoop> loop_of(const TriangleMesh& mesh, const BoundaryLoop& boundary,
                                const FaceComponents& components, const BinaryScale& scale) {
  BandLoop loop;
  loop.component = components.of_face[TriangleMesh::face(boundary.halfedges[0]).index()];
  for (std::size_t i = boundary.halfedges.size(); i-- > 0;) {
    const HalfedgeId h = boundary.halfedges[i];
    loop.vertices.push_back(mesh.target(h));
    loop.normals.push_back(unit_normal(scale.scaled(mesh, TriangleMesh::face(h))));
  }
  if (loop.vertices.size() < 3 || visits_a_vertex_twice(loop.vertices)) return std::nullopt;
  measure(loop, mesh, scale);
  return loop;
}

/// One loop on the way around a band.
struct LoopWalk {
  std::vector<Vec3> points;  // scaled
  std::vector<VertexId> vertices;
  std::vector<Vec3> normals;  // per vertex: beyond the edge to the next one
  std::size_t at = 0, left = 0;

  std::size_t next() const { return (at + 1) % vertices.size(); }
  void step() {
    at = next();
    --left;
  }
};

class BandWalk {
 public:
  BandWalk(const IdVector<LoopId, BandLoop>& loops, const std::vector<Vec3>& points, const BinaryScale& scale,
           Band& band);

  void run();

 private:
  void start_at_nearest();
  double distance(std::size_t i, std::size_t j) const { return length(second_.points[j] - first_.points[i]); }
  void add(const TriangleMesh::Triangle& triangle, const Triangle3& corners, double edge, const Vec3& beyond);
  void step_along_first();
  void step_along_second();

  LoopWalk first_, second_;
  Band& band_;
  double edge_sum_ = 0;
};

BandWalk::BandWalk(const IdVector<LoopId, BandLoop>& loops, const std::vector<Vec3>& points, const BinaryScale& scale,
                   Band& band)
    : band_(band) {
  for (const auto& [walk, id] : {std::pair(&first_, band.first), std::pair(&second_, band.second)}) {
    walk->vertices = loops[id].vertices;
    walk->normals = loops[id].normals;
    walk->left = walk->vertices.size();
  }
  if (!band.flips_one) {
    std::ranges::reverse(second_.vertices);
    // Normals are of the edges from each vertex to the next.
    std::ranges::reverse(second_.normals);
    std::rotate(second_.normals.begin(), second_.normals.begin() + 1, second_.normals.end());
  }
  for (LoopWalk* walk : {&first_, &second_})
    for (const VertexId v : walk->vertices) walk->points.push_back(scale.scaled(points[v.index()]));
}

void BandWalk::start_at_nearest() {
  for (std::size_t i = 0; i < first_.points.size(); ++i)
    for (std::size_t j = 0; j < second_.points.size(); ++j)
      if (distance(i, j) < distance(first_.at, second_.at)) first_.at = i, second_.at = j;
}

void BandWalk::add(const TriangleMesh::Triangle& triangle, const Triangle3& corners, double edge, const Vec3& beyond) {
  band_.triangles.push_back(triangle);
  band_.area += area_of(corners);
  band_.bend += edge * dot(unit_normal(corners), beyond);
  edge_sum_ += edge;
}

void BandWalk::step_along_first() {
  const std::size_t i = first_.at, next = first_.next(), j = second_.at;
  add({first_.vertices[i].index(), first_.vertices[next].index(), second_.vertices[j].index()},
      {first_.points[i], first_.points[next], second_.points[j]}, length(first_.points[next] - first_.points[i]),
      first_.normals[i]);
  first_.step();
}

void BandWalk::step_along_second() {
  const std::size_t i = first_.at, j = second_.at, next = second_.next();
  add({second_.vertices[next].index(), second_.vertices[j].index(), first_.vertices[i].index()},
      {second_.points[next], second_.points[j], first_.points[i]}, length(second_.points[next] - second_.points[j]),
      (band_.flips_one ? -1.0 : 1.0) * second_.normals[j]);
  second_.step();
}

void BandWalk::run() {
  start_at_nearest();
  while (first_.left + second_.left > 0) {
    const bool first_is_shorter = distance(first_.next(), second_.at) <= distance(first_.at, second_.next());
    if (second_.left == 0 || (first_.left > 0 && first_is_shorter))
      step_along_first();
    else
      step_along_second();
  }
  band_.bend = edge_sum_ > 0 ? band_.bend / edge_sum_ : -1;
}

/// The simple boundary loops of a mesh. Cost: linear.
IdVector<LoopId, BandLoop> band_loops(const TriangleMesh& mesh, const FaceComponents& components,
                                      const BinaryScale& scale) {
  IdVector<LoopId, BandLoop> loops;
  for (const BoundaryLoop& boundary : boundary_loops(mesh)) {
    if (!boundary.is_closed) continue;
    if (auto loop = loop_of(mesh, boundary, components, scale)) loops.push_back(*std::move(loop));
  }
  return loops;
}

/// The band between two loops. It begins at their two nearest vertices and takes the shorter diagonal at each step. It
/// follows the first loop forwards and the second backwards, or both forwards if one component is to be flipped.
Band band_between(const IdVector<LoopId, BandLoop>& loops, LoopId first, LoopId second, bool flips_one,
                  const std::vector<Vec3>& points, const BinaryScale& scale) {
  Band band{first, second, flips_one, {}, 0, 0};
  BandWalk(loops, points, scale, band).run();
  return band;
}

class BandCloser {
 public:
  BandCloser(IndexedSoup& soup, double largest, RepairReport& report)
      : soup_(soup),
        largest_(largest),
        report_(report),
        mesh_(soup.mesh()),
        components_(connected_components(*mesh_)),
        scale_(largest_coordinate(*mesh_)),
        loops_(band_loops(*mesh_, components_, scale_)) {}

  /// False if there are no bands.
  Result<bool> run(const Monitor& monitor);

 private:
  bool are_close(const BandLoop& a, const BandLoop& b) const;
  std::optional<Band> best_band(LoopId first, LoopId second) const;
  Result<std::vector<Band>> candidates(const Monitor& monitor) const;
  std::uint32_t smaller_component(const Band& band) const;
  void flip_component(Band& band);
  void add(Band band);

  IndexedSoup& soup_;
  double largest_;
  RepairReport& report_;
  std::shared_ptr<const TriangleMesh> mesh_;  // of the soup as given
  FaceComponents components_;
  BinaryScale scale_;
  IdVector<LoopId, BandLoop> loops_;
};

/// True if their boxes are nearly the same, and the loops are no larger than they may be.
bool BandCloser::are_close(const BandLoop& a, const BandLoop& b) const {
  constexpr double kOfDiameter = 0.5;
  constexpr std::size_t kMostPairs = 4'000'000;
  const double most = kOfDiameter * std::min(a.diameter(), b.diameter());
  Box3 both = a.box;
  both.extend(b.box.min);
  both.extend(b.box.max);
  return length(a.box.min - b.box.min) <= most && length(a.box.max - b.box.max) <= most &&
         scale_.unscaled(length(both.max - both.min)) <= largest_ &&
         a.vertices.size() * b.vertices.size() <= kMostPairs;
}

/// None if both loops may as well be closed by themselves.
std::optional<Band> BandCloser::best_band(LoopId first, LoopId second) const {
  constexpr double kMuchLess = 0.5, kFoldedBack = -0.7;
  if (!are_close(loops_[first], loops_[second])) return std::nullopt;
  Band best = band_between(loops_, first, second, false, soup_.points, scale_);
  Band flipped = band_between(loops_, first, second, true, soup_.points, scale_);
  if (flipped.area < best.area) {
    // Within one component it would twist the surface.
    if (loops_[first].component == loops_[second].component) return std::nullopt;
    best = std::move(flipped);
  }
  // A band that is folded back lies upon the surface between the loops, as between those of a ring.
  if (best.bend < kFoldedBack) return std::nullopt;
  if (best.area < kMuchLess * (loops_[first].area + loops_[second].area)) return best;
  return std::nullopt;
}

/// All bands that are worth it, in order of area.
Result<std::vector<Band>> BandCloser::candidates(const Monitor& monitor) const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (const LoopId i : loops_.ids()) entries.push_back({Box3::of(loops_[i].box.min), i.index()});
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(entries);
  std::vector<Band> result;
  for (const LoopId i : loops_.ids()) {
    A3D_TRY(monitor.check());
    const double reach = loops_[i].diameter() / 2;
    Box3 window = Box3::of(loops_[i].box.min);
    window.min = window.min - Vec3{reach, reach, reach};
    window.max = window.max + Vec3{reach, reach, reach};
    for (const std::uint32_t other : tree.window(window))
      if (LoopId(other) > i)
        if (auto band = best_band(i, LoopId(other))) result.push_back(*std::move(band));
  }
  std::ranges::sort(result, {}, [](const Band& band) { return std::tuple(band.area, band.first, band.second); });
  return result;
}

std::uint32_t BandCloser::smaller_component(const Band& band) const {
  const std::uint32_t first = loops_[band.first].component, second = loops_[band.second].component;
  double more = 0;  // area of the first, less that of the second
  for (const FaceId face : faces(*mesh_)) {
    const std::uint32_t component = components_.of_face[face.index()];
    if (component == first) more += area_of(scale_.scaled(*mesh_, face));
    if (component == second) more -= area_of(scale_.scaled(*mesh_, face));
  }
  return more < 0 ? first : second;
}

/// Flips the smaller component of the two; the band, too, if it follows that one.
void BandCloser::flip_component(Band& band) {
  const std::uint32_t component = smaller_component(band);
  for (const FaceId face : faces(*mesh_)) {
    if (components_.of_face[face.index()] != component) continue;
    soup_.flip(face);
    report_.add(RepairStep::flipped_triangles, soup_.middle(face));
  }
  if (component == loops_[band.first].component)
    for (TriangleMesh::Triangle& triangle : band.triangles) std::swap(triangle[1], triangle[2]);
}

void BandCloser::add(Band band) {
  if (band.flips_one) flip_component(band);
  HoleCover cover{soup_.point(loops_[band.first].vertices[0]), 0, {}};
  for (const TriangleMesh::Triangle& t : band.triangles) {
    const std::array<Vec3, 3> corners{soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]};
    for (std::size_t i = 0; i < 3; ++i)
      cover.farthest = std::max(cover.farthest, length(corners[(i + 1) % 3] - corners[i]) / std::numbers::sqrt3);
    cover.triangles.push_back(corners);
  }
  soup_.add(band.triangles);
  report_.add(std::move(cover));
}

Result<bool> BandCloser::run(const Monitor& monitor) {
  A3D_ASSIGN(std::vector<Band> bands, candidates(monitor));
  IdVector<LoopId, bool> is_closed(loops_.size());
  std::vector<bool> has_changed(components_.count);
  bool has_some = false;
  for (Band& band : bands) {
    const std::uint32_t first = loops_[band.first].component, second = loops_[band.second].component;
    if (is_closed[band.first] || is_closed[band.second]) continue;
    // Components and their orientations are known anew in the next round.
    if (has_changed[first] || has_changed[second]) continue;
    is_closed[band.first] = is_closed[band.second] = true;
    if (first != second) has_changed[first] = has_changed[second] = true;
    add(std::move(band));
    has_some = true;
  }
  return has_some;
}

}  // namespace

Result<bool> close_bands(IndexedSoup& soup, double largest, RepairReport& report, const Monitor& monitor) {
  constexpr int kMostRounds = 20;
  bool has_some = false;
  for (int round = 0; round < kMostRounds; ++round) {
    A3D_ASSIGN(const bool found, BandCloser(soup, largest, report).run(monitor));
    if (!found) break;
    has_some = true;
  }
  return has_some;
}

}  // namespace algebra3d
