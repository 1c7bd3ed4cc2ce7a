#include "algebra3d/repair/degenerate_facets.h"

#include <algorithm>
#include <utility>

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

/// Per connected part of the facets: whether all of them are among the given balanced ones.
std::vector<bool> wholly_balanced(const FaceComponents& parts, const std::vector<EqualFacets>& all) {
  std::vector<std::uint32_t> total(parts.count), balanced(parts.count);
  for (const std::uint32_t part : parts.of_face) ++total[part];
  for (const EqualFacets& equal : all)
    if (equal.balance == 0)
      for (const std::uint32_t facet : equal.facets) ++balanced[parts.of_face[facet]];
  std::vector<bool> result;
  for (std::size_t part = 0; part < parts.count; ++part) result.push_back(total[part] == balanced[part]);
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

void drop_duplicate_facets(FacetList& facets, RepairReport& report) {
  const auto linked = facets.mesh();
  const TriangleMesh& mesh = *linked;
  const std::vector<EqualFacets> all = equal_facets(mesh);
  if (all.empty()) return;
  const FaceComponents parts = connected_components(mesh);
  const std::vector<bool> is_wholly_balanced = wholly_balanced(parts, all);
  std::vector<bool> is_dropped(facets.triangles.size());
  for (const EqualFacets& equal : all) {
    const bool keeps_one = equal.balance != 0 || is_wholly_balanced[parts.of_face[equal.facets[0]]];
    // The one that is kept looks the way most do.
    const auto looks_right = [&](std::uint32_t f) { return is_even(facets.triangles[f]) == (equal.balance >= 0); };
    const auto kept = std::ranges::find_if(equal.facets, looks_right);
    for (const std::uint32_t facet : equal.facets) {
      if (keeps_one && facet == *kept) continue;
      is_dropped[facet] = true;
      report.add(RepairStep::duplicate_facets, facets.middle(facet));
    }
  }
  remove(facets, is_dropped);
}

}  // namespace algebra3d
