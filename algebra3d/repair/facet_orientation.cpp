#include "algebra3d/repair/facet_orientation.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

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
