#include "algebra3d/repair/degenerate_facets.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/disjoint_sets.h"
#include "algebra3d/exact/predicates.h"
#include "algebra3d/halfedge/topology.h"

namespace algebra3d {
namespace {

using Corners = TriangleMesh::Triangle;

/// Facets with the same corners, by their numbers in the list.
struct EqualFacets {
  std::vector<std::uint32_t> facets;  // ascending
  int balance = 0;                    // those that look one way less those that look the other way
};

bool is_even(const Corners& c) {
  return (c[0] < c[1]) + (c[1] < c[2]) + (c[2] < c[0]) == 2;
}

/// Facets that may have the corners of another one: facets with the same corners have all edges in common, so either an
/// edge is not manifold, or the same facet is across all three.
std::vector<std::uint32_t> suspects(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto across = [&](std::uint32_t corner) { return mesh.opposite(TriangleMesh::halfedge(FaceId(f), corner)); };
    const HalfedgeId a = across(0), b = across(1), c = across(2);
    const auto is_nonmanifold = [&](std::uint32_t corner) {
      return mesh.is_nonmanifold(TriangleMesh::halfedge(FaceId(f), corner));
    };
    const bool is_back_to_back = a.is_valid() && b.is_valid() && c.is_valid() &&
                                 TriangleMesh::face(a) == TriangleMesh::face(b) &&
                                 TriangleMesh::face(b) == TriangleMesh::face(c);
    if (is_back_to_back || is_nonmanifold(0) || is_nonmanifold(1) || is_nonmanifold(2)) result.push_back(f);
  }
  return result;
}

/// All that are not alone.
std::vector<EqualFacets> equal_facets(const TriangleMesh& mesh) {
  std::vector<std::pair<Corners, std::uint32_t>> keys;
  for (const std::uint32_t f : suspects(mesh)) {
    Corners key = mesh.triangle(FaceId(f));
    std::ranges::sort(key);
    keys.emplace_back(key, f);
  }
  std::ranges::sort(keys);
  std::vector<EqualFacets> result;
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    while (last < keys.size() && keys[last].first == keys[first].first) ++last;
    if (last - first < 2) continue;
    EqualFacets equal;
    for (std::size_t i = first; i < last; ++i) {
      equal.facets.push_back(keys[i].second);
      equal.balance += is_even(mesh.triangle(FaceId(keys[i].second))) ? 1 : -1;
    }
    result.push_back(std::move(equal));
  }
  return result;
}

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// Facets of which as many look one way as the other, each set of them taken for one facet. Such facets hang together
/// across edges that nothing else has, in patches. A patch is needed by the surface round it where that has an odd
/// number of facets at an edge of the patch, and has nothing to do with it, as the two walls between boxes that were
/// glued together, where their number is even.
class OpposedFacets {
 public:
  /// The facets that are dropped are not looked at.
  OpposedFacets(const TriangleMesh& mesh, const std::vector<EqualFacets>& sets, const std::vector<bool>& is_dropped);

  /// Per set: the facet that stays, looking the way its neighbours do; none if no one is needed.
  std::vector<std::uint32_t> kept();

 private:
  struct Neighbour {
    std::uint32_t set;
    bool same_way;  // along the common edge, as far as the first facets of the sets go
  };

  void look_at(std::uint32_t set, HalfedgeId edge, const std::vector<bool>& is_dropped);
  std::vector<bool> are_needed();
  void spread_turns(std::uint32_t from);

  const TriangleMesh& mesh_;
  const std::vector<EqualFacets>& sets_;
  std::vector<std::uint32_t> set_of_;  // per facet
  arrangement::DisjointSets patches_;
  std::vector<double> votes_;                       // per set: length of edges that need it less that of others
  std::vector<std::vector<Neighbour>> neighbours_;  // per set
  std::vector<std::optional<bool>> turns_;          // per set: whether its first facet looks the wrong way, if known
};

