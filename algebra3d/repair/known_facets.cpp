#include "algebra3d/repair/known_facets.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "algebra3d/exact/exact_sum.h"
#include "algebra3d/repair/point_table.h"

namespace algebra3d {
namespace {

/// True if the second has the same corners as the first in the same order, going round.
bool looks_the_same_way(const TriangleRef& one, const TriangleRef& other) {
  for (std::size_t shift = 0; shift < 3; ++shift)
    if (one[0].approx == other[shift].approx) return one[1].approx == other[(shift + 1) % 3].approx;
  return false;
}

/// The sum over some faces of meshes, with points of their own: those of a whole file need not be looked at.
class FacesToSum {
 public:
  void add(const TriangleMesh& mesh, std::uint32_t face) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    for (const PointRef& corner : mesh.corners(FaceId(face))) points_.push_back(corner);
    triangles_.push_back({first, first + 1, first + 2});
  }
  Result<Rational> volume(const std::atomic<bool>* cancel) const { return exact_volume(points_, triangles_, cancel); }

 private:
  PointArray points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

}  // namespace

KnownFacets::KnownFacets(std::shared_ptr<const TriangleMesh> mesh, const FaceSet& free, Rational volume)
    : mesh_(std::move(mesh)), volume_(std::move(volume)) {
  list_by_lowest_corner(free);
}

void KnownFacets::list_by_lowest_corner(const FaceSet& free) {
  starts_.assign(mesh_->vertex_count() + 1, 0);
  const auto for_each_free = [&](auto visit) {
    for (std::uint32_t f = 0; f < mesh_->face_count(); ++f) {
      if (!free.contains(f)) continue;
      TriangleMesh::Triangle corners = mesh_->triangle(FaceId(f));
      std::ranges::sort(corners);
      visit(f, corners);
    }
  };
  for_each_free([&](std::uint32_t, const auto& corners) { ++starts_[corners[0] + 1]; });
  for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
  entries_.resize(starts_.back());
  std::vector<std::uint32_t> places(starts_.begin(), starts_.end() - 1);
  for_each_free([&](std::uint32_t f, const auto& corners) {
    entries_[places[corners[0]]++] = {corners[1], corners[2], f};
  });
  for (std::size_t v = 0; v + 1 < starts_.size(); ++v)
    std::ranges::sort(std::span(entries_).subspan(starts_[v], starts_[v + 1] - starts_[v]));
}

/// The free face with these corners; kNone if there is none.
std::uint32_t KnownFacets::find(TriangleMesh::Triangle corners) const {
  std::ranges::sort(corners);
  const auto entries = std::span(entries_).subspan(starts_[corners[0]], starts_[corners[0] + 1] - starts_[corners[0]]);
  const auto found = std::ranges::lower_bound(entries, Entry{corners[1], corners[2], 0});
  const bool is_found = found != entries.end() && found->middle == corners[1] && found->highest == corners[2];
  return is_found ? found->face : kNone;
}

/// Per point: the vertex that is there; kNone if there is none, or an earlier point is there already.
std::vector<std::uint32_t> KnownFacets::equal_points(const PointArray& others) const {
  const std::vector<Vec3>& points = mesh_->points().approx();
  std::vector<std::uint32_t> result(others.size(), kNone);
  if (others.exact_count() == 0 && others.approx() == points) {
    std::iota(result.begin(), result.end(), 0U);
    return result;
  }
  PointTable table(2 * points.size());
  for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex)
    if (table.number_of(points[vertex], hash_of(points[vertex])) != vertex) return result;
  std::vector<bool> is_taken(points.size());
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (!others[i].is_double()) continue;
    const Vec3& p = others.approx()[i];
    const std::uint32_t vertex = table.find(p, hash_of(p));
    if (vertex == PointTable::kNone || is_taken[vertex]) continue;
    is_taken[vertex] = true;
    result[i] = vertex;
  }
  return result;
}

std::vector<std::uint32_t> KnownFacets::recognise(const TriangleMesh& other) const {
  const std::vector<std::uint32_t> vertices = equal_points(other.points());
  std::vector<bool> is_taken(mesh_->face_count());
  std::vector<std::uint32_t> result(other.face_count(), kNone);
  for (std::uint32_t f = 0; f < other.face_count(); ++f) {
    TriangleMesh::Triangle corners = other.triangle(FaceId(f));
    for (std::uint32_t& corner : corners) corner = vertices[corner];
    if (std::ranges::find(corners, kNone) != corners.end()) continue;
    const std::uint32_t face = find(corners);
    if (face == kNone || is_taken[face]) continue;
    is_taken[face] = true;
    result[f] = face;
  }
  return result;
}

Result<Rational> KnownFacets::volume_of(const TriangleMesh& other, const std::vector<std::uint32_t>& recognised,
                                        const std::atomic<bool>* cancel) const {
  std::vector<bool> is_left(mesh_->face_count());
  FacesToSum added, lost;
  for (std::uint32_t f = 0; f < other.face_count(); ++f) {
    const std::uint32_t face = recognised[f];
    const bool is_same = face != kNone && looks_the_same_way(other.corners(FaceId(f)), mesh_->corners(FaceId(face)));
    if (is_same)
      is_left[face] = true;
    else
      added.add(other, f);
  }
  for (std::uint32_t f = 0; f < mesh_->face_count(); ++f)
    if (!is_left[f]) lost.add(*mesh_, f);
  ASSIGN_OR_RETURN(const Rational more, added.volume(cancel));
  ASSIGN_OR_RETURN(const Rational less, lost.volume(cancel));
  return volume_ + more - less;
}

FaceSet recognised_faces(const std::vector<std::uint32_t>& recognised) {
  std::vector<bool> are_in(recognised.size());
  for (std::size_t f = 0; f < are_in.size(); ++f) are_in[f] = recognised[f] != KnownFacets::kNone;
  return FaceSet(std::move(are_in));
}

}  // namespace algebra3d
