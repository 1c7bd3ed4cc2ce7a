#include <utility>
#include <vector>

#include "algebra3d/kernel/subdivision/detail/edge_enumeration.h"
#include "algebra3d/kernel/subdivision/detail/refined_mesh.h"
#include "algebra3d/kernel/subdivision/detail/ring_masks.h"
#include "algebra3d/kernel/subdivision/detail/steps.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// A step of Doo-Sabin. Vertex h of the result belongs to half-edge h, that is, to the corner that it leaves. The
/// result has a face per face, with the same half-edges; then one per interior edge, between the corners at both its
/// ends in both faces; then one per interior vertex, between its corners.
template <typename View>
class DooSabin {
 public:
  DooSabin(const View& view, const Monitor& monitor, const std::string& what)
      : view_(view),
        monitor_(monitor),
        stage_(monitor, what,
               2 * block_count(view.halfedge_count()) + block_count(view.face_count()) +
                   2 * block_count(view.vertex_count())),
        edges_(view, Edges::interior, stage_),
        first_of_vertices_(view.halfedge_count() + 4 * edges_.count()) {
    count_vertex_faces();
  }

  Result<PolygonMesh> step() {
    A3D_TRY(monitor_.check());
    const Place end = vertex_faces_.back();
    RefinedMesh refined(view_.halfedge_count(), end.halfedge);
    starts_.resize(std::size_t{end.face} + 1);
    starts_.back() = end.halfedge;
    edge_numbers_.resize(view_.halfedge_count());
    write_faces(refined);
    write_edge_faces(refined);
    A3D_TRY(monitor_.check());
    write_vertex_faces(refined);
    A3D_TRY(monitor_.check());
    return std::move(refined).finish(PolygonLayout(std::move(starts_)), monitor_);
  }

 private:
  /// A face of the result and its first half-edge.
  struct Place {
    std::uint32_t face = 0, halfedge = 0;
  };

  bool is_interior(std::uint32_t v) const { return view_.outgoing(v) != kNone && !view_.is_boundary_vertex(v); }
  /// The first half-edge of the face of interior edge e.
  std::uint32_t edge_face(std::uint32_t e) const { return view_.halfedge_count() + 4 * e; }

  /// Where the faces of each block of vertices begin.
  void count_vertex_faces() {
    vertex_faces_.resize(block_count(view_.vertex_count()) + 1);
    for_each_block(view_.vertex_count(), stage_, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
      Place size;
      for (std::uint32_t v = begin; v < end; ++v) {
        if (!is_interior(v)) continue;
        ++size.face;
        view_.for_each_outgoing(view_.outgoing(v), [&](std::uint32_t) { ++size.halfedge; });
      }
      vertex_faces_[block + 1] = size;
    });
    vertex_faces_.front() = {view_.face_count() + edges_.count(), first_of_vertices_};
    for (std::size_t block = 1; block < vertex_faces_.size(); ++block) {
      vertex_faces_[block].face += vertex_faces_[block - 1].face;
      vertex_faces_[block].halfedge += vertex_faces_[block - 1].halfedge;
    }
  }

  void write_faces(RefinedMesh& refined) {
    for_each_block(view_.face_count(), stage_, [&](std::size_t, std::uint32_t begin, std::uint32_t end) {
      std::vector<Vec3> ring, corners;
      for (std::uint32_t f = begin; f < end; ++f) {
        const std::uint32_t first = view_.first(f);
        starts_[f] = first;
        ring.clear();
        for (std::uint32_t h = first; h < first + view_.degree(f); ++h) ring.push_back(view_.origin_point(h));
        doo_sabin_corners(ring, corners);
        for (std::uint32_t i = 0; i < ring.size(); ++i) {
          const std::uint32_t h = first + i;
          refined.points[h] = corners[i];
          refined.corners[h] = h;
          refined.outgoing[h] = HalfedgeId(h);
          if (view_.is_boundary(h)) refined.opposites[h] = kNone;
        }
      }
    });
  }

  /// The face of an edge runs against the faces beside it: in the face of h from its target to its origin, then across
  /// to the other face, back there, and across again. Half-edges that run across at an interior end are linked to the
  /// vertex's face.
  void write_edge_faces(RefinedMesh& refined) {
    edges_.for_each(stage_, [&](std::uint32_t h, std::uint32_t e) {
      const std::uint32_t o = view_.opposite(h), start = edge_face(e);
      starts_[view_.face_count() + e] = start;
      edge_numbers_[h] = edge_numbers_[o] = e;
      refined.corners[start] = view_.next(h);
      refined.corners[start + 1] = h;
      refined.corners[start + 2] = view_.next(o);
      refined.corners[start + 3] = o;
      refined.opposites[start] = h;
      refined.opposites[h] = start;
      refined.opposites[start + 2] = o;
      refined.opposites[o] = start + 2;
      end_at_boundary(h, start + 1, refined);
      end_at_boundary(o, start + 3, refined);
    });
  }

  /// If the origin of h is at the boundary, then so is `across`, the side of the edge's face there.
  void end_at_boundary(std::uint32_t h, std::uint32_t across, RefinedMesh& refined) const {
    if (!view_.is_boundary_vertex(view_.origin(h))) return;
    refined.opposites[across] = kNone;
    refined.outgoing[h] = HalfedgeId(across);
  }

  void write_vertex_faces(RefinedMesh& refined) {
    for_each_block(view_.vertex_count(), stage_, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
      Place place = vertex_faces_[block];
      for (std::uint32_t v = begin; v < end; ++v) {
        if (!is_interior(v)) continue;
        starts_[place.face++] = place.halfedge;
        view_.for_each_outgoing(view_.outgoing(v),
                                [&](std::uint32_t h) { write_vertex_side(h, place.halfedge++, refined); });
      }
    });
  }

  /// The side of a vertex's face from corner h to the next one counter-clockwise, across the edge before h.
  void write_vertex_side(std::uint32_t h, std::uint32_t side, RefinedMesh& refined) const {
    const std::uint32_t before = view_.prev(h);
    const std::uint32_t start = edge_face(edge_numbers_[before]);
    const std::uint32_t across = view_.is_first_of_edge(before) ? start + 3 : start + 1;
    refined.corners[side] = h;
    refined.opposites[side] = across;
    refined.opposites[across] = side;
  }

  View view_;
  Monitor monitor_;
  Stage stage_;
  EdgeEnumeration<View> edges_;
  std::uint32_t first_of_vertices_;
  std::vector<Place> vertex_faces_;          // per block of vertices, and the end
  LargeVector<std::uint32_t> starts_;        // per face of the result, and the end
  LargeVector<std::uint32_t> edge_numbers_;  // per half-edge that has an opposite
};

}  // namespace

Result<PolygonMesh> doo_sabin_step(const PolygonMesh& mesh, const Monitor& monitor, const std::string& what) {
  return with_view(mesh, [&](const auto& view) { return DooSabin(view, monitor, what).step(); });
}

}  // namespace algebra3d::subdivision
