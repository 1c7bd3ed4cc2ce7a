#include "algebra3d/kernel/subdivision/divided_contacts.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// Divides edges first, then vertices.
class ContactDivision {
 public:
  ContactDivision(const PolygonMesh& mesh, ContactsOf kind) : mesh_(mesh), corners_(mesh.origins()) {
    opposites_.resize(mesh.halfedge_count());
    for (const HalfedgeId h : halfedges(mesh)) opposites_[h.index()] = mesh.opposite(h).index();
    if (kind == ContactsOf::solids)
      for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) pair_across_material(mesh.nonmanifold_edge(n));
    outgoing_.resize(mesh.vertex_count());
    for (const VertexId v : vertices(mesh)) outgoing_[v.index()] = mesh.outgoing(v);
    points_ = mesh.points();
    divide_vertices();
  }

  DividedContacts result() && {
    return {PolygonMesh(std::move(points_), mesh_.layout(), std::move(corners_), std::move(opposites_),
                        std::move(outgoing_)),
            mesh_.nonmanifold_edge_count(), divided_vertex_count_};
  }

 private:
  HalfedgeId opposite(HalfedgeId h) const { return HalfedgeId(opposites_[h.index()]); }
  PointRef third(HalfedgeId h) const { return mesh_.point(mesh_.origin(mesh_.prev(h))); }

  /// Material lies counter-clockwise of the faces that run against the edge, up to the next one that runs along it.
  void pair_across_material(std::span<const HalfedgeId> along) {
    const VertexId start = mesh_.origin(along.front()), end = mesh_.target(along.front());
    const PointRef e0 = mesh_.point(start), e1 = mesh_.point(end);
    for (const HalfedgeId against : along) {
      if (mesh_.origin(against) == start) continue;
      HalfedgeId nearest;
      for (const HalfedgeId h : along) {
        if (mesh_.origin(h) != start) continue;
        if (!nearest.is_valid() || compare_around_edge(e0, e1, third(against), third(h), third(nearest)) < 0)
          nearest = h;
      }
      if (!nearest.is_valid() || opposite(nearest).is_valid()) continue;
      opposites_[nearest.index()] = against.index();
      opposites_[against.index()] = nearest.index();
    }
  }

  void divide_vertices() {
    std::vector<bool> is_seen(mesh_.halfedge_count(), false);
    for (const VertexId v : mesh_.nonmanifold_vertices()) divide(v, is_seen);
    // At both ends of a divided edge the fans may have become one.
    for (std::size_t n = 0; n < mesh_.nonmanifold_edge_count(); ++n) {
      const HalfedgeId h = mesh_.nonmanifold_edge(n).front();
      divide(mesh_.origin(h), is_seen);
      divide(mesh_.target(h), is_seen);
    }
  }

  void divide(VertexId v, std::vector<bool>& is_seen) {
    std::vector<HalfedgeId> corners;
    for (const HalfedgeId h : outgoing_halfedges(mesh_, v)) corners.push_back(h);
    std::ranges::sort(corners);
    std::size_t fan_count = 0;
    for (const HalfedgeId corner : corners) {
      poll_interruption_at(corner.index());
      if (is_seen[corner.index()]) continue;
      const VertexId vertex = fan_count++ == 0 ? v : VertexId(points_.size());
      if (vertex != v) {
        points_.push_back(mesh_.point(v));
        outgoing_.push_back(HalfedgeId());
      }
      outgoing_[vertex.index()] = take_fan(corner, vertex, is_seen);
    }
    if (fan_count > 1) ++divided_vertex_count_;
  }

  /// Gives the corners of a fan a vertex. Returns its outgoing half-edge: at the boundary the first one
  /// counter-clockwise, else the lowest, which `corner` is.
  HalfedgeId take_fan(HalfedgeId corner, VertexId vertex, std::vector<bool>& is_seen) {
    HalfedgeId first = corner;
    while (opposite(first).is_valid()) {
      first = mesh_.next(opposite(first));
      if (first == corner) break;
    }
    const bool is_open = opposite(first).is_none();
    for (HalfedgeId h = first;;) {
      is_seen[h.index()] = true;
      corners_[h.index()] = vertex.index();
      h = opposite(mesh_.prev(h));
      if (h.is_none() || h == first) break;
    }
    return is_open ? first : corner;
  }

  const PolygonMesh& mesh_;
  LargeVector<std::uint32_t> corners_, opposites_;  // per half-edge
  LargeVector<HalfedgeId> outgoing_;                // per vertex
  PointArray points_;
  std::size_t divided_vertex_count_ = 0;
};

}  // namespace

Result<DividedContacts> divided_contacts(const PolygonMesh& mesh, ContactsOf kind) {
  if (kind == ContactsOf::surfaces)
    for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
      const auto along = mesh.nonmanifold_edge(n);
      if (along.size() == 2)
        return Error{ErrorCode::invalid_value,
                     "both faces at the edge between vertices {} and {} run along it in the same direction",
                     mesh.origin(along.front()).index(), mesh.target(along.front()).index()};
    }
  return ContactDivision(mesh, kind).result();
}

}  // namespace algebra3d
