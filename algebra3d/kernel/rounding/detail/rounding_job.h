#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/rounded_vertices.h"
#include "algebra3d/kernel/rounding/detail/snapped_faces.h"
#include "algebra3d/kernel/rounding/rounding_method.h"
#include "algebra3d/kernel/validity/face_set.h"

namespace algebra3d {

/// How far a mesh was moved at most, in coordinate units.
struct Movement {
  double displacement = 0;  ///< each point can be led to its new place on a way that is no longer
  double distance = 0;      ///< no point of the result is farther from the given mesh; at most the displacement

  Movement() = default;
  /// No more is known than the displacement.
  explicit Movement(double displacement_) : displacement(displacement_), distance(displacement_) {}
  Movement(double displacement_, double distance_) : displacement(displacement_), distance(distance_) {}

  /// One movement after the other.
  friend Movement operator+(const Movement& a, const Movement& b) {
    return {a.displacement + b.displacement, a.distance + b.distance};
  }
};

/// A mesh on the grid that may be the rounded one.
struct RoundingCandidate {
  TriangleMesh mesh;
  Movement movement = {};  ///< from the given mesh
  double reach = 0;        ///< within which features were joined, in coordinate units; 0 if none were
  RoundingMethod method = RoundingMethod::vertices_moved;
  /// For each face the face of the given mesh with the same corners, or kNone if there is none or it was not tracked;
  /// empty if no face was tracked.
  std::vector<std::uint32_t> kept = {};

  /// The faces that the given mesh has too.
  FaceSet kept_faces() const;
};

/// The smallest reach within which features are joined, in spacings of the grid.
inline constexpr double kFirstReach = 2;

/// The vertices moved, and the faces as they were. Cost: linear.
RoundingCandidate with_its_faces(const TriangleMesh& mesh, const RoundedVertices& vertices);
/// The mesh with its vertices moved, and no more. Errors: interrupted.
Result<RoundingCandidate> with_moved_vertices(const TriangleMesh& mesh, const RoundedVertices& vertices,
                                              const std::atomic<bool>* cancel);
/// The snap rounded mesh. Errors: interrupted.
Result<RoundingCandidate> snap_rounded(const TriangleMesh& mesh, const RoundedVertices& vertices,
                                       const std::atomic<bool>* cancel);

/// The rounding of a mesh while methods make candidates: the given mesh, and the nearest candidate that was proved so
/// far. The differences between solids and surfaces are in the classes that derive from this (solid_rounding.h,
/// rounded_surface.cpp).
class RoundingJob {
 public:
  RoundingJob(const RoundingJob&) = delete;
  RoundingJob& operator=(const RoundingJob&) = delete;
  virtual ~RoundingJob() = default;

  /// The mesh that is to be rounded: a solid, a part of one, or a surface.
  const TriangleMesh& mesh() const { return mesh_; }
  const RoundedVertices& vertices() const { return vertices_; }
  const CoordinateGrid& grid() const { return grid_; }
  double size() const { return size_; }  ///< the largest coordinate of what is given
  /// The spacing of the grid at that coordinate.
  double spacing() const { return spacing_; }
  const Monitor& monitor() const { return monitor_; }
  const std::atomic<bool>* cancel() const { return monitor_.cancel(); }
  /// Reports what is done now, as "joining features"; the error interrupted if the host has cancelled the work.
  Status begin(const std::string& what) const;

  /// True unless the rest of a solid is passed on as it is.
  virtual bool is_whole() const { return true; }
  /// True if the mesh bounds a solid.
  virtual bool is_solid() const = 0;
  /// The rule for triangles with the same corners.
  virtual Folded folded() const = 0;
  /// A candidate's mesh divided where it crosses itself; of a solid the cells that are inside. Nothing if more pairs of
  /// triangles may touch. Errors: interrupted.
  virtual Result<std::optional<TriangleMesh>> divided(const TriangleMesh& mesh, std::size_t max_pairs) const = 0;
  /// As above, with the usual limit.
  Result<std::optional<TriangleMesh>> divided(const TriangleMesh& mesh) const;
  /// Proves the candidate if it is nearer than the result so far; true if it is valid, and the result from now on.
  Result<bool> accept(const RoundingCandidate& candidate);
  /// The largest distance of the result so far from the given mesh; infinite as long as there is no result.
  double accepted_distance() const { return accepted_distance_; }
  /// Proves the mesh with its vertices moved and its faces as they were, as `accept` does. False also if two vertices
  /// coincide, or if a vertex lies inside an edge or face.
  Result<bool> accept_moved();
  /// Replaces the mesh by the cubes that it meets, or by their faces: always valid. False if the grid has no numbers
  /// beyond the mesh.
  virtual Result<bool> accept_cover() = 0;

 protected:
  /// Proves the candidate; true if it is valid, and the result from now on.
  virtual Result<bool> prove(const RoundingCandidate& candidate) = 0;
  /// As above for `accept_moved`: the largest distance of the result, if it is valid.
  virtual Result<std::optional<double>> prove_moved_vertices() = 0;
  /// The mesh must outlive this. `size`: the largest coordinate of what is given, of which the mesh may be a part.
  RoundingJob(const TriangleMesh& mesh, double size, const CoordinateGrid& grid, const Monitor& monitor);

 private:
  const TriangleMesh& mesh_;
  CoordinateGrid grid_;
  double size_, spacing_;
  Monitor monitor_;
  RoundedVertices vertices_;
  double accepted_distance_ = std::numeric_limits<double>::infinity();
};

}  // namespace algebra3d
