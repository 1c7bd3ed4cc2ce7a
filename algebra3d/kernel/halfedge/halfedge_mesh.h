#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "algebra3d/halfedge/halfedge_structure.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/face_layout.h"
#include "base/large_allocator.h"

namespace algebra3d {

template <typename Layout>
struct MeshLinker;  // detail/mesh_linker.h
template <typename Layout>
class ManifoldLinker;  // detail/manifold_linker.h
template <typename Layout>
struct MeshAuditor;  // audit.cpp

/// Arrays that a mesh owns.
struct OwnedMeshArrays {
  using Points = PointArray;
  using Numbers = LargeVector<std::uint32_t>;
  using Handles = LargeVector<HalfedgeId>;
  using Tables = std::shared_ptr<const NonManifoldTables>;
};

/// The common base of meshes of triangles and of polygons, with exact points. Invariants: see `audit` (audit.h), which
/// checks them.
template <typename Layout>
class HalfedgeMesh : public HalfedgeStructure<Layout, OwnedMeshArrays> {
  using Structure = HalfedgeStructure<Layout, OwnedMeshArrays>;

 public:
  using Structure::kMaxHalfedges;

  PointRef point(VertexId v) const { return points_[v.index()]; }

  // The arrays, for structures that refer to them: as HalfedgeStructure stores them.
  const LargeVector<std::uint32_t>& opposites() const { return opposites_; }
  const LargeVector<HalfedgeId>& outgoing_halfedges_of_vertices() const { return outgoing_; }
  const NonManifoldTables* nonmanifold_tables() const { return nonmanifold_.get(); }

  /// Bytes on the heap by the capacities of the containers, without large rationals.
  std::size_t heap_bytes() const;

 protected:
  /// In `opposites`: the half-edge is not linked yet.
  static constexpr std::uint32_t kUnlinkedHalfedge = 0xFFFFFFFE;
  /// The links that are given: none; opposites that are right if the mesh is manifold; half-edges whose opposites are
  /// given; or all edges with a settled end: the first vertices, those in `outgoing`, are settled; or everything:
  /// opposites, outgoing half-edges, and that the mesh is manifold.
  enum class Links : std::uint8_t { none, proposed, some, all_but_between_open_vertices, all };

  HalfedgeMesh() = default;
  /// Links all faces. Cost: linear expected (sorting per vertex), no recursion.
  HalfedgeMesh(PointArray points, Layout layout, LargeVector<std::uint32_t> origins)
      : HalfedgeMesh(std::move(points), std::move(layout), std::move(origins), {}, {}, Links::none) {}
  /// Links what is not linked yet. Cost: a few passes, and that of linking the rest.
  HalfedgeMesh(PointArray points, Layout layout, LargeVector<std::uint32_t> origins,
               LargeVector<std::uint32_t> opposites, LargeVector<HalfedgeId> outgoing, Links links);
  /// The faces and links of another mesh over other points, one per vertex.
  HalfedgeMesh(const HalfedgeMesh& linked, PointArray points);
  HalfedgeMesh(const HalfedgeMesh&) = default;
  HalfedgeMesh(HalfedgeMesh&&) noexcept = default;
  HalfedgeMesh& operator=(const HalfedgeMesh&) = default;
  HalfedgeMesh& operator=(HalfedgeMesh&&) noexcept = default;
  ~HalfedgeMesh() = default;

 private:
  friend struct MeshLinker<Layout>;
  friend class ManifoldLinker<Layout>;
  friend struct MeshAuditor<Layout>;
  friend struct MeshTester;  // tests damage meshes through it, to see that `audit` finds it
  using Structure::kBoundary;
  using Structure::kNoOpposite;
  using Structure::nonmanifold_;
  using Structure::opposites_;
  using Structure::origins_;
  using Structure::outgoing_;
  using Structure::points_;
};

extern template class HalfedgeMesh<TriangleLayout>;
extern template class HalfedgeMesh<PolygonLayout>;

}  // namespace algebra3d
