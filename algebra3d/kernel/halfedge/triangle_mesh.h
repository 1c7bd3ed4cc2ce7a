#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/face_order.h"
#include "algebra3d/kernel/halfedge/face_planes.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"
#include "base/indices.h"

namespace algebra3d {

/// A triangle mesh as directed edges: half-edge 3f+i leaves corner i of face f. Source: [campagna1998]. Memory: 24
/// bytes per triangle and 28 per vertex where all coordinates are doubles and the mesh is manifold. At most kMaxFaces
/// faces.
class TriangleMesh : public HalfedgeMesh<TriangleLayout> {
 public:
  using Triangle = IndexTriangle;
  static constexpr std::size_t kMaxFaces = kMaxHalfedges / 3;

  /// The empty mesh.
  TriangleMesh() = default;
  /// Links the triangles along common edges. Every index must be below points.size() (asserted). Unused points are kept
  /// as isolated vertices. Known planes must be those of the corners. Cost: linear expected (sorting per vertex), no
  /// recursion.
  TriangleMesh(PointArray points, std::span<const Triangle> triangles, FacePlanes planes = {});

  /// In `opposites`: the half-edge is not linked yet.
  static constexpr std::uint32_t kUnlinked = kUnlinkedHalfedge;
  /// Makes a mesh of partly linked triangles: three origins per triangle, and per half-edge its opposite or kUnlinked.
  /// A linked edge must have no further half-edges, and a vertex must be manifold if all half-edges that leave it are
  /// linked. Cost: a few passes, and that of linking the rest.
  TriangleMesh(PointArray points, LargeVector<std::uint32_t> origins, LargeVector<std::uint32_t> opposites,
               FacePlanes planes);
  /// As above, where the first vertices, those in `outgoing`, are *settled*: manifold, on no boundary, with all their
  /// edges linked and the value in `outgoing` that they have in the result. Edges between two other vertices are linked
  /// anew, whatever is in `opposites`. `order` as face_order. Cost: a scan of the origins, and that of linking the
  /// rest.
  TriangleMesh(PointArray points, LargeVector<std::uint32_t> origins, LargeVector<std::uint32_t> opposites,
               LargeVector<HalfedgeId> outgoing, FacePlanes planes, std::shared_ptr<const FaceOrder> order = nullptr);

  /// Makes a mesh from proposed links: an opposite is a half-edge along the same edge in the other direction, or
  /// kUnlinked; the edge may have further half-edges. Cost: that of a mesh without links, or less.
  static TriangleMesh with_proposed_links(PointArray points, LargeVector<std::uint32_t> origins,
                                          LargeVector<std::uint32_t> opposites);

  /// The faces and links of another mesh over other points, one per vertex. No planes are known. Cost: that of a copy.
  TriangleMesh(const TriangleMesh& linked, PointArray points);

  Triangle triangle(FaceId f) const {
    const std::uint32_t* first = origins().data() + halfedge(f).index();
    return {first[0], first[1], first[2]};
  }
  TriangleRef corners(FaceId f) const;

  /// Known planes of faces, possibly none. Results do not depend on them.
  const FacePlanes& planes() const { return planes_; }
  /// Most of the faces in the order that the hierarchy of a mesh in which they were before gave them; null if none is
  /// known. Results do not depend on it. Copies share it. Memory: 8 bytes per face in it.
  const FaceOrder* face_order() const { return face_order_.get(); }

  /// Bytes on the heap by the capacities of the containers, without large rationals.
  std::size_t heap_bytes() const;

 private:
  using HalfedgeMesh::HalfedgeMesh;

  FacePlanes planes_;
  std::shared_ptr<const FaceOrder> face_order_;
};

}  // namespace algebra3d
