#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "algebra3d/kernel/exact/trigonometry.h"
#include "algebra3d/kernel/subdivision/detail/creases.h"
#include "algebra3d/kernel/subdivision/detail/provenance.h"
#include "algebra3d/kernel/subdivision/detail/triangle_split.h"

namespace algebra3d::subdivision {
namespace {

/// The weight of a neighbour in the new position of an interior vertex with n neighbours. Both are 1/16 for n = 6.
enum class LoopWeights : std::uint8_t {
  loop,   ///< (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n. Source: [loop1987]
  warren  ///< 3/16 for n = 3, else 3 / (8 n). Source: [warren2001]
};
constexpr std::array<std::string_view, 2> kLoopWeightNames{"loop", "warren"};

/// The weight of each neighbour of an interior vertex by the number of its edges.
class LoopWeightTable {
 public:
  explicit LoopWeightTable(std::size_t variant) : weights_(static_cast<LoopWeights>(variant)) {
    for (std::size_t valence = 1; valence < kKnown; ++valence) known_[valence] = weight(weights_, valence);
  }
  double operator()(std::size_t valence) const {
    return valence < kKnown ? known_[valence] : weight(weights_, valence);
  }

 private:
  static constexpr std::size_t kKnown = 64;
  static double weight(LoopWeights weights, std::size_t valence) {
    const auto n = static_cast<double>(valence);
    if (weights == LoopWeights::warren) return valence == 3 ? 3.0 / 16 : 3 / (8 * n);
    const double inner = 3.0 / 8 + circle_point(1, static_cast<std::uint32_t>(valence)).cosine / 4;
    return (5.0 / 8 - inner * inner) / n;
  }

  LoopWeights weights_;
  std::array<double, kKnown> known_ = {};
};

/// The sum of the neighbours of an interior vertex, and their number.
struct NeighbourSum {
  Vec3 sum;
  std::size_t count = 0;
};
NeighbourSum neighbours_of(const TriangleView& view, VertexId v) {
  NeighbourSum result;
  view.for_each_outgoing(view.outgoing(v), [&](HalfedgeId h) {
    result.sum = result.sum + view.target_point(h);
    ++result.count;
  });
  return result;
}

/// The sum of the two neighbours of a boundary vertex along the boundary.
Vec3 boundary_neighbours_of(const TriangleView& view, VertexId v) {
  return view.target_point(view.outgoing(v)) + view.point(view.boundary_predecessor(v));
}

Result<PolygonMesh> loop_step(const StepInput& input) {
  const TriangleView view(input.mesh);
  const LoopWeightTable table(input.variant);
  const auto edge_point = [&](HalfedgeId h, EdgeNumber) {
    const Vec3 ends = view.origin_point(h) + view.target_point(h);
    const HalfedgeId o = view.opposite(h);
    if (o.is_none()) return 0.5 * ends;
    return 0.375 * ends + 0.125 * (view.origin_point(view.prev(h)) + view.origin_point(view.prev(o)));
  };
  const auto vertex_point = [&](VertexId v) {
    if (view.is_boundary_vertex(v)) return 0.75 * view.point(v) + 0.125 * boundary_neighbours_of(view, v);
    const NeighbourSum neighbours = neighbours_of(view, v);
    const double weight = table(neighbours.count);
    return (1 - static_cast<double>(neighbours.count) * weight) * view.point(v) + weight * neighbours.sum;
  };
  if (input.sharpness == nullptr) return split_triangles(input, edge_point, vertex_point);
  const Sharpness& sharpness = *input.sharpness;
  return split_triangles(
      input,
      [&](HalfedgeId h, EdgeNumber e) {
        const Vec3 smooth = edge_point(h, e);
        if (sharpness.edges[h.index()] <= 0) return smooth;
        return creased_edge_point(sharpness.edges[h.index()], smooth,
                                  0.5 * (view.origin_point(h) + view.target_point(h)));
      },
      [&](VertexId v) { return creased_vertex_point(view, sharpness, v, [&] { return vertex_point(v); }); });
}

/// By the left eigenvector of the step: with weight w for each of n neighbours in the step, (a v + sum) / (a + n) with
/// a = 3 / (8 w).
Vec3 interior_limit(const TriangleView& view, VertexId v, const LoopWeightTable& table) {
  const NeighbourSum neighbours = neighbours_of(view, v);
  const double own = 3 / (8 * table(neighbours.count)), all = own + static_cast<double>(neighbours.count);
  const Vec3 sum = own * view.point(v) + neighbours.sum;
  return {sum.x / all, sum.y / all, sum.z / all};
}

/// The limit of an interior vertex with one sharp edge, to `end`, on which the new point is the middle.
Vec3 triangle_dart_limit(const TriangleView& view, VertexId v, VertexId end, const LoopWeightTable& table) {
  std::vector<VertexId> neighbours;
  view.for_each_outgoing(view.outgoing(v), [&](HalfedgeId h) { neighbours.push_back(view.target(h)); });
  std::ranges::rotate(neighbours, std::ranges::find(neighbours, end));
  const std::vector<double> weights = dart_weights(neighbours.size(), 5, 8 * table(neighbours.size()));
  Vec3 sum = view.point(v);
  double all = 1;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum = sum + weights[i] * view.point(neighbours[i]);
    all += weights[i];
  }
  return {sum.x / all, sum.y / all, sum.z / all};
}

Result<std::vector<Vec3>> loop_limits(const LimitInput& input) {
  const TriangleView view(input.mesh);
  const LoopWeightTable table(input.variant);
  return limits_of_vertices(input, view, [&](VertexId v) {
    if (input.sharpness == nullptr)
      return view.is_boundary_vertex(v) ? curve_limit(view.point(v), boundary_neighbours_of(view, v))
                                        : interior_limit(view, v, table);
    const CreaseRule rule = crease_rule(view, *input.sharpness, v, 0);
    if (rule.kind == CreaseKind::corner) return view.point(v);
    if (rule.kind == CreaseKind::crease)
      return curve_limit(view.point(v), view.point(rule.ends[0]) + view.point(rule.ends[1]));
    return rule.sharp_edges == 1 ? triangle_dart_limit(view, v, rule.ends[0], table) : interior_limit(view, v, table);
  });
}

}  // namespace

constinit const SchemeDescription kLoop = {.name = "loop",
                                           .takes_triangles_only = true,
                                           .needs_three_edges = true,
                                           .honours_creases = true,
                                           .variants_are = "weights",
                                           .variants = kLoopWeightNames,
                                           .after_step = four_times,
                                           .step = loop_step,
                                           .provenance = triangle_split_provenance,
                                           .limits = loop_limits};

}  // namespace algebra3d::subdivision