OpposedFacets::OpposedFacets(const TriangleMesh& mesh, const std::vector<EqualFacets>& sets,
                             const std::vector<bool>& is_dropped)
    : mesh_(mesh),
      sets_(sets),
      set_of_(mesh.face_count(), kNone),
      patches_(sets.size()),
      votes_(sets.size()),
      neighbours_(sets.size()),
      turns_(sets.size()) {
  for (std::uint32_t set = 0; set < sets.size(); ++set)
    for (const std::uint32_t facet : sets[set].facets) set_of_[facet] = set;
  for (std::uint32_t set = 0; set < sets.size(); ++set)
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      look_at(set, TriangleMesh::halfedge(FaceId(sets[set].facets[0]), corner), is_dropped);
}

void OpposedFacets::look_at(std::uint32_t set, HalfedgeId edge, const std::vector<bool>& is_dropped) {
  std::vector<HalfedgeId> single;              // of facets that are no part of a set
  std::map<std::uint32_t, HalfedgeId> others;  // of other sets, with that of their first facet
  if (mesh_.is_nonmanifold(edge)) {
    for (const HalfedgeId h : mesh_.edge_halfedges(edge)) {
      const std::uint32_t facet = TriangleMesh::face(h).index(), other = set_of_[facet];
      if (other == kNone && !is_dropped[facet]) single.push_back(h);
      if (other != kNone && other != set && sets_[other].facets[0] == facet) others.emplace(other, h);
    }
  }
  const auto runs_along = [&](HalfedgeId h) { return mesh_.origin(h) == mesh_.origin(edge); };
  if (single.empty() && others.size() == 1) {
    const auto& [other, h] = *others.begin();
    patches_.unite(set, other);
    neighbours_[set].push_back({other, runs_along(h)});
  }
  if (single.empty() || !others.empty()) return;
  const double length_of_edge = length(mesh_.point(mesh_.target(edge)).approx - mesh_.point(mesh_.origin(edge)).approx);
  votes_[set] += single.size() % 2 == 1 ? length_of_edge : -length_of_edge;
  if (single.size() == 1 && !turns_[set]) turns_[set] = runs_along(single[0]);
}

/// Per set. A part of the facets that is double all over keeps one of each.
std::vector<bool> OpposedFacets::are_needed() {
  std::vector<double> votes(sets_.size());
  for (std::uint32_t set = 0; set < sets_.size(); ++set) votes[patches_.find(set)] += votes_[set];
  const FaceComponents parts = connected_components(mesh_);
  std::vector<bool> is_double(parts.count, true);
  for (std::uint32_t facet = 0; facet < mesh_.face_count(); ++facet)
    if (set_of_[facet] == kNone) is_double[parts.of_face[facet]] = false;
  std::vector<bool> result;
  for (std::uint32_t set = 0; set < sets_.size(); ++set)
    result.push_back(votes[patches_.find(set)] > 0 || is_double[parts.of_face[sets_[set].facets[0]]]);
  return result;
}

/// To all sets of the patch of which nothing is known.
void OpposedFacets::spread_turns(std::uint32_t from) {
  std::vector<std::uint32_t> reached{from};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const Neighbour& neighbour : neighbours_[reached[i]]) {
      if (turns_[neighbour.set]) continue;
      turns_[neighbour.set] = *turns_[reached[i]] != neighbour.same_way;
      reached.push_back(neighbour.set);
    }
}

std::vector<std::uint32_t> OpposedFacets::kept() {
  for (std::uint32_t set = 0; set < sets_.size(); ++set)
    if (turns_[set]) spread_turns(set);
  const std::vector<bool> needed = are_needed();
  std::vector<std::uint32_t> result(sets_.size(), kNone);
  for (std::uint32_t set = 0; set < sets_.size(); ++set) {
    if (!needed[set]) continue;
    if (!turns_[set]) {
      turns_[set] = false;
      spread_turns(set);
    }
    const auto is_even_facet = [&](std::uint32_t f) { return is_even(mesh_.triangle(FaceId(f))); };
    const bool even = is_even_facet(sets_[set].facets[0]) != *turns_[set];
    result[set] = *std::ranges::find_if(sets_[set].facets, [&](std::uint32_t f) { return is_even_facet(f) == even; });
  }
  return result;
}

