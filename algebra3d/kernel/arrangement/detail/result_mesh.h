#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "algebra3d/kernel/arrangement/detail/patch_corners.h"
#include "algebra3d/kernel/arrangement/detail/regions.h"
#include "algebra3d/kernel/arrangement/detail/result_planes.h"
#include "algebra3d/kernel/arrangement/detail/taken_runs.h"
#include "algebra3d/kernel/arrangement/detail/taken_vertices.h"

namespace algebra3d::arrangement {

/// A mesh that is complete but for links between edges at vertices that are not settled (taken_vertices.h), and refers
/// to nothing: its sources can be freed before these are found.
struct UnlinkedMesh {
  PointArray points;
  LargeVector<std::uint32_t> origins, opposites;  ///< as TriangleMesh takes them
  LargeVector<HalfedgeId> outgoing;               ///< of the settled vertices
  FacePlanes planes;
  std::shared_ptr<const FaceOrder> order;  ///< as TriangleMesh::face_order
};

/// The mesh, with all edges linked. Cost: linear in the half-edges, and little for those that are linked.
TriangleMesh linked(UnlinkedMesh mesh);

/// The mesh of a result as it grows: first the faces of patches, which bring their adjacency along, then triangles of
/// regions. Call `add` for each region, then `finish`.
class ResultMesh {
 public:
  /// Takes the faces of patches with their corners, adjacency and planes, in parallel. Edges between two vertices that
  /// are not settled are not linked. Leaves room for `region_triangles`.
  ResultMesh(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept,
             std::size_t region_triangles);

  /// Adds the triangles of a region, with nodes for corners. If some corner is not a double, the plane is kept.
  void add(const Region& region, std::span<const IndexTriangle> triangles);
  /// The mesh. Leaves this object empty.
  UnlinkedMesh finish();

 private:
  void take_patches();
  void take_faces(FaceId first, FaceId last);
  void take_corners(const TakenRun& run, FaceId first, std::size_t count);
  void take_opposites(const TakenRun& run, FaceId first, std::size_t count);
  VertexId vertex_at(NodeId node);

  const Subdivision& subdivision_;
  TakenRuns runs_;
  TakenVertices vertices_;
  IdVector<NodeId, VertexId> at_nodes_;  // invalid: not there so far
  UnlinkedMesh mesh_;                    // without planes
  ResultPlanes planes_;
};

}  // namespace algebra3d::arrangement
