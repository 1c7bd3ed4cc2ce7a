#include "algebra3d/kernel/arrangement/detail/edge_sides.h"

#include <utility>

#include "algebra3d/kernel/exact/predicates_filter.h"

namespace algebra3d::arrangement {
namespace {

std::size_t hash_of(const std::array<InputVertexId, 4>& vertices) {
  std::uint64_t hash = 0;
  for (const InputVertexId vertex : vertices) hash = (hash ^ vertex.index()) * 0x9E3779B97F4A7C15U;
  return hash >> 32U;
}

/// The four vertices in the order in which they are remembered, and the sign of the permutation that leads there.
struct Ordered {
  std::array<InputVertexId, 4> vertices;
  int sign = 1;
};

/// Two edges that change places are an even permutation; the ends of one edge are not.
Ordered ordered(const InputEdgeEnds& edge, const InputEdgeEnds& other) {
  Ordered result{{edge.vertex_a, edge.vertex_b, other.vertex_a, other.vertex_b}};
  auto& v = result.vertices;
  for (const std::size_t i : {0U, 2U})
    if (v[i] > v[i + 1]) {
      std::swap(v[i], v[i + 1]);
      result.sign = -result.sign;
    }
  if (v[0] > v[2]) {
    std::swap(v[0], v[2]);
    std::swap(v[1], v[3]);
  }
  return result;
}

}  // namespace

int EdgeSides::rounded_side(const InputEdgeEnds& edge, const InputEdgeEnds& other) {
  detail::count_call();
  const bool are_doubles = edge.a.is_double() && edge.b.is_double() && other.a.is_double() && other.b.is_double();
  return are_doubles ? detail::filter_orient3d(edge.a.approx, edge.b.approx, other.a.approx, other.b.approx)
                     : detail::filter_rounded_orient3d(edge.a.approx, edge.b.approx, other.a.approx, other.b.approx);
}

int EdgeSides::side(const InputEdgeEnds& edge, const InputEdgeEnds& other) {
  const bool are_doubles = edge.a.is_double() && edge.b.is_double() && other.a.is_double() && other.b.is_double();
  if (are_doubles) return orient3d(edge.a, edge.b, other.a, other.b);
  const auto [vertices, sign] = ordered(edge, other);
  if (known_.empty()) known_.resize(kPlaces);
  Known& known = known_[hash_of(vertices) % kPlaces];
  if (known.vertices != vertices) known = {vertices, sign * orient3d(edge.a, edge.b, other.a, other.b)};
  return sign * known.side;
}

}  // namespace algebra3d::arrangement
