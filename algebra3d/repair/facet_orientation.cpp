#include "algebra3d/repair/facet_orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/arrangement/disjoint_sets.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d {
namespace {

constexpr std::uint32_t kNoPart = 0xFFFFFFFF;

double area(const FacetList& facets, std::size_t f) {
  return length(cross(facets.corner(f, 1) - facets.corner(f, 0), facets.corner(f, 2) - facets.corner(f, 0))) / 2;
}

/// A facet at an edge, and which way it runs along it.
struct EdgeUse {
  std::uint32_t facet;
  bool is_forward;
};

/// How much speaks for two parts looking the same way as seen across the edges of more than two facets at which they
/// follow each other: the length of those where they do, less that of those where they do not.
struct SeamLink {
  double length = 0;
  std::uint32_t part, other;
};

class Orientation {
 public:
  explicit Orientation(FacetList& facets)
      : facets_(facets),
        linked_(facets.mesh()),
        mesh_(*linked_),
        part_of_(facets.triangles.size(), kNoPart),
        is_turned_(facets.triangles.size()) {}

  void run(RepairReport& report);

 private:
  std::vector<EdgeUse> uses(std::span<const HalfedgeId> edge) const;
  template <typename Visit>
  void for_each_neighbour(std::uint32_t facet, Visit visit) const;
  void find_parts();
  std::vector<SeamLink> seam_links() const;
  void turn_clusters();
  void balance_parts();
  int sign(const EdgeUse& use) const { return use.is_forward != is_turned_[use.facet] ? 1 : -1; }

  FacetList& facets_;
  std::shared_ptr<const TriangleMesh> linked_;  // the facets as given
  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> part_of_;
  std::uint32_t part_count_ = 0;
  std::vector<bool> is_turned_;
};

std::vector<EdgeUse> Orientation::uses(std::span<const HalfedgeId> edge) const {
  std::vector<EdgeUse> result;
  for (const HalfedgeId h : edge)
    result.push_back({TriangleMesh::face(h).index(), mesh_.origin(h) == mesh_.origin(edge[0])});
  return result;
}

/// Calls visit(neighbour, agrees) for the facets across edges of two facets.
template <typename Visit>
void Orientation::for_each_neighbour(std::uint32_t facet, Visit visit) const {
  for (std::uint32_t corner = 0; corner < 3; ++corner) {
    const HalfedgeId h = TriangleMesh::halfedge(FaceId(facet), corner);
    if (const HalfedgeId other = mesh_.opposite(h); other.is_valid()) {
      visit(TriangleMesh::face(other).index(), true);
    } else if (mesh_.is_nonmanifold(h)) {
      const auto edge = mesh_.edge_halfedges(h);
      if (edge.size() == 2) visit(TriangleMesh::face(edge[edge[0] == h ? 1 : 0]).index(), false);
    }
  }
}

void Orientation::find_parts() {
  std::vector<std::uint32_t> part;
  for (std::uint32_t start = 0; start < facets_.triangles.size(); ++start) {
    if (part_of_[start] != kNoPart) continue;
    part.assign(1, start);
    part_of_[start] = part_count_;
    double turned_area = 0, other_area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      (is_turned_[part[i]] ? turned_area : other_area) += area(facets_, part[i]);
      const bool is_turned = is_turned_[part[i]];
      for_each_neighbour(part[i], [&](std::uint32_t neighbour, bool agrees) {
        if (part_of_[neighbour] != kNoPart) return;
        part_of_[neighbour] = part_count_;
        is_turned_[neighbour] = is_turned == agrees;
        part.push_back(neighbour);
      });
    }
    if (turned_area > other_area)
      for (const std::uint32_t facet : part) is_turned_[facet] = !is_turned_[facet];
    ++part_count_;
  }
}

/// Round an edge of a solid that touches itself there, from one facet to the next, the inside follows the outside and
/// the outside the inside; so those that follow each other run along the edge in opposite directions. Empty if all such
/// edges balance already, the most certain first.
std::vector<SeamLink> Orientation::seam_links() const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> lengths;
  bool is_balanced = true;
  for (std::size_t number = 0; number < mesh_.nonmanifold_edge_count(); ++number) {
    const auto edge = mesh_.nonmanifold_edge(number);
    if (edge.size() < 4 || edge.size() % 2 != 0) continue;
    const PointRef from = mesh_.point(mesh_.origin(edge[0])), to = mesh_.point(mesh_.target(edge[0]));
    std::vector<HalfedgeId> around(edge.begin(), edge.end());
    const auto apex = [&](HalfedgeId h) { return mesh_.point(mesh_.origin(TriangleMesh::prev(h))); };
    const auto angle = [&](HalfedgeId a, HalfedgeId b) {
      return compare_around_edge(from, to, apex(edge[0]), apex(a), apex(b));
    };
    if (std::ranges::any_of(edge, [&](HalfedgeId h) { return collinear(from, apex(h), to); })) continue;
    std::ranges::sort(around, [&](HalfedgeId a, HalfedgeId b) { return std::is_lt(angle(a, b)); });
    const auto lie_upon_each_other = [&](HalfedgeId a, HalfedgeId b) { return std::is_eq(angle(a, b)); };
    const std::vector<EdgeUse> facets = uses(around);
    int balance = 0;
    for (const EdgeUse& use : facets) balance += sign(use);
    is_balanced = is_balanced && balance == 0;
    if (std::ranges::adjacent_find(around, lie_upon_each_other) != around.end()) continue;
    const double edge_length = length(to.approx - from.approx);
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const EdgeUse &use = facets[i], &next = facets[i + 1 == facets.size() ? 0 : i + 1];
      const auto [part, other] = std::minmax(part_of_[use.facet], part_of_[next.facet]);
      if (part != other) lengths[{part, other}] += sign(use) != sign(next) ? edge_length : -edge_length;
    }
  }
  std::vector<SeamLink> links;
  if (is_balanced) return links;
  for (const auto& [parts, sum] : lengths)
    if (sum != 0) links.push_back({sum, parts.first, parts.second});
  std::ranges::stable_sort(
      links, [](const SeamLink& a, const SeamLink& b) { return std::abs(a.length) > std::abs(b.length); });
  return links;
}

