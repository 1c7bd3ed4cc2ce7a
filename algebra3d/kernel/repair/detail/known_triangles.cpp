#include "algebra3d/kernel/repair/detail/known_triangles.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// True if the second triangle has the corners of the first in the same cyclic order.
bool have_same_orientation(const TriangleRef& one, const TriangleRef& other) {
  for (std::size_t shift = 0; shift < 3; ++shift)
    if (one[0].approx == other[shift].approx) return one[1].approx == other[(shift + 1) % 3].approx;
  return false;
}

/// Some faces of meshes whose volume is asked for, with points of their own: the points of a whole file need not be
/// looked at.
class FacesToSum {
 public:
  void add(const TriangleMesh& mesh, FaceId face) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    for (const PointRef& corner : mesh.corners(face)) points_.push_back(corner);
    triangles_.push_back({first, first + 1, first + 2});
  }
  Result<Rational> volume(const std::atomic<bool>* cancel) const { return exact_volume(points_, triangles_, cancel); }

 private:
  PointArray points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

}  // namespace

KnownTriangles::KnownTriangles(std::shared_ptr<const TriangleMesh> mesh, const FaceSet& free, Rational volume)
    : mesh_(std::move(mesh)), volume_(std::move(volume)) {
  list_by_lowest_corner(free);
}

KnownTriangles::Corners KnownTriangles::sorted_corners(FaceId face) const {
  const auto& [a, b, c] = mesh_->triangle(face);
  Corners corners{VertexId(a), VertexId(b), VertexId(c)};
  std::ranges::sort(corners);
  return corners;
}

void KnownTriangles::list_by_lowest_corner(const FaceSet& free) {
  starts_.assign(mesh_->vertex_count() + 1, 0);
  if (free.is_empty()) return;
  const auto for_each_free = [&](auto visit) {
    for (const FaceId face : faces(*mesh_))
      if (free.contains(face.index())) visit(face, sorted_corners(face));
  };
  for_each_free([&](FaceId, const Corners& corners) { ++starts_[corners[0].index() + 1]; });
  for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
  entries_.resize(starts_.back());
  std::vector<std::uint32_t> places(starts_.begin(), starts_.end() - 1);
  for_each_free([&](FaceId face, const Corners& corners) {
    entries_[places[corners[0].index()]++] = {corners[1], corners[2], face};
  });
  for (std::size_t v = 0; v + 1 < starts_.size(); ++v)
    std::ranges::sort(std::span(entries_).subspan(starts_[v], starts_[v + 1] - starts_[v]));
}

/// The free face with these corners; invalid if there is none.
FaceId KnownTriangles::find(Corners corners) const {
  std::ranges::sort(corners);
  const std::size_t first = starts_[corners[0].index()], last = starts_[corners[0].index() + 1];
  const auto entries = std::span(entries_).subspan(first, last - first);
  const auto found = std::ranges::lower_bound(entries, Entry{corners[1], corners[2], FaceId(0)});
  const bool is_found = found != entries.end() && found->middle == corners[1] && found->highest == corners[2];
  return is_found ? found->face : FaceId();
}

/// Per point: the vertex there. Invalid if there is none, or an earlier point is equal.
IdVector<VertexId, VertexId> KnownTriangles::equal_points(const PointArray& others) const {
  const std::vector<Vec3>& points = mesh_->points().approx();
  IdVector<VertexId, VertexId> result(others.size());
  if (others.exact_count() == 0 && others.approx() == points) {
    std::ranges::copy(result.ids(), result.begin());
    return result;
  }
  PointTable table(points.size());
  for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex)
    if (table.intern(PointRef(points[vertex])) != vertex) return result;
  std::vector<bool> is_taken(points.size());
  for (const VertexId point : result.ids()) {
    if (!others[point.index()].is_double()) continue;
    const std::uint32_t vertex = table.find(others.approx()[point.index()]);
    if (vertex == kNone || is_taken[vertex]) continue;
    is_taken[vertex] = true;
    result[point] = VertexId(vertex);
  }
  return result;
}

FaceMatches KnownTriangles::recognise(const TriangleMesh& other) const {
  FaceMatches result(other.face_count());
  if (entries_.empty()) return result;
  const IdVector<VertexId, VertexId> vertices = equal_points(other.points());
  IdVector<FaceId, bool> is_taken(mesh_->face_count());
  for (const FaceId f : result.ids()) {
    const auto& [a, b, c] = other.triangle(f);
    const Corners corners{vertices[VertexId(a)], vertices[VertexId(b)], vertices[VertexId(c)]};
    if (std::ranges::find(corners, VertexId()) != corners.end()) continue;
    const FaceId face = find(corners);
    if (!face.is_valid() || is_taken[face]) continue;
    is_taken[face] = true;
    result[f] = face;
  }
  return result;
}

Result<Rational> KnownTriangles::volume_of(const TriangleMesh& other, const FaceMatches& recognised,
                                           const std::atomic<bool>* cancel) const {
  IdVector<FaceId, bool> is_left(mesh_->face_count());
  FacesToSum added, lost;
  for (const FaceId f : recognised.ids()) {
    const FaceId face = recognised[f];
    const bool is_same = face.is_valid() && have_same_orientation(other.corners(f), mesh_->corners(face));
    if (is_same)
      is_left[face] = true;
    else
      added.add(other, f);
  }
  for (const FaceId face : is_left.ids())
    if (!is_left[face]) lost.add(*mesh_, face);
  A3D_ASSIGN(const Rational more, added.volume(cancel));
  A3D_ASSIGN(const Rational less, lost.volume(cancel));
  return volume_ + more - less;
}

FaceSet recognised_faces(const FaceMatches& recognised) {
  std::vector<bool> are_in;
  are_in.reserve(recognised.size());
  for (const FaceId face : recognised) are_in.push_back(face.is_valid());
  return FaceSet(std::move(are_in));
}

}  // namespace algebra3d
