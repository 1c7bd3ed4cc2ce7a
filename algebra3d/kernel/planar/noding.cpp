#include "algebra3d/kernel/planar/noding.h"

#include <algorithm>
#include <numeric>

#include "algebra3d/kernel/planar/detail/constraints.h"
#include "algebra3d/kernel/planar/detail/delaunay.h"
#include "algebra3d/kernel/planar/segment_text.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using planar::HalfedgeId;
using planar::PlanePoints;
using planar::Subdivision;
using planar::VertexId;

/// An edge and how often it occurs, less those of the opposite direction.
struct CountedEdge {
  VertexId from, to;
  std::int64_t count;
};

/// Edges between vertices, each once, without those that cancel; `from` is the lower number.
std::vector<CountedEdge> counted(const PlanePoints& points, std::span<const DirectedEdge> edges) {
  std::vector<CountedEdge> result;
  result.reserve(edges.size());
  for (const auto& [first, second] : edges) {
    const VertexId from = points.vertex_of(first), to = points.vertex_of(second);
    if (from != to) result.push_back(from < to ? CountedEdge{from, to, 1} : CountedEdge{to, from, -1});
  }
  std::sort(result.begin(), result.end(), [](const CountedEdge& a, const CountedEdge& b) {
    poll_interruption();
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  std::size_t size = 0;
  for (const CountedEdge& edge : result) {
    if (size > 0 && result[size - 1].from == edge.from && result[size - 1].to == edge.to)
      result[size - 1].count += edge.count;
    else
      result[size++] = edge;
  }
  result.resize(size);
  std::erase_if(result, [](const CountedEdge& edge) { return edge.count == 0; });
  return result;
}

/// Puts edges into the triangulation of all points and counts what comes to lie on each of its edges.
class Noder {
 public:
  Noder(const PlanePoints& points, Subdivision& triangulation)
      : points_(points), triangulation_(triangulation), inserter_(points, triangulation) {}

  Status insert(const CountedEdge& edge);
  std::vector<DirectedEdge> result() const;

 private:
  /// The load of an edge of the triangulation; its number and one is the mark of the two half-edges.
  struct Load {
    HalfedgeId halfedge;
    std::int64_t count;  // in the direction of the half-edge
    VertexId from, to;   // ends of the first edge that lies here
  };

  const PlanePoints& points_;
  Subdivision& triangulation_;
  planar::ConstraintInserter inserter_;
  std::vector<Load> loads_;
};

Status Noder::insert(const CountedEdge& edge) {
  if (!inserter_.insert(edge.from, edge.to)) {
    const Load& other = loads_[triangulation_.mark(inserter_.crossing()) - 1];
    return Error{ErrorCode::invalid_value, "segment {} crosses segment {} in none of the points",
                 planar::segment_text(points_[edge.from], points_[edge.to]),
                 planar::segment_text(points_[other.from], points_[other.to])};
  }
  for (const HalfedgeId h : inserter_.along()) {
    const std::uint32_t mark = triangulation_.mark(h);
    if (mark != 0) {
      Load& load = loads_[mark - 1];
      load.count += load.halfedge == h ? edge.count : -edge.count;
      continue;
    }
    loads_.push_back({h, edge.count, edge.from, edge.to});
    for (const HalfedgeId side : {h, Subdivision::twin(h)})
      triangulation_.set_mark(side, static_cast<std::uint32_t>(loads_.size()));
  }
  return {};
}

std::vector<DirectedEdge> Noder::result() const {
  std::vector<DirectedEdge> edges;
  for (const Load& load : loads_) {
    const HalfedgeId h = load.count > 0 ? load.halfedge : Subdivision::twin(load.halfedge);
    const DirectedEdge edge{points_.index(triangulation_.origin(h)), points_.index(triangulation_.target(h))};
    edges.insert(edges.end(), static_cast<std::size_t>(std::abs(load.count)), edge);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

Result<std::vector<DirectedEdge>> noded(const PointArray& points, std::span<const DirectedEdge> edges,
                                        const Monitor& monitor) {
  std::vector<std::uint32_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0U);
  const PlanePoints vertices(points, indices);
  A3D_ASSIGN(Subdivision triangulation, planar::delaunay(vertices, monitor));
  const std::vector<CountedEdge> counted_edges = counted(vertices, edges);
  Stage stage(monitor, "dividing segments", counted_edges.size());
  Noder noder(vertices, triangulation);
  for (const CountedEdge& edge : counted_edges) {
    if (!stage.begin_step()) return Monitor::interrupted();
    A3D_TRY(noder.insert(edge));
  }
  return noder.result();
}

}  // namespace algebra3d
