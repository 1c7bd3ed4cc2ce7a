#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/simplification/detail/collapse_mesh.h"
#include "algebra3d/kernel/simplification/detail/quadric.h"
#include "base/indices.h"
#include "base/large_allocator.h"

namespace algebra3d {

/// A queue of half-edges in the order of rounded costs: those of one bucket differ by about a hundredth. Within a
/// bucket they keep the order of insertion, which follows the memory, so that neighbours are handled together.
class CostBuckets {
 public:
  static constexpr std::size_t kPerOctave = 64, kCount = 96 * kPerOctave;

  /// The bucket of a cost; costs from 2^-80 to 2^16 are distinguished.
  static std::size_t bucket_of(double cost) {
    constexpr std::uint64_t kFirst = (std::uint64_t{1023} - 80) * kPerOctave;
    const std::uint64_t place = std::bit_cast<std::uint64_t>(std::max(cost, 0.0)) >> 46U;
    return place <= kFirst ? 0 : std::min<std::size_t>(place - kFirst, kCount - 1);
  }

  void push(std::size_t bucket, std::uint32_t h) { buckets_[bucket].push_back(h); }
  /// The entries of a bucket, to which others may be added meanwhile.
  const std::vector<std::uint32_t>& operator[](std::size_t bucket) const { return buckets_[bucket]; }
  void reserve(std::size_t bucket, std::size_t count) { buckets_[bucket].reserve(count); }
  void release(std::size_t bucket) { std::vector<std::uint32_t>().swap(buckets_[bucket]); }

 private:
  std::vector<std::vector<std::uint32_t>> buckets_ = std::vector<std::vector<std::uint32_t>>(kCount);
};

/// When to stop.
struct CollapseLimits {
  std::size_t triangles = 0;  ///< as soon as there are no more than these
  double error = 0;           ///< no collapse costs more, as a distance in coordinate units
};

/// Locked vertices, which stay as they are, and the angle of creases, which are kept as far as the error allows.
struct CollapseConstraints {
  std::span<const std::uint8_t> locked = {};  ///< vertices that stay as they are; empty, or a flag for each
  /// Edges with a larger angle between the normals of their faces, in degrees, are creases; 180: none are.
  double crease_degrees = 180;
};

/// Collapses the cheapest edges of a mesh, by quadric error. Computes in a frame in which the mesh has about the
/// size 1. A vertex has the sum of the quadrics of all faces whose corners were merged into it, so costs only grow and
/// those in the queue are lower bounds: an edge is evaluated again when its turn comes. Source: [garland1997].
/// The boundary and creases are the features. They are held by planes through their edges, across the faces. A vertex
/// on a feature stays on it: it merges along the feature only, or vertices inside merge into it. A vertex where
/// features meet or end stays where it is.
class EdgeCollapser {
 public:
  /// The mesh must not be empty. If the work is cancelled meanwhile, `run` returns that error.
  EdgeCollapser(const TriangleMesh& mesh, const CollapseConstraints& constraints, const Monitor& monitor);

  /// Errors: interrupted.
  Status run(const CollapseLimits& limits);

  /// The mesh of the faces that are left, in their order, and of the isolated vertices that the mesh had.
  TriangleMesh result();
  /// The vertex of the result that each vertex was merged into. Valid after `result`.
  std::vector<std::uint32_t> images();
  /// For each face of the result the one that it was, with the corners in the same places.
  std::vector<std::uint32_t> face_sources() const;
  /// For each vertex of the result the one at whose place it is, or one of those that became it if it is at none.
  std::vector<std::uint32_t> vertex_sources();

 private:
  /// How a vertex is held by features.
  enum class Hold : std::uint8_t { none, on_feature, fixed };

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
  void find_creases(double crease_degrees);
  void find_holds();
  void add_feature_quadrics();
  bool is_feature(std::uint32_t h) const { return faces_.opposite(h) == kNone || faces_.is_crease(h); }
  Vec3 face_normal(std::uint32_t f) const;
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
  const Monitor& monitor_;
  CollapseMesh faces_;
  Vec3 centre_;
  double unit_ = 1;
  double largest_cost_ = 0;
  LargeVector<Vec3> positions_;
  LargeVector<Quadric> quadrics_;
  LargeVector<std::uint32_t> sources_;
  std::vector<Hold> holds_;
  CostBuckets queue_;
  CollapseMesh::Ring ring_a_, ring_b_;
};

}  // namespace algebra3d
