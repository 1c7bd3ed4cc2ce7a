#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"

namespace algebra3d::subdivision {

// Semi-sharp creases: an edge of sharpness s has the rules of a crease in the next s steps, and the smooth ones after
// them; a fraction is a step between both. Edges of the boundary are infinitely sharp. Source: [derose1998], section 4.

/// From this sharpness on, edges and vertices stay sharp in all steps.
inline constexpr double kInfinitelySharp = 10;

/// The sharpness of edges and vertices, 0 or more.
struct Sharpness {
  std::vector<double> edges;     ///< per half-edge
  std::vector<double> vertices;  ///< per vertex
};

/// The sharpness of a mesh by its attributes; nothing if all is smooth. Undefined values are 0. Errors: invalid_value
/// for attributes that are not real, and for negative values, with the place. Cost: linear, if there are such
/// attributes.
Result<std::optional<Sharpness>> sharpness_of(const PolygonMesh& mesh, const MeshAttributes& attributes);
/// Whether the attribute is one of those that `sharpness_of` reads.
bool is_sharpness(const MeshAttribute& attribute);
/// The number of steps after which each sharpness is 0 or infinite.
std::size_t steps_to_settle(const Sharpness& sharpness);
/// The sharpness that a half of an edge, or a vertex, has after a step.
inline double sharpness_after_step(double sharpness) {
  return sharpness >= kInfinitelySharp ? sharpness : std::max(sharpness - 1, 0.0);
}

/// The point on an edge of some sharpness.
inline Vec3 creased_edge_point(double sharpness, const Vec3& smooth, const Vec3& middle) {
  if (sharpness >= 1) return middle;
  return (1 - sharpness) * smooth + sharpness * middle;
}

enum class CreaseKind : std::uint8_t {
  smooth,  ///< fewer than two sharp edges; with one, a dart
  crease,  ///< two
  corner   ///< more, or the vertex is sharp itself
};

/// The rule of a vertex.
struct CreaseRule {
  CreaseKind kind = CreaseKind::smooth;
  std::array<VertexId, 2> ends = {};  ///< of a crease: the other ends of its edges; of a dart the first
  std::size_t sharp_edges = 0;
};

/// Calls visit(end, sharpness) for the edges of a vertex that is not isolated.
template <typename View, typename Visit>
void for_each_sharpness(const View& view, const Sharpness& sharpness, VertexId v, const Visit& visit) {
  const HalfedgeId last = view.for_each_outgoing(view.outgoing(v), [&](HalfedgeId h) {
    visit(view.target(h), view.is_boundary(h) ? kInfinitelySharp : sharpness.edges[h.index()]);
  });
  if (const HalfedgeId before = view.prev(last); view.is_boundary(before)) visit(view.origin(before), kInfinitelySharp);
}

/// The rule of a vertex where edges and vertices of at most sharpness `smooth` count as smooth.
template <typename View>
CreaseRule crease_rule(const View& view, const Sharpness& sharpness, VertexId v, double smooth) {
  CreaseRule rule;
  for_each_sharpness(view, sharpness, v, [&](VertexId end, double of_edge) {
    if (of_edge <= smooth) return;
    if (rule.sharp_edges < 2) rule.ends[rule.sharp_edges] = end;
    ++rule.sharp_edges;
  });
  const bool is_corner = rule.sharp_edges > 2 || sharpness.vertices[v.index()] > smooth;
  rule.kind = is_corner ? CreaseKind::corner : rule.sharp_edges == 2 ? CreaseKind::crease : CreaseKind::smooth;
  return rule;
}

/// The mean of the sharpnesses at a vertex that end with this step: how much the rule before it counts beside the rule
/// after it.
template <typename View>
double share_of_ending_rule(const View& view, const Sharpness& sharpness, VertexId v) {
  double sum = 0;
  int count = 0;
  const auto add = [&](double value) {
    if (value <= 0 || value > 1) return;
    sum += value;
    ++count;
  };
  add(sharpness.vertices[v.index()]);
  for_each_sharpness(view, sharpness, v, [&](VertexId, double of_edge) { add(of_edge); });
  return count == 0 ? 1 : sum / count;
}

/// The new point of a vertex, whose smooth rule gives `smooth()`. If edges or the vertex become smooth in this step,
/// and that changes the rule, it is between both rules.
template <typename View, typename Smooth>
Vec3 creased_vertex_point(const View& view, const Sharpness& sharpness, VertexId v, const Smooth& smooth) {
  const auto by = [&](const CreaseRule& rule) {
    switch (rule.kind) {
      case CreaseKind::smooth:
        return smooth();
      case CreaseKind::crease:
        return 0.75 * view.point(v) + 0.125 * (view.point(rule.ends[0]) + view.point(rule.ends[1]));
      case CreaseKind::corner:
        break;
    }
    return view.point(v);
  };
  const CreaseRule now = crease_rule(view, sharpness, v, 0), next = crease_rule(view, sharpness, v, 1);
  if (now.kind == next.kind) return by(now);
  const double share = share_of_ending_rule(view, sharpness, v);
  return share >= 1 ? by(now) : share * by(now) + (1 - share) * by(next);
}

/// The point of a uniform cubic B-spline curve at a control point, with the sum of the two beside it.
inline Vec3 curve_limit(const Vec3& point, const Vec3& neighbours) {
  const Vec3 sum = 4 * point + neighbours;
  return {sum.x / 6, sum.y / 6, sum.z / 6};
}

/// The weights of the neighbours of a dart vertex in its limit, relative to that of the vertex, from its sharp edge on:
/// the left eigenvector of the step for the eigenvalue 1. With x(1) for the sharp edge and x(2) to x(n) for the others,
/// in turn, `diagonal` x(i) = x(i - 1) + x(i + 1) + `constant`, where the sharp edge counts as 0, and (diagonal - 1)
/// x(1) = x(2) + x(n) + constant. `count` is at least 2. Cost: linear.
std::vector<double> dart_weights(std::size_t count, double diagonal, double constant);

}  // namespace algebra3d::subdivision
