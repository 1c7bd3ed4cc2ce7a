#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Counts of how many more half-edges run along edges one way than the other. Edges are those between the same two
/// places, of any mesh. Triangles that are closed together with one mesh are closed together with another one of the
/// same balance.
class EdgeBalance {
 public:
  /// Counts a half-edge between two places `count` times: -1 takes it away. Cost: logarithmic.
  void add(const PointRef& from, const PointRef& to, int count);
  void add(const TriangleMesh& mesh, HalfedgeId halfedge, int count);
  /// Counts all half-edges of a mesh. Cost: linear, and that of those at other edges than manifold ones.
  void add(const TriangleMesh& mesh, int count);
  /// True if as many run one way as the other along every edge.
  bool is_zero() const;

 private:
  PointTable places_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> excess_;  // of half-edges from the lower to the higher place
};

}  // namespace algebra3d
