#include "algebra3d/repair/misfits.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/repair/lacking_edges.h"

namespace algebra3d {
namespace {

double area_of_facet(const std::vector<Vec3>& p, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return length(cross(p[b] - p[a], p[c] - p[a])) / 2;
}

/// A facet with a manifold edge from `from` to `to` and a corner between two edges that lack something.
struct Misfit {
  std::uint32_t from, to, corner;
};

class MisfitSearch {
 public:
  explicit MisfitSearch(const FacetList& facets)
      : facets_(facets), linked_(facets.mesh()), mesh_(*linked_), lacks_(mesh_), looks_inward_(looks_inward()) {}

  /// The facets to drop, of which no two have a rim in common; ascending.
  std::vector<std::uint32_t> run();

 private:
  struct Candidate {
    double area;  ///< of the facet in its place
    std::uint32_t facet;
    std::vector<std::uint32_t> loop;  ///< of the open edges
  };

  bool looks_inward() const;
  std::vector<Candidate> candidates() const;
  std::optional<Misfit> misfit_at(std::uint32_t facet) const;
  bool is_beyond_edge(std::uint32_t facet, const Misfit& misfit, std::uint32_t third) const;
  bool is_wrong(const Misfit& misfit, std::uint32_t third) const;

  const FacetList& facets_;
  std::shared_ptr<const TriangleMesh> linked_;
  const TriangleMesh& mesh_;
  LackingEdges lacks_;
  bool looks_inward_;
};

/// As the volume of the pyramids over all facets with their tops in the middle of the box tells.
bool MisfitSearch::looks_inward() const {
  Box3 box;
  for (const TriangleMesh::Triangle& triangle : facets_.triangles)
    for (const std::uint32_t corner : triangle) box.extend(facets_.points[corner]);
  const Vec3 top = 0.5 * box.min + 0.5 * box.max;
  double sum = 0;
  for (std::size_t f = 0; f < facets_.triangles.size(); ++f)
    sum += dot(facets_.corner(f, 0) - top, cross(facets_.corner(f, 1) - top, facets_.corner(f, 2) - top));
  return sum < 0;
}

std::optional<Misfit> MisfitSearch::misfit_at(std::uint32_t facet) const {
  const TriangleMesh::Triangle& t = facets_.triangles[facet];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t from = t[i], to = t[(i + 1) % 3], corner = t[(i + 2) % 3];
    const bool is_held =
        mesh_.opposite(TriangleMesh::halfedge(FaceId(facet), static_cast<std::uint32_t>(i))).is_valid();
    const std::uint32_t out = lacks_.find(corner, to), back = lacks_.find(from, corner);
    if (!is_held || out == LackingEdges::kNone || back == LackingEdges::kNone) continue;
    if (lacks_.edges[out].is_boundary || lacks_.edges[back].is_boundary) return Misfit{from, to, corner};
  }
  return std::nullopt;
}

/// True if the third corner is that of the facet on the other side of the edge: then there is no hole, but a sheet.
bool MisfitSearch::is_beyond_edge(std::uint32_t facet, const Misfit& misfit, std::uint32_t third) const {
  for (std::uint32_t i = 0; i < 3; ++i) {
    const HalfedgeId h = TriangleMesh::halfedge(FaceId(facet), i), other = mesh_.opposite(h);
    if (mesh_.origin(h).index() == misfit.from && other.is_valid())
      return mesh_.origin(TriangleMesh::prev(other)).index() == third;
  }
  return false;
}

/// True if a facet with that third corner in its place is what was meant: its own corner lies behind that one, or it
/// takes no more area to leave it out and put the other in its place than to add one on each side.
bool MisfitSearch::is_wrong(const Misfit& misfit, std::uint32_t third) const {
  constexpr double kDeep = 1e-6, kNoDearer = 1 + 1e-9;
  const std::vector<Vec3>& p = facets_.points;
  const Vec3 &from = p[misfit.from], &to = p[misfit.to], &corner = p[misfit.corner];
  const Vec3 normal = cross(to - from, p[third] - from);
  const double size = length(normal) * length(corner - from);
  const double depth = size > 0 ? dot(normal, corner - from) / size * (looks_inward_ ? 1 : -1) : 0;
  if (depth > kDeep) return true;
  const double added = area_of_facet(p, misfit.from, misfit.to, third);
  const double lost = area_of_facet(p, misfit.from, misfit.to, misfit.corner);
  const double beside =
      area_of_facet(p, misfit.from, misfit.corner, third) + area_of_facet(p, misfit.corner, misfit.to, third);
  return added + lost <= kNoDearer * beside;
}

/// All that may be misfits, those that take the least area to replace first.
std::vector<MisfitSearch::Candidate> MisfitSearch::candidates() const {
  std::vector<Candidate> result;
  std::set<std::uint32_t> ends;
  for (const LackingEdge& edge : lacks_.edges) ends.insert({edge.from, edge.to});
  for (std::uint32_t f = 0; f < facets_.triangles.size(); ++f) {
    const TriangleMesh::Triangle& t = facets_.triangles[f];
    if (!std::ranges::all_of(t, [&](std::uint32_t corner) { return ends.contains(corner); })) continue;
    const std::optional<Misfit> misfit = misfit_at(f);
    if (!misfit) continue;
    // A hole of the size of one facet: from the edge to the corner round to the edge from it.
    std::vector<std::uint32_t> loop = lacks_.shortest_loop(lacks_.find(misfit->corner, misfit->to), facets_.points);
    if (loop.size() != 4 || lacks_.edges[loop.back()].from != misfit->from) continue;
    const std::uint32_t third = lacks_.edges[loop[2]].from;
    if (third == misfit->from || is_beyond_edge(f, *misfit, third) || !is_wrong(*misfit, third)) continue;
    result.push_back({area_of_facet(facets_.points, misfit->from, misfit->to, third), f, std::move(loop)});
  }
  std::ranges::sort(result, {}, [](const Candidate& c) { return std::pair(c.area, c.facet); });
  return result;
}

std::vector<std::uint32_t> MisfitSearch::run() {
  std::vector<std::uint32_t> result;
  for (const Candidate& candidate : candidates()) {
    if (std::ranges::any_of(candidate.loop, [&](std::uint32_t i) { return lacks_.edges[i].is_covered; })) continue;
    for (const std::uint32_t i : candidate.loop) lacks_.edges[i].is_covered = true;
    result.push_back(candidate.facet);
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace

void drop_misfits(FacetList& facets, RepairReport& report) {
  constexpr int kMostRounds = 20;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<std::uint32_t> misfits = MisfitSearch(facets).run();
    if (misfits.empty()) return;
    for (const std::uint32_t f : misfits) report.add(RepairStep::misfits, facets.middle(f));
    std::size_t kept = 0, next = 0;
    for (std::uint32_t f = 0; f < facets.triangles.size(); ++f) {
      const bool is_dropped = next < misfits.size() && misfits[next] == f;
      if (is_dropped) ++next;
      if (!is_dropped) facets.triangles[kept++] = facets.triangles[f];
    }
    facets.triangles.resize(kept);
    facets.changed();
  }
}

}  // namespace algebra3d
