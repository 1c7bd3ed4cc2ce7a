#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/arrangement/outcome_planes.h"
#include "algebra3d/arrangement/patches.h"
#include "algebra3d/arrangement/skeleton.h"

namespace algebra3d::arrangement {

/// The mesh of a result as it grows: first the faces of patches, which bring their adjacency along, then triangles of
/// regions. Use in the order of the members; `take_faces` and `take_surroundings` can go on at the same time.
class OutcomeMesh {
 public:
  /// `kept`, per patch: 1 if its faces are taken, -1 if they are taken turned over, else 0.
  OutcomeMesh(const Skeleton& skeleton, const Patches& patches, std::vector<int> kept);

  /// True for a vertex of the arrangement that is a corner of a face that is taken.
  bool is_fixed(std::uint32_t vertex) const { return is_fixed_[vertex]; }
  /// The vertex of the arrangement at a corner of an operand; kNone if there is none.
  std::uint32_t vertex_of_corner(std::uint32_t corner) const { return vertices_of_corners_[corner]; }
  /// Their corners.
  void take_faces();
  /// Their adjacency and planes.
  void take_surroundings();
  /// Triangles whose corners are vertices of the arrangement, all in one plane. The plane is kept if `keeps_plane`.
  void add_region(std::span<const TriangleMesh::Triangle> triangles, std::uint32_t plane, bool is_flipped,
                  bool keeps_plane);
  TriangleMesh finish();

 private:
  void find_runs();
  void find_fixed_vertices();
  void take_faces_of(const TakenRun& run);
  void take_opposites_of(const TakenRun& run);
  void unlink_around(std::uint32_t operand, VertexId corner);
  int kept_of_face(std::uint32_t face) const {
    const std::uint32_t patch = patches_.of_face[face];
    return patch == kNone ? 0 : kept_[patch];
  }
  std::uint32_t point_of_vertex(std::uint32_t vertex);
  std::uint32_t point_of_corner(std::uint32_t operand, std::uint32_t corner);
  std::uint32_t add_point(const PointRef& point);

  const Skeleton& skeleton_;
  const Operands& operands_;
  const Patches& patches_;
  std::vector<int> kept_;
  std::vector<TakenRun> runs_;
  std::vector<std::uint32_t> new_faces_;  // per face of the operands; kNone: not taken
  std::vector<bool> is_fixed_;            // per vertex
  std::vector<std::uint32_t> vertices_of_corners_;
  std::vector<std::uint32_t> points_of_vertices_, points_of_corners_;  // kNone: not there so far
  PointArray points_;
  std::vector<std::uint32_t> origins_, opposites_;
  OutcomePlanes planes_;
};

}  // namespace algebra3d::arrangement
