#include "algebra3d/kernel/repair/detail/patch_links.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/disjoint_ids.h"

namespace algebra3d {
namespace {

/// The half-edges of a non-manifold edge, sorted by angle around it.
struct EdgeFan {
  std::vector<HalfedgeId> around;
  bool has_coplanar = false;  ///< two triangles lie upon each other
};

/// None if the corners of a triangle at the edge are collinear.
std::optional<EdgeFan> fan_around(const TriangleMesh& mesh, std::span<const HalfedgeId> edge) {
  const PointRef from = mesh.point(mesh.origin(edge[0])), to = mesh.point(mesh.target(edge[0]));
  const auto apex = [&](HalfedgeId h) { return mesh.point(mesh.origin(TriangleMesh::prev(h))); };
  if (std::ranges::any_of(edge, [&](HalfedgeId h) { return collinear(from, apex(h), to); })) return std::nullopt;
  const auto angle = [&](HalfedgeId a, HalfedgeId b) {
    return compare_around_edge(from, to, apex(edge[0]), apex(a), apex(b));
  };
  EdgeFan fan{{edge.begin(), edge.end()}};
  std::ranges::sort(fan.around, [&](HalfedgeId a, HalfedgeId b) { return std::is_lt(angle(a, b)); });
  const auto are_coplanar = [&](HalfedgeId a, HalfedgeId b) { return std::is_eq(angle(a, b)); };
  fan.has_coplanar = std::ranges::adjacent_find(fan.around, are_coplanar) != fan.around.end();
  return fan;
}

class PatchLinks {
 public:
  explicit PatchLinks(const OrientedPatches& patches) : patches_(patches), mesh_(patches.mesh()) {
    for (std::size_t n = 0; n < mesh_.nonmanifold_edge_count(); ++n) look_at(mesh_.nonmanifold_edge(n));
  }

  std::vector<PatchLink> sorted() const;

 private:
  void look_at(std::span<const HalfedgeId> edge);
  void add(const EdgeFan& fan);

  const OrientedPatches& patches_;
  const TriangleMesh& mesh_;
  std::map<std::pair<ManifoldPatchId, ManifoldPatchId>, double> lengths_;
  bool is_balanced_ = true;
};

void PatchLinks::look_at(std::span<const HalfedgeId> edge) {
  if (edge.size() < 4 || edge.size() % 2 != 0) return;
  const std::optional<EdgeFan> fan = fan_around(mesh_, edge);
  if (!fan) return;
  int balance = 0;
  for (const HalfedgeId h : edge) balance += patches_.direction(h, edge[0]);
  is_balanced_ = is_balanced_ && balance == 0;
  if (!fan->has_coplanar) add(*fan);
}

void PatchLinks::add(const EdgeFan& fan) {
  const HalfedgeId first = fan.around[0];
  const double length_of_edge =
      length(mesh_.point(mesh_.target(first)).approx - mesh_.point(mesh_.origin(first)).approx);
  for (std::size_t i = 0; i < fan.around.size(); ++i) {
    const HalfedgeId h = fan.around[i], next = fan.around[i + 1 == fan.around.size() ? 0 : i + 1];
    const ManifoldPatchId a = patches_.of(TriangleMesh::face(h)), b = patches_.of(TriangleMesh::face(next));
    if (a == b) continue;
    const bool agree = patches_.direction(h, first) != patches_.direction(next, first);
    lengths_[std::minmax({a, b})] += agree ? length_of_edge : -length_of_edge;
  }
}

std::vector<PatchLink> PatchLinks::sorted() const {
  std::vector<PatchLink> links;
  if (is_balanced_) return links;
  for (const auto& [patches, sum] : lengths_)
    if (sum != 0) links.push_back({sum, patches.first, patches.second});
  std::ranges::stable_sort(links, std::greater<>(), [](const PatchLink& link) { return std::abs(link.length); });
  return links;
}

/// Patches in clusters: a spanning forest of the links.
class PatchClusters {
 public:
  PatchClusters(const IndexedSoup& soup, const OrientedPatches& patches, const std::vector<PatchLink>& links);

  /// Per patch: whether it is to be flipped.
  IdVector<ManifoldPatchId, bool> flips();

 private:
  struct Branch {
    ManifoldPatchId to;
    bool agrees;
  };
  struct Areas {
    double staying = 0, flipped = 0;
  };

  void orient_cluster(ManifoldPatchId start);

  IdVector<ManifoldPatchId, std::vector<Branch>> branches_;
  IdVector<ManifoldPatchId, Areas> areas_;  // of its triangles as they are now
  IdVector<ManifoldPatchId, std::optional<bool>> flips_;
};

PatchClusters::PatchClusters(const IndexedSoup& soup, const OrientedPatches& patches,
                             const std::vector<PatchLink>& links)
    : branches_(patches.count()), areas_(patches.count()), flips_(patches.count()) {
  DisjointIds<ManifoldPatchId> clusters(patches.count());
  for (const PatchLink& link : links) {
    if (clusters.find(link.patch) == clusters.find(link.other)) continue;
    clusters.unite(link.patch, link.other);
    branches_[link.patch].push_back({link.other, link.length > 0});
    branches_[link.other].push_back({link.patch, link.length > 0});
  }
  for (const FaceId triangle : soup.triangles.ids()) {
    Areas& areas = areas_[patches.of(triangle)];
    (patches.is_flipped()[triangle] ? areas.flipped : areas.staying) += soup.area(triangle);
  }
}

void PatchClusters::orient_cluster(ManifoldPatchId start) {
  flips_[start] = false;
  std::vector<ManifoldPatchId> cluster{start};
  Areas all;
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const bool flips = *flips_[cluster[i]];
    const Areas& own = areas_[cluster[i]];
    all.staying += flips ? own.flipped : own.staying;
    all.flipped += flips ? own.staying : own.flipped;
    for (const Branch& branch : branches_[cluster[i]]) {
      if (flips_[branch.to]) continue;
      flips_[branch.to] = flips == branch.agrees;
      cluster.push_back(branch.to);
    }
  }
  if (all.flipped > all.staying)
    for (const ManifoldPatchId patch : cluster) flips_[patch] = !*flips_[patch];
}

IdVector<ManifoldPatchId, bool> PatchClusters::flips() {
  IdVector<ManifoldPatchId, bool> result(flips_.size());
  for (const ManifoldPatchId patch : flips_.ids()) {
    if (!flips_[patch]) orient_cluster(patch);
    result[patch] = *flips_[patch];
  }
  return result;
}

}  // namespace

std::vector<PatchLink> patch_links(const OrientedPatches& patches) {
  return PatchLinks(patches).sorted();
}

void flip_linked_patches(const IndexedSoup& soup, OrientedPatches& patches) {
  const std::vector<PatchLink> links = patch_links(patches);
  if (!links.empty()) patches.flip(PatchClusters(soup, patches, links).flips());
}

}  // namespace algebra3d
