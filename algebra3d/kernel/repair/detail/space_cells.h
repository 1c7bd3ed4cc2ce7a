#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/disjoint_ids.h"

namespace algebra3d {

/// A cell, by one of the sides of faces in it.
using CellId = StrongId<struct CellTag>;
/// A connected component of the faces of a mesh; see FaceComponents.
using ComponentId = StrongId<struct ComponentTag>;

/// One side of a face: its front, where the normal points to, or its back.
class FaceSide {
 public:
  /// Sides are counted consecutively: both of the first face, then both of the second.
  explicit FaceSide(std::uint32_t index) : index_(index) {}
  static FaceSide front(FaceId face) { return FaceSide(2 * face.index()); }
  static FaceSide back(FaceId face) { return FaceSide(2 * face.index() + 1); }
  static FaceSide of(FaceId face, bool is_front) { return is_front ? front(face) : back(face); }

  std::uint32_t index() const { return index_; }

 private:
  std::uint32_t index_;
};

/// The cells into which a surface divides space. The surface is valid (validity.h); it may be open, so that both sides
/// of a face lie in one cell. Call `find` once, before the other members.
class SpaceCells {
 public:
  /// The surface must outlive this.
  explicit SpaceCells(const TriangleMesh& surface);

  /// Finds the cells. Exact. Errors: interrupted. Cost: that of the edges, sorted around the non-manifold ones, and of
  /// a vertical line through the surface for each connected component.
  Status find(const Monitor& monitor);

  CellId cell(FaceSide side) { return CellId(sides_.find(side).index()); }
  CellId unbounded_cell() { return cell(outside_); }

 private:
  void join_across_simple_edges();
  Status join_around_nonmanifold_edges(const Monitor& monitor);
  void join_around(std::span<const HalfedgeId> edge);
  Status join_components(const Monitor& monitor);

  const TriangleMesh& surface_;
  FaceSide outside_;  // an extra side, of no face, that stands for the unbounded cell
  DisjointIds<FaceSide> sides_;
};

}  // namespace algebra3d