/// Parts that touch each other along edges make clusters; of each, the side that has more area stays as it is.
void Orientation::turn_clusters() {
  const std::vector<SeamLink> links = seam_links();
  if (links.empty()) return;
  arrangement::DisjointSets clusters(part_count_);
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> joined(part_count_);  // to other parts, looking the same way
  for (const SeamLink& link : links) {
    if (clusters.find(link.part) == clusters.find(link.other)) continue;
    clusters.unite(link.part, link.other);
    joined[link.part].emplace_back(link.other, link.length > 0);
    joined[link.other].emplace_back(link.part, link.length > 0);
  }
  std::vector<std::array<double, 2>> areas(part_count_);  // of facets that stay, and that are turned
  for (std::uint32_t f = 0; f < is_turned_.size(); ++f) areas[part_of_[f]][is_turned_[f] ? 1 : 0] += area(facets_, f);
  std::vector<std::optional<bool>> turns(part_count_);
  for (std::uint32_t start = 0; start < part_count_; ++start) {
    if (turns[start]) continue;
    turns[start] = false;
    std::vector<std::uint32_t> cluster{start};
    double staying = 0, turned = 0;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const bool turn = *turns[cluster[i]];
      staying += areas[cluster[i]][turn ? 1 : 0];
      turned += areas[cluster[i]][turn ? 0 : 1];
      for (const auto& [other, is_same] : joined[cluster[i]]) {
        if (turns[other]) continue;
        turns[other] = turn == is_same;
        cluster.push_back(other);
      }
    }
    if (turned > staying)
      for (const std::uint32_t part : cluster) turns[part] = !*turns[part];
  }
  for (std::size_t f = 0; f < is_turned_.size(); ++f)
    if (*turns[part_of_[f]]) is_turned_[f] = !is_turned_[f];
}

/// Of edges with more than two facets, what runs one way and not the other counts by its length.
void Orientation::balance_parts() {
  struct Seam {
    double length;
    int balance = 0;
    std::vector<std::pair<std::uint32_t, int>> parts;  // ascending, with what each adds to the balance
  };
  std::vector<Seam> seams;
  std::vector<std::vector<std::uint32_t>> seams_of_part(part_count_);
  for (std::size_t number = 0; number < mesh_.nonmanifold_edge_count(); ++number) {
    const auto edge = mesh_.nonmanifold_edge(number);
    if (edge.size() < 3) continue;
    Seam seam{length(mesh_.point(mesh_.target(edge[0])).approx - mesh_.point(mesh_.origin(edge[0])).approx), 0, {}};
    for (const EdgeUse& use : uses(edge)) {
      seam.balance += sign(use);
      const std::uint32_t part = part_of_[use.facet];
      const auto known = std::ranges::find(seam.parts, part, &std::pair<std::uint32_t, int>::first);
      if (known != seam.parts.end())
        known->second += sign(use);
      else
        seam.parts.emplace_back(part, sign(use));
    }
    for (const auto& [part, share] : seam.parts)
      if (share != 0) seams_of_part[part].push_back(static_cast<std::uint32_t>(seams.size()));
    seams.push_back(std::move(seam));
  }
  std::vector<bool> turns(part_count_);
  constexpr int kMaxPasses = 20;
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < kMaxPasses; ++pass) {
    has_changed = false;
    for (std::uint32_t part = 0; part < part_count_; ++part) {
      double gain = 0;
      const auto share_of = [&](const Seam& seam) {
        return std::ranges::find(seam.parts, part, &std::pair<std::uint32_t, int>::first)->second;
      };
      for (const std::uint32_t s : seams_of_part[part])
        gain += seams[s].length * (std::abs(seams[s].balance) - std::abs(seams[s].balance - 2 * share_of(seams[s])));
      if (!(gain > 0)) continue;
      turns[part] = !turns[part];
      has_changed = true;
      for (const std::uint32_t s : seams_of_part[part]) {
        int& share = std::ranges::find(seams[s].parts, part, &std::pair<std::uint32_t, int>::first)->second;
        seams[s].balance -= 2 * share;
        share = -share;
      }
    }
  }
  for (std::size_t f = 0; f < is_turned_.size(); ++f)
    if (turns[part_of_[f]]) is_turned_[f] = !is_turned_[f];
}

void Orientation::run(RepairReport& report) {
  find_parts();
  turn_clusters();
  balance_parts();
  for (std::size_t f = 0; f < is_turned_.size(); ++f) {
    if (!is_turned_[f]) continue;
    std::swap(facets_.triangles[f][1], facets_.triangles[f][2]);
    facets_.changed();
    report.add(RepairStep::turned_facets, facets_.middle(f));
  }
}

}  // namespace

void orient_facets(FacetList& facets, RepairReport& report) {
  Orientation(facets).run(report);
}

}  // namespace algebra3d
