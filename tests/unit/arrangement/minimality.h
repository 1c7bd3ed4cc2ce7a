#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::solids {

/// Number of triangles that a valid solid has and its set of points does not need (docs/set-operations.md, "Minimal
/// results"), read off the finished mesh. An edge is needed unless the two triangles along it lie in one plane. A
/// vertex is not needed if no needed edge ends in it, in one fan of triangles: two triangles too many. Nor is it where
/// all facets along one needed edge turn by 180 degrees to the opposite needed edge: one too many in each facet. Owes
/// nothing to the arrangement. Exact.
class Superfluity {
 public:
  explicit Superfluity(const TriangleMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) look_at(VertexId(v));
  }

  std::size_t triangle_count() const { return count_; }

 private:
  /// A facet at a vertex between two needed edges, named by the other ends of these.
  struct Wedge {
    VertexId from, to;
  };

  bool is_flat(HalfedgeId h) const {
    const HalfedgeId other = mesh_.opposite(h);
    if (!other.is_valid()) return false;
    const TriangleRef t = mesh_.corners(TriangleMesh::face(h));
    return orient3d(t[0], t[1], t[2], mesh_.point(mesh_.origin(TriangleMesh::prev(other)))) == 0;
  }

  void look_at(VertexId v) {
    std::vector<Wedge> wedges;
    for (const HalfedgeId fan : mesh_.fans(v)) {
      std::vector<HalfedgeId> outgoing;
      HalfedgeId h = fan;
      do {
        outgoing.push_back(h);
        h = mesh_.opposite(TriangleMesh::prev(h));
      } while (h.is_valid() && h != fan);
      bool is_inner = true;
      for (const HalfedgeId first : outgoing) {
        is_inner = is_inner && is_flat(first);
        if (is_flat(first)) continue;
        HalfedgeId last = first;
        while (is_flat(TriangleMesh::prev(last))) last = mesh_.opposite(TriangleMesh::prev(last));
        wedges.push_back({mesh_.target(first), mesh_.origin(TriangleMesh::prev(last))});
      }
      if (is_inner) count_ += 2;
    }
    count_straight(v, wedges);
  }

  void count_straight(VertexId v, const std::vector<Wedge>& wedges) {
    std::map<VertexId, std::multiset<VertexId>> others;  // of each needed edge: where its facets end
    for (const Wedge& wedge : wedges) {
      others[wedge.from].insert(wedge.to);
      others[wedge.to].insert(wedge.from);
    }
    for (const auto& [one, ends] : others) {
      const VertexId other = *ends.begin();
      if (!(one < other) || ends.count(other) != ends.size() || others[other].size() != ends.size()) continue;
      const PointRef a = mesh_.point(one), here = mesh_.point(v), b = mesh_.point(other);
      if (collinear(a, here, b) && compare(a, here) == compare(here, b)) count_ += ends.size();
    }
  }

  const TriangleMesh& mesh_;
  std::size_t count_ = 0;
};

}  // namespace algebra3d::solids