void remove(FacetList& facets, const std::vector<bool>& is_dropped) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < facets.triangles.size(); ++i)
    if (!is_dropped[i]) facets.triangles[kept++] = facets.triangles[i];
  if (kept == facets.triangles.size()) return;
  facets.triangles.resize(kept);
  facets.changed();
}

}  // namespace

void drop_degenerate_facets(FacetList& facets, RepairReport& report) {
  std::vector<bool> is_dropped(facets.triangles.size());
  for (std::size_t i = 0; i < is_dropped.size(); ++i) {
    const auto& [a, b, c] = facets.triangles[i];
    const bool repeats = a == b || b == c || c == a;
    is_dropped[i] = repeats || collinear(facets.points[a], facets.points[b], facets.points[c]);
    if (is_dropped[i])
      report.add(repeats ? RepairStep::repeated_corners : RepairStep::collinear_corners, facets.middle(i));
  }
  remove(facets, is_dropped);
}

bool has_duplicate_facets(const TriangleMesh& mesh) {
  return !equal_facets(mesh).empty();
}

void drop_opposed_facets(FacetList& facets, RepairReport& report) {
  const auto linked = facets.mesh();
  std::vector<bool> is_dropped(facets.triangles.size());
  for (const EqualFacets& equal : equal_facets(*linked)) {
    if (equal.balance != 0) continue;
    for (const std::uint32_t facet : equal.facets) {
      is_dropped[facet] = true;
      const bool is_first = facet == equal.facets.front();
      report.add(is_first ? RepairStep::opposed_facets : RepairStep::duplicate_facets, facets.middle(facet));
    }
  }
  remove(facets, is_dropped);
}

void drop_duplicate_facets(FacetList& facets, RepairReport& report) {
  const auto linked = facets.mesh();
  const TriangleMesh& mesh = *linked;
  const std::vector<EqualFacets> all = equal_facets(mesh);
  if (all.empty()) return;
  std::vector<bool> is_dropped(facets.triangles.size());
  const auto drop_all_but = [&](const EqualFacets& equal, std::uint32_t kept) {
    for (const std::uint32_t facet : equal.facets) is_dropped[facet] = facet != kept;
  };
  // The one that is kept looks the way most do.
  const auto first_that_is = [&](bool even, const EqualFacets& equal) {
    const auto looks_right = [&](std::uint32_t f) { return is_even(facets.triangles[f]) == even; };
    return *std::ranges::find_if(equal.facets, looks_right);
  };
  for (const EqualFacets& equal : all)
    if (equal.balance != 0) drop_all_but(equal, first_that_is(equal.balance > 0, equal));
  std::vector<EqualFacets> opposed;
  std::ranges::copy_if(all, std::back_inserter(opposed), [](const EqualFacets& equal) { return equal.balance == 0; });
  const std::vector<std::uint32_t> kept = OpposedFacets(mesh, opposed, is_dropped).kept();
  std::vector<bool> is_opposed(facets.triangles.size());  // and the last of its kind
  for (std::size_t i = 0; i < opposed.size(); ++i) {
    drop_all_but(opposed[i], kept[i]);
    if (kept[i] == kNone) is_opposed[opposed[i].facets.front()] = true;
  }
  for (std::uint32_t f = 0; f < is_dropped.size(); ++f)
    if (is_dropped[f])
      report.add(is_opposed[f] ? RepairStep::opposed_facets : RepairStep::duplicate_facets, facets.middle(f));
  remove(facets, is_dropped);
}

}  // namespace algebra3d
