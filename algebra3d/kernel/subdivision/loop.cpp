#include "algebra3d/kernel/exact/trigonometry.h"
#include "algebra3d/kernel/subdivision/detail/loop_rules.h"
#include "algebra3d/kernel/subdivision/detail/steps.h"

namespace algebra3d::subdivision {

LoopWeightTable::LoopWeightTable(LoopWeights weights) : weights_(weights) {
  for (std::size_t valence = 1; valence < kKnown; ++valence) known_[valence] = weight(weights, valence);
}

double LoopWeightTable::weight(LoopWeights weights, std::size_t valence) {
  const auto n = static_cast<double>(valence);
  if (weights == LoopWeights::warren) return valence == 3 ? 3.0 / 16 : 3 / (8 * n);
  const double inner = 3.0 / 8 + circle_point(1, static_cast<std::uint32_t>(valence)).cosine / 4;
  return (5.0 / 8 - inner * inner) / n;
}

Result<PolygonMesh> loop_step(const PolygonMesh& mesh, LoopWeights weights, const Monitor& monitor,
                              const std::string& what) {
  const TriangleView view(mesh);
  const LoopWeightTable table(weights);
  const auto edge_point = [&](std::uint32_t h, std::uint32_t) {
    const Vec3 ends = view.origin_point(h) + view.target_point(h);
    const std::uint32_t o = view.opposite(h);
    if (o == kNone) return 0.5 * ends;
    return 0.375 * ends + 0.125 * (view.origin_point(view.prev(h)) + view.origin_point(view.prev(o)));
  };
  const auto vertex_point = [&](std::uint32_t v) {
    if (view.is_boundary_vertex(v)) return 0.75 * view.point(v) + 0.125 * boundary_neighbours_of(view, v);
    const NeighbourSum neighbours = neighbours_of(view, v);
    const double weight = table(neighbours.count);
    return (1 - static_cast<double>(neighbours.count) * weight) * view.point(v) + weight * neighbours.sum;
  };
  return split_triangles(mesh, monitor, what, edge_point, vertex_point);
}

}  // namespace algebra3d::subdivision
