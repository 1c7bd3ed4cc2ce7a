#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/large_allocator.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/simplification/detail/collapse_mesh.h"
#include "algebra3d/simplification/detail/cost_buckets.h"
#include "algebra3d/simplification/detail/quadric.h"

namespace algebra3d {

/// When to stop.
struct CollapseLimits {
  std::size_t triangles = 0;  ///< as soon as there are no more than these
  double error = 0;           ///< no collapse costs more, as a distance in coordinate units
};

/// Collapses the cheapest edges of a mesh, by quadric error. Computes in a frame in which the mesh has about the
/// size 1. A vertex has the sum of the quadrics of all faces whose corners were merged into it, so costs only grow and
/// those in the queue are lower bounds: an edge is evaluated again when its turn comes. Source: [garland1997].
class EdgeCollapser {
 public:
  /// The mesh must not be empty. `locked`: vertices that stay as they are; empty, or a flag for each.
  EdgeCollapser(const TriangleMesh& mesh, std::span<const std::uint8_t> locked);

  /// Errors: interrupted.
  Status run(const CollapseLimits& limits, const Monitor& monitor);

  /// The mesh of the faces that are left, in their order, without isolated vertices.
  TriangleMesh result();
  /// The vertex of the result that each vertex was merged into; kNone for isolated ones. Valid after `result`.
  std::vector<std::uint32_t> images();

 private:
  /// A place for the vertex that an edge becomes.
  struct Candidate {
    Vec3 position;
    double cost;
    std::uint32_t source;  // the vertex that stands there, or kNone
  };
  struct Candidates {
    std::array<Candidate, 3> places;
    std::size_t count = 0;
  };

  void find_frame();
  void find_quadrics();
  void add_boundary_quadrics();
  Status fill_queue();
  Quadric face_quadric(std::uint32_t f) const;
  Candidates candidates(std::uint32_t h) const;
  double penalty(std::uint32_t h) const;
  bool flips(std::uint32_t keep, std::uint32_t other, const CollapseMesh::Ring& ring, const Vec3& position) const;
  bool try_collapse(std::uint32_t h, const Candidates& places, std::size_t bucket);
  void handle(std::uint32_t h, std::size_t bucket);
  void requeue_wing(std::uint32_t left, std::uint32_t right, std::size_t bucket);
  void push(std::uint32_t h, std::size_t bucket);
  Vec3 framed(const Vec3& p) const;
  Vec3 unframed(const Vec3& p) const;

  const TriangleMesh& mesh_;
  CollapseMesh faces_;
  Vec3 centre_;
  double unit_ = 1;
  double largest_cost_ = 0;
  LargeVector<Vec3> positions_;
  LargeVector<Quadric> quadrics_;
  LargeVector<std::uint32_t> sources_;
  CostBuckets queue_;
  CollapseMesh::Ring ring_a_, ring_b_;
};

}  // namespace algebra3d
