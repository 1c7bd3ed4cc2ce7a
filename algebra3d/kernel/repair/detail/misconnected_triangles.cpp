#include "algebra3d/kernel/repair/detail/misconnected_triangles.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/missing_halfedges.h"

namespace algebra3d {
namespace {

/// A triangle with a manifold edge from `from` to `to`, and a corner between two missing half-edges.
struct WrongCorner {
  VertexId from, to, corner;
};

class MisconnectionSearch {
 public:
  explicit MisconnectionSearch(const IndexedSoup& soup)
      : soup_(soup), mesh_(soup.mesh()), missing_(*mesh_), is_inside_out_(is_inside_out()) {}

  /// Triangles to drop, of which no two are beside the same hole.
  IdVector<FaceId, bool> run();

 private:
  struct Candidate {
    double area;  ///< of the triangle in its place
    FaceId triangle;
    std::vector<MissingId> loop;  ///< around the hole, and the triangle's own edges
  };

  bool is_inside_out() const;
  double area(VertexId a, VertexId b, VertexId c) const {
    return length(cross(soup_.point(b) - soup_.point(a), soup_.point(c) - soup_.point(a))) / 2;
  }
  std::vector<Candidate> candidates() const;
  std::optional<Candidate> candidate(FaceId triangle) const;
  std::optional<WrongCorner> wrong_corner(FaceId triangle) const;
  bool is_beyond_edge(FaceId triangle, const WrongCorner& wrong, VertexId third) const;
  bool was_meant(const WrongCorner& wrong, VertexId third) const;

  const IndexedSoup& soup_;
  std::shared_ptr<const TriangleMesh> mesh_;
  MissingHalfedges missing_;
  bool is_inside_out_;
};

/// By the volume of the pyramids over all triangles with their apex in the middle of the box.
bool MisconnectionSearch::is_inside_out() const {
  Box3 box;
  for (const TriangleMesh::Triangle& triangle : soup_.triangles)
    for (const std::uint32_t corner : triangle) box.extend(soup_.points[corner]);
  const Vec3 apex = 0.5 * box.min + 0.5 * box.max;
  double sum = 0;
  for (const FaceId f : soup_.triangles.ids())
    sum += dot(soup_.corner(f, 0) - apex, cross(soup_.corner(f, 1) - apex, soup_.corner(f, 2) - apex));
  return sum < 0;
}

std::optional<WrongCorner> MisconnectionSearch::wrong_corner(FaceId triangle) const {
  for (const HalfedgeId edge : halfedges_of(*mesh_, triangle)) {
    const VertexId from = mesh_->origin(edge), to = mesh_->target(edge);
    const VertexId corner = mesh_->origin(TriangleMesh::prev(edge));
    const MissingId out = missing_.find(corner, to), back = missing_.find(from, corner);
    if (!mesh_->opposite(edge).is_valid() || out.is_none() || back.is_none()) continue;
    if (missing_.edges[out].is_boundary || missing_.edges[back].is_boundary) return WrongCorner{from, to, corner};
  }
  return std::nullopt;
}

/// True if the third corner is that of the triangle across the edge: then there is no hole, but an open patch.
bool MisconnectionSearch::is_beyond_edge(FaceId triangle, const WrongCorner& wrong, VertexId third) const {
  for (const HalfedgeId h : halfedges_of(*mesh_, triangle))
    if (const HalfedgeId other = mesh_->opposite(h); mesh_->origin(h) == wrong.from && other.is_valid())
      return mesh_->origin(TriangleMesh::prev(other)) == third;
  return false;
}

/// True if a triangle with that third corner in its place is what was meant: the wrong corner lies behind it, or it
/// takes no more area to replace the triangle than to add one on each side of it.
bool MisconnectionSearch::was_meant(const WrongCorner& wrong, VertexId third) const {
  constexpr double kDeep = 1e-6, kNoMore = 1 + 1e-9;
  const Vec3 &from = soup_.point(wrong.from), &to = soup_.point(wrong.to), &corner = soup_.point(wrong.corner);
  const Vec3 normal = cross(to - from, soup_.point(third) - from);
  const double size = length(normal) * length(corner - from);
  const double depth = size > 0 ? dot(normal, corner - from) / size * (is_inside_out_ ? 1 : -1) : 0;
  if (depth > kDeep) return true;
  const double added = area(wrong.from, wrong.to, third), lost = area(wrong.from, wrong.to, wrong.corner);
  const double beside = area(wrong.from, wrong.corner, third) + area(wrong.corner, wrong.to, third);
  return added + lost <= kNoMore * beside;
}

std::optional<MisconnectionSearch::Candidate> MisconnectionSearch::candidate(FaceId triangle) const {
  const std::optional<WrongCorner> wrong = wrong_corner(triangle);
  if (!wrong) return std::nullopt;
  // A hole of the size of one triangle: from the edge to the corner, round to the edge from it.
  std::vector<MissingId> loop = missing_.shortest_loop(missing_.find(wrong->corner, wrong->to), soup_.points);
  if (loop.size() != 4 || missing_.edges[loop.back()].from != wrong->from) return std::nullopt;
  const VertexId third = missing_.edges[loop[2]].from;
  if (third == wrong->from || is_beyond_edge(triangle, *wrong, third) || !was_meant(*wrong, third)) return std::nullopt;
  return Candidate{area(wrong->from, wrong->to, third), triangle, std::move(loop)};
}

/// Those whose replacement takes the least area come first.
std::vector<MisconnectionSearch::Candidate> MisconnectionSearch::candidates() const {
  std::set<VertexId> ends;
  for (const MissingHalfedge& edge : missing_.edges) ends.insert({edge.from, edge.to});
  const auto is_end = [&](std::uint32_t corner) { return ends.contains(VertexId(corner)); };
  std::vector<Candidate> result;
  for (const FaceId f : soup_.triangles.ids()) {
    if (!std::ranges::all_of(soup_.triangles[f], is_end)) continue;
    if (std::optional<Candidate> found = candidate(f)) result.push_back(*std::move(found));
  }
  std::ranges::sort(result, {}, [](const Candidate& c) { return std::pair(c.area, c.triangle); });
  return result;
}

IdVector<FaceId, bool> MisconnectionSearch::run() {
  IdVector<FaceId, bool> result(soup_.triangles.size());
  for (const Candidate& candidate : candidates()) {
    const auto is_covered = [&](MissingId i) { return missing_.edges[i].is_covered; };
    if (std::ranges::any_of(candidate.loop, is_covered)) continue;
    for (const MissingId i : candidate.loop) missing_.edges[i].is_covered = true;
    result[candidate.triangle] = true;
  }
  return result;
}

}  // namespace

void drop_misconnected_triangles(IndexedSoup& soup, RepairReport& report) {
  constexpr int kMostRounds = 20;
  for (int round = 0; round < kMostRounds; ++round) {
    const IdVector<FaceId, bool> is_misconnected = MisconnectionSearch(soup).run();
    for (const FaceId f : is_misconnected.ids())
      if (is_misconnected[f]) report.add(RepairStep::misconnected_triangles, soup.middle(f));
    if (!soup.drop(is_misconnected)) return;
  }
}

}  // namespace algebra3d
