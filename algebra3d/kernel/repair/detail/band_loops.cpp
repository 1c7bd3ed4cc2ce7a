#include "algebra3d/kernel/repair/detail/band_loops.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace algebra3d {
namespace {

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

}  // namespace

IdVector<LoopId, BandLoop> band_loops(const TriangleMesh& mesh, const FaceComponents& components,
                                      const BinaryScale& scale) {
  IdVector<LoopId, BandLoop> loops;
  for (const BoundaryLoop& boundary : boundary_loops(mesh)) {
    if (!boundary.is_closed) continue;
    if (auto loop = loop_of(mesh, boundary, components, scale)) loops.push_back(*std::move(loop));
  }
  return loops;
}

Band band_between(const IdVector<LoopId, BandLoop>& loops, LoopId first, LoopId second, bool flips_one,
                  const std::vector<Vec3>& points, const BinaryScale& scale) {
  Band band{first, second, flips_one, {}, 0, 0};
  BandWalk(loops, points, scale, band).run();
  return band;
}

}  // namespace algebra3d
