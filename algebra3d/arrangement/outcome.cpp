#include "algebra3d/arrangement/outcome.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <tuple>

#include "algebra3d/arrangement/triangulation.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A boundary edge of the kept part of a plane, with this part to its left, seen from the front of the plane.
struct KeptEdge {
  std::uint32_t plane;
  bool is_flipped;  ///< the part's own front is the back of the plane
  std::uint32_t from, to;

  auto region() const { return std::tuple(plane, is_flipped); }
  friend auto operator<=>(const KeptEdge&, const KeptEdge&) = default;
};

/// A corner of the result: a vertex of the arrangement, or of an operand where no such is.
class CornerNumbers {
 public:
  explicit CornerNumbers(const Skeleton& skeleton)
      : skeleton_(skeleton),
        of_vertex_(skeleton.vertices().size(), kNone),
        of_operand_vertex_(skeleton.operands().vertex_count(), kNone) {}

  std::uint32_t of_vertex(std::uint32_t vertex) {
    if (of_vertex_[vertex] == kNone) of_vertex_[vertex] = add(skeleton_.vertices()[vertex]);
    return of_vertex_[vertex];
  }
  std::uint32_t of_operand_corner(std::uint32_t halfedge) {
    const std::uint32_t corner = skeleton_.operands().vertex(halfedge);
    if (of_operand_vertex_[corner] == kNone) {
      const std::uint32_t vertex = skeleton_.vertex_of_corner(corner);
      of_operand_vertex_[corner] = vertex != kNone ? of_vertex(vertex) : add(skeleton_.operands().point_of(halfedge));
    }
    return of_operand_vertex_[corner];
  }
  PointArray take_points() { return std::move(points_); }

 private:
  std::uint32_t add(const PointRef& point) {
    points_.push_back(point.is_double() ? ExactPoint(point.approx) : ExactPoint(*point.exact));
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  const Skeleton& skeleton_;
  std::vector<std::uint32_t> of_vertex_, of_operand_vertex_;
  PointArray points_;
};

class OutcomeBuilder {
 public:
  OutcomeBuilder(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches,
                 const Classification& classification, const KeepRule& rule)
      : skeleton_(skeleton),
        pieces_(pieces),
        patches_(patches),
        classification_(classification),
        rule_(rule),
        corners_(skeleton),
        is_fixed_(skeleton.vertices().size()) {}

  TriangleMesh run();

 private:
  /// 1 if a face is kept whose front is that of the windings `front`, -1 if it is kept turned over, 0 if it is not
  /// kept.
  int keeps(const Windings& front, const Windings& back) const {
    return static_cast<int>(rule_(back)) - static_cast<int>(rule_(front));
  }
  void take_patches();
  void collect_edges();
  void find_middles();
  void straighten();
  void triangulate_regions();

