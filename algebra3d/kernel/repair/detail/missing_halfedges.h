#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d {

/// A half-edge of MissingHalfedges.
using MissingId = StrongId<struct MissingHalfedgeTag>;

/// A half-edge along which a loop may lead. Either it is missing to make its edge balanced, that is, to give the edge
/// equally many half-edges in both directions; or, for shortcuts, it is a chord: a half-edge of a balanced edge.
struct MissingHalfedge {
  VertexId from, to;
  bool is_boundary;                ///< the edge has one triangle; otherwise it is non-manifold
  bool ends_at_interface = false;  ///< its run of boundary edges is open: it ends at non-manifold edges
  bool is_chord = false;           ///< not missing, see above
  bool is_covered = false;         ///< by added triangles
};

/// All missing half-edges of a mesh, and chords if they were added. The missing ones always form closed loops;
/// triangles along all of them would close the mesh. Cost: linear.
class MissingHalfedges {
 public:
  /// The missing half-edges, without chords.
  explicit MissingHalfedges(const TriangleMesh& mesh);
  /// Adds chords: manifold edges between ends of missing half-edges.
  void add_chords(const TriangleMesh& mesh);

  IdVector<MissingId, MissingHalfedge> edges;
  bool has_boundary = false;     ///< a half-edge of a boundary edge is missing
  bool has_nonmanifold = false;  ///< a half-edge of a non-manifold edge is missing

  /// Which half-edges a loop may use.
  enum class Way : std::uint8_t { any, boundary };
  /// The shortest loop of uncovered half-edges that begins with `start`, by Dijkstra's algorithm. With Way::boundary it
  /// uses boundary edges only. Empty if there is none, or if none was found among the 2000 vertices nearest to the
  /// start.
  std::vector<MissingId> shortest_loop(MissingId start, const std::vector<Vec3>& points, Way way = Way::any) const;
  /// The missing half-edge from one vertex to another, chords excluded; invalid if there is none.
  MissingId find(VertexId from, VertexId to) const;

 private:
  struct Step;

  void add_boundary(const TriangleMesh& mesh);
  void add_nonmanifold(const TriangleMesh& mesh);
  void add(const MissingHalfedge& edge);
  bool is_passable(const MissingHalfedge& edge, const MissingHalfedge& before, Way way) const;
  std::span<const MissingId> leaving(VertexId vertex) const;

  std::map<VertexId, std::vector<MissingId>> from_;  // by their start
};

}  // namespace algebra3d
