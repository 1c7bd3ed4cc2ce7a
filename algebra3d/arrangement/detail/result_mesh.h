#pragma once

#include <span>
#include <vector>

#include "algebra3d/arrangement/detail/patch_corners.h"
#include "algebra3d/arrangement/detail/regions.h"
#include "algebra3d/arrangement/detail/result_planes.h"

namespace algebra3d::arrangement {

/// The mesh of a result as it grows: first the faces of patches, which bring their adjacency along, then triangles of
/// regions. Call take_faces, take_surroundings, `add` for each region, and `finish`, in this order. The first two need
/// no regions and may run at the same time as each other.
class ResultMesh {
 public:
  ResultMesh(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept);

  /// Adds the corners of the faces of patches.
  void take_faces();
  /// Adds their adjacency and planes. Edges that end in a node are left to `finish`.
  void take_surroundings();
  /// Adds triangles with nodes for corners. If some corner is no double, the plane is kept.
  void add(const Region& region);
  /// The mesh, with all edges linked. Leaves this object empty.
  TriangleMesh finish();

 private:
  void find_runs();
  int kept(InputFaceId face) const { return kept_of_face(face, subdivision_.patches, kept_); }
  void take_faces_of(const TakenRun& run);
  void take_opposites_of(const TakenRun& run);
  void unlink_around(OperandId operand, VertexId vertex);
  VertexId vertex_at(NodeId node);
  VertexId vertex_at(OperandId operand, VertexId vertex);
  VertexId add_point(const PointRef& point);

  const Subdivision& subdivision_;
  const Operands& operands_;
  const PatchCorners& patch_corners_;
  const KeptPatches& kept_;
  std::vector<TakenRun> runs_;
  IdVector<InputFaceId, FaceId> new_faces_;        // invalid: not taken
  IdVector<NodeId, VertexId> at_nodes_;            // invalid: not there so far
  IdVector<InputVertexId, VertexId> at_vertices_;  // invalid: not there so far
  PointArray points_;
  std::vector<std::uint32_t> origins_, opposites_;  // as TriangleMesh takes them
  ResultPlanes planes_;
};

}  // namespace algebra3d::arrangement
