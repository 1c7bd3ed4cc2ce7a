#include "algebra3d/repair/fins.h"

#include <map>
#include <vector>

#include "algebra3d/repair/facet_parts.h"

namespace algebra3d {
namespace {

/// What hangs together across edges of two facets.
struct Part {
  bool has_end = false;    ///< an edge that no other facet has
  bool hangs = false;      ///< an edge of more than two facets
  bool is_needed = false;  ///< by the others at such an edge
  double area = 0;
};

/// Notes which parts hang on others at the edge, and which of them the others cannot do without.
void look_at(const TriangleMesh& mesh, std::span<const HalfedgeId> edge, arrangement::DisjointSets& sets,
             std::vector<Part>& parts) {
  int balance = 0;
  std::map<std::uint32_t, std::pair<int, std::size_t>> shares;  // of each part: balance and facets
  for (const HalfedgeId h : edge) {
    const int sign = mesh.origin(h) == mesh.origin(edge[0]) ? 1 : -1;
    balance += sign;
    auto& [share, count] = shares[sets.find(h.index() / 3)];
    share += sign;
    ++count;
  }
  double area = 0;
  for (const auto& [part, share] : shares) area += parts[part].area;
  for (const auto& [part, share] : shares) {
    parts[part].hangs = true;
    // A needle that lies on the rim of a hole does not make a fin of the body.
    if (parts[part].area > area - parts[part].area) parts[part].is_needed = true;
    const bool others_balance = balance == share.first && share.second < edge.size();
    parts[part].is_needed = parts[part].is_needed || !others_balance;
  }
}

/// False if there are none.
bool drop_some(FacetList& facets, RepairReport& report) {
  const auto linked = facets.mesh();
  const TriangleMesh& mesh = *linked;
  arrangement::DisjointSets sets = parts_across_simple_edges(mesh);
  std::vector<Part> parts(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3 &a = facets.corner(f, 0), &b = facets.corner(f, 1), &c = facets.corner(f, 2);
    parts[sets.find(f)].area += length(cross(b - a, c - a)) / 2;
  }
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    if (mesh.is_boundary(HalfedgeId(h))) parts[sets.find(h / 3)].has_end = true;
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    if (const auto edge = mesh.nonmanifold_edge(n); edge.size() > 2) look_at(mesh, edge, sets, parts);
  std::size_t kept = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Part& part = parts[sets.find(f)];
    const bool is_fin = part.has_end && part.hangs && !part.is_needed;
    if (is_fin) report.add(RepairStep::fins, facets.middle(f));
    if (!is_fin) facets.triangles[kept++] = mesh.triangle(FaceId(f));
  }
  const bool has_dropped = kept < facets.triangles.size();
  facets.triangles.resize(kept);
  if (has_dropped) facets.changed();
  return has_dropped;
}

}  // namespace

void drop_fins(FacetList& facets, RepairReport& report) {
  // Fins may hang on fins.
  constexpr int kMostRounds = 20;
  for (int round = 0; round < kMostRounds && drop_some(facets, report); ++round) {
  }
}

}  // namespace algebra3d