  const Skeleton& skeleton_;
  const Pieces& pieces_;
  const Patches& patches_;
  const Classification& classification_;
  const KeepRule& rule_;
  CornerNumbers corners_;
  std::vector<bool> is_fixed_;   // per vertex: a corner of a patch's face
  std::vector<bool> is_middle_;  // per vertex: in the middle of a straight edge, where nothing else ends
  std::vector<KeptEdge> edges_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

void OutcomeBuilder::take_patches() {
  const Operands& operands = skeleton_.operands();
  std::vector<int> kept(patches_.patches.size());
  for (std::size_t p = 0; p < kept.size(); ++p) {
    Windings step{};
    step[operands.group(patches_.patches[p].operand)] = 1;
    kept[p] = keeps(classification_.patch_fronts[p], classification_.patch_fronts[p] + step);
  }
  for (std::uint32_t face = 0; face < patches_.of_face.size(); ++face) {
    const std::uint32_t patch = patches_.of_face[face];
    if (patch == kNone || kept[patch] == 0) continue;
    TriangleMesh::Triangle triangle{};
    for (std::uint32_t i = 0; i < 3; ++i) {
      triangle[i] = corners_.of_operand_corner(3 * face + i);
      const std::uint32_t vertex = skeleton_.vertex_of_corner(operands.vertex(3 * face + i));
      if (vertex != kNone) is_fixed_[vertex] = true;
    }
    if (kept[patch] < 0) std::swap(triangle[1], triangle[2]);
    triangles_.push_back(triangle);
  }
}

void OutcomeBuilder::collect_edges() {
  for (std::uint32_t p = 0; p < pieces_.pieces.size(); ++p) {
    const Piece& piece = pieces_.pieces[p];
    std::array<int, 2> kept{};
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (piece.steps[side] == Windings{}) continue;
      const Windings& front = classification_.cell_fronts[2 * p + side];
      kept[side] = keeps(front, front + piece.steps[side]);
    }
    if (kept[0] == kept[1]) continue;
    if (kept[0] != 0) edges_.push_back({piece.plane, kept[0] < 0, piece.u, piece.v});
    if (kept[1] != 0) edges_.push_back({piece.plane, kept[1] < 0, piece.v, piece.u});
  }
}

/// A vertex is in the middle if all kept edges that it ends run to the same two other vertices, on one line with it.
void OutcomeBuilder::find_middles() {
  struct Neighbours {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 2> vertices{kNone, kNone};
  };
  std::vector<Neighbours> neighbours(skeleton_.vertices().size());
  const auto note = [&](std::uint32_t vertex, std::uint32_t other) {
    Neighbours& at = neighbours[vertex];
    if (at.count > 2 || at.vertices[0] == other || at.vertices[1] == other) return;
    if (at.count < 2) at.vertices[at.count] = other;
    ++at.count;
  };
  for (const KeptEdge& edge : edges_) {
    note(edge.from, edge.to);
    note(edge.to, edge.from);
  }
  is_middle_.resize(neighbours.size());
  const VertexPool& points = skeleton_.vertices();
  for (std::uint32_t v = 0; v < neighbours.size(); ++v)
    is_middle_[v] = neighbours[v].count == 2 && !is_fixed_[v] &&
                    collinear(points[neighbours[v].vertices[0]], points[v], points[neighbours[v].vertices[1]]);
}

/// Replaces runs of edges through middles by one edge each.
void OutcomeBuilder::straighten() {
  std::ranges::sort(edges_);
  std::vector<KeptEdge> straight;
  for (const KeptEdge& edge : edges_) {
    if (is_middle_[edge.from]) continue;
    KeptEdge whole = edge;
    while (is_middle_[whole.to])
      whole.to = std::ranges::lower_bound(edges_, KeptEdge{edge.plane, edge.is_flipped, whole.to, 0})->to;
    straight.push_back(whole);
  }
  edges_ = std::move(straight);
}

void OutcomeBuilder::triangulate_regions() {
  std::vector<DirectedEdge> region;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
    region.clear();
    triangles.clear();
    for (; end < edges_.size() && edges_[end].region() == edges_[begin].region(); ++end)
      region.emplace_back(edges_[end].from, edges_[end].to);
    triangulate(skeleton_.vertices(), skeleton_.facets().planes()[edges_[begin].plane].projection, region, triangles);
    for (TriangleMesh::Triangle triangle : triangles) {
      for (std::uint32_t& corner : triangle) corner = corners_.of_vertex(corner);
      if (edges_[begin].is_flipped) std::swap(triangle[1], triangle[2]);
      triangles_.push_back(triangle);
    }
  }
}

TriangleMesh OutcomeBuilder::run() {
  take_patches();
  collect_edges();
  find_middles();
  straighten();
  triangulate_regions();
  return TriangleMesh(corners_.take_points(), triangles_);
}

}  // namespace

TriangleMesh build_outcome(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches,
                           const Classification& classification, const KeepRule& rule) {
  return OutcomeBuilder(skeleton, pieces, patches, classification, rule).run();
}

}  // namespace algebra3d::arrangement
