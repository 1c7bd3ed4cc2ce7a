#include "algebra3d/validity/contacts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

#include "algebra3d/base/monitor.h"
#include "algebra3d/base/scheduler.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/halfedge/circulators.h"

namespace algebra3d {
namespace {

/// So many parts of a search are searched in parallel, if there are more faces than that.
constexpr std::size_t kContactParts = 256;
constexpr std::size_t kFewContactFaces = 2'000;

/// Nearly all points are outside the box. Rounded numbers are enough, as rounding is monotonic.
bool is_in_box_of(const TriangleRef& triangle, const Vec3& p) {
  const auto is_between = [&](std::size_t axis) {
    const auto [low, high] =
        std::minmax({triangle[0].approx[axis], triangle[1].approx[axis], triangle[2].approx[axis]});
    return low <= p[axis] && p[axis] <= high;
  };
  return is_between(0) && is_between(1) && is_between(2);
}

/// True if the point lies in the triangle, which is not degenerate, or in an edge, and is no corner.
bool is_in(const TriangleRef& triangle, const PointRef& p) {
  if (!is_in_box_of(triangle, p.approx)) return false;
  if (orient3d(triangle[0], triangle[1], triangle[2], p) != 0) return false;
  const ProjectedTurn turn = dominant_turn(triangle);
  int edges = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = orient2d(turn.projection, triangle[i], triangle[(i + 1) % 3], p);
    if (side == -turn.sign) return false;
    edges += side == 0 ? 1 : 0;
  }
  return edges < 2;
}

class ContactSearch {
 public:
  ContactSearch(const TriangleMesh& mesh, const FaceSet& known)
      : mesh_(mesh), known_(known), owner_(mesh.vertex_count()) {
    for (const bool is_known : {true, false})  // new faces last, so that they own their vertices
      for (const FaceId face : faces(mesh))
        if (known.contains(face.index()) == is_known)
          for (const std::uint32_t v : mesh.triangle(face)) owner_[v] = face;
  }

  /// Adds the contacts of vertices of one of the faces in the other.
  void add_contacts(FaceId f, FaceId g, std::vector<VertexContact>& contacts) const {
    if (known_.contains(f.index()) && known_.contains(g.index())) return;
    add_vertices_in(f, g, contacts);
    add_vertices_in(g, f, contacts);
  }

 private:
  /// Vertices of `other` that lie in `face`, if `other` owns them: so each vertex is looked at once.
  void add_vertices_in(FaceId face, FaceId other, std::vector<VertexContact>& contacts) const {
    const TriangleMesh::Triangle corners = mesh_.triangle(face);
    for (const std::uint32_t v : mesh_.triangle(other))
      if (owner_[v] == other && std::ranges::find(corners, v) == corners.end() &&
          is_in(mesh_.corners(face), mesh_.points()[v]))
        contacts.push_back({VertexId(v), face});
  }

  const TriangleMesh& mesh_;
  const FaceSet& known_;
  std::vector<FaceId> owner_;  // a face of each vertex, a new one if there is any
};

}  // namespace

Result<std::vector<VertexContact>> vertex_contacts(const TriangleMesh& mesh, const std::atomic<bool>* cancel) {
  return vertex_contacts(mesh, BoxHierarchy(mesh), FaceSet(), cancel);
}

Result<std::vector<VertexContact>> vertex_contacts(const TriangleMesh& mesh, const BoxHierarchy& hierarchy,
                                                   const FaceSet& known, const std::atomic<bool>* cancel) {
  const ContactSearch search(mesh, known);
  const Monitor monitor(cancel);
  const std::vector<BoxHierarchy::NodePair> parts =
      hierarchy.parts_of_search(mesh.face_count() > kFewContactFaces ? kContactParts : 1);
  auto contacts = parallel_collect(parts.size(), 1, [&](std::size_t first, std::size_t end) {
    std::vector<VertexContact> found;
    const auto look_at = [&](std::uint32_t f, std::uint32_t g) {
      search.add_contacts(FaceId(f), FaceId(g), found);
      return true;
    };
    for (std::size_t part = first; part < end; ++part)
      hierarchy.for_each_pair(parts[part], look_at, [&] { return !monitor.is_cancelled(); });
    return found;
  });
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  std::ranges::sort(contacts, {}, [](const VertexContact& contact) { return std::pair(contact.face, contact.vertex); });
  return contacts;
}

std::size_t vertex_count_of(const std::vector<VertexContact>& contacts) {
  std::set<VertexId> vertices;
  for (const VertexContact& contact : contacts) vertices.insert(contact.vertex);
  return vertices.size();
}

}  // namespace algebra3d
